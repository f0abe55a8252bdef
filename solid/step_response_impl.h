/* The data of a StepResponse, for the files step_*.c. */
#ifndef SOLID_STEP_RESPONSE_IMPL_H
#define SOLID_STEP_RESPONSE_IMPL_H
#include "solid/step_response.h"
#include <petscksp.h>

/* Of the matrix's rows, in its order: node n has the blocks start[n] .. start[n + 1]. */
struct StepResponse_s {
  int nnodes, nelements, nsix, njoints;
  int *element, *six, *joint; /* [nelements][3], [nsix][6], [njoints][4] of which the pattern has been made */
  int *start, *column;        /* [nnodes + 1]; [nblocks] nodes, sorted */
  int *slot,
      *six_slot;      /* [nelements][9] block of corners i, j at 3 i + j; [nsix][36] the same of six nodes */
  double (*block)[4]; /* [nblocks] of K: xx, xy, yx, yy, N/m */
  double spring[MAX_SPRINGS][4]; /* SpringsStiffness */
  double c, c0;                  /* s2; c0 0: no factor */
  PC factor;
  Mat matrix;
  Vec right, left;           /* of the factor */
  char *held;                /* [nnodes][2] StepResponseHolds */
  double *part, *owned;      /* [nnodes] 1/n; 1 on the rank that owns the node, else 0 */
  double *diagonal, *weight; /* [nnodes] of the factored matrix, both rows, kg/m; W */
  double (*turn)[2];         /* [nnodes] cosine and sine of R */
  double *r, *z, *p, *q;     /* [nnodes][2] */
};

/* step_matrix.c: the blocks' places, for element and joint; not collective. */
PetscErrorCode StepMatrixCreate(StepResponse a);
/* K of this rank's elements with the nodes at x[nnodes][2]; not collective. */
PetscErrorCode StepMatrixAssemble(StepResponse a, Solid s, const double x[]);
/* Adds that of the joints; not collective. */
PetscErrorCode StepMatrixAddJoints(StepResponse a, Solid s);
/* kd = K d of all ranks, springs included; 0 where it is held.  Collective. */
PetscErrorCode StepMatrixMultiply(StepResponse a, Solid s, const double d[], double kd[]);

/* step_factor.c: the matrix M/n + c0 K0, two rows a node, and what factors it; not collective, nor the next one. */
PetscErrorCode StepFactorCreate(StepResponse a);
/* Of M/n + c times the blocks as they are, with 1 on the diagonal of what is held and nothing that couples it. */
PetscErrorCode StepFactorUpdate(StepResponse a, Solid s, double c);
/* W of the factors as they are.  Collective. */
PetscErrorCode StepFactorWeigh(StepResponse a, Solid s);
/* Not collective: R with the nodes where they are; 1 where `turned` is false, and of a node with a component that is held. */
void StepFactorTurn(StepResponse a, Solid s, PetscBool turned);
/* z = P^-1 r.  Collective. */
PetscErrorCode StepFactorApply(StepResponse a, Solid s, const double r[], double z[]);
#endif
