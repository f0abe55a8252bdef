/* Private to the fluid: what is behind the handle. */
#ifndef FLUID_IMPL_H
#define FLUID_IMPL_H
#include "fluid/fluid.h"

enum { ASSEMBLY, MOMENTUM, PRESSURE, COUPLING, ADAPTATION, SETUP };

struct Fluid_s {
  const Mesh *mesh; /* borrowed */
  FluidSetup setup;
  double t, dt_previous;
  ElementGeometry *geometry; /* [ne + ng] */
  double *rho, *mu;          /* [ne + ng] */
  double *alpha;             /* [ne] */

  /* velocity: ghosted block vectors (6 an element) */
  Vec u, u_previous, u_star, u_next, beta, load, saved_u, saved_previous;
  Mat momentum; /* BAIJ, written in place */
  KSP momentum_ksp;
  PetscInt *slot; /* [ne][4] block of the diagonal and of each face in the local diagonal (>= 0) or
                     off-diagonal (-1 - k) part */
  struct Preconditioner_s *preconditioner;

  /* pressure: ghosted P2 vectors */
  Vec p, phi, divergence, saved_p;
  Mat laplacian; /* int 1/rho grad.grad */
  KSP pressure_ksp;
  int nfixed;
  int *fixed;     /* local P2 nodes (owned) on open boundaries, or the pinned one */
  char *is_fixed; /* [np2] with ghosts */
  PetscBool has_open;
  /* where a solid gives way to the pressure: giving.c */
  PetscBool gives;             /* on any rank, in the step in hand */
  Mat giving, giving_factored; /* now, and when it was factored last */
  KSP giving_ksp;
  PetscInt giving_iterations;
  double (*response)[6][6]; /* [ncoupling] */

  int ncoupling, capacity;
  PetscBool has_solid; /* on any rank */
  CoracleCoupling *coupling;
  int *coupling_of; /* [ne] entry of coupling, or -1 */
  double saved_t, saved_dt;
  FluidStats stats;
};

/* Sets an option of PETSc that nobody has given: for solvers that are made inside of others. */
PetscErrorCode FluidDefaultOption(const char *name, const char *value);

/* boundary.c */
PetscErrorCode BoundaryPrepare(Fluid f);
void BoundaryVelocity(const Boundary *b, double t, const double x[2], double v[2]);
double HydrostaticPressure(Fluid f, const double x[2]); /* rho g.(x - top), Pa */
/* What element e's side of face i prescribes: its geometry and side; the boundary, or NULL inside. */
const Boundary *BoundaryOfFace(Fluid f, int e, int i);
/* project[c][d]: the directions in which a boundary prescribes the velocity */
void BoundaryProjection(const Boundary *b, const double n[2], double project[2][2]);
/* momentum.c, pressure.c */
PetscErrorCode MomentumCreate(Fluid f);
PetscErrorCode MomentumDestroy(Fluid f);
/* A BAIJ matrix with a block for each element and each pair of neighbours, at 0; its sequential parts
 * (*offdiagonal is NULL on one rank, garray its global block columns). */
PetscErrorCode MomentumPattern(const Mesh *m, PetscInt block, Mat *matrix);
PetscErrorCode MatrixParts(Mat matrix, Mat *diagonal, Mat *offdiagonal, const PetscInt **garray);
/* preconditioner.c: made anew of the assembled momentum matrix by each update */
PetscErrorCode PreconditionerCreate(Fluid f);
PetscErrorCode PreconditionerUpdate(Fluid f);
PetscErrorCode PreconditionerDestroy(Fluid f);
PetscErrorCode PressureCreate(Fluid f);
PetscErrorCode PressureDestroy(Fluid f);
/* A solver with a direct factor as preconditioner; operators, tolerances and options are still to be set. */
PetscErrorCode PressureSolver(Fluid f, const char *prefix, KSPType type, KSP *ksp);
/* giving.c: matrix and responses of the step in hand; u -= response to grad phi, or false where nothing gives
 * way */
PetscErrorCode WeightedProjectionPrepare(Fluid f, double dt);
PetscBool WeightedProjectionVelocity(Fluid f, int e, const double grad[3][2], double u[6]);
PetscErrorCode WeightedProjectionDestroy(Fluid f);

/* What element e contributes to the kernels of its face i; its two vertices are (i + 1) % 3 and (i + 2) % 3.
 */
static inline FaceSide FaceSideOf(const struct Fluid_s *f, int e, int i, double theta, double share)
{
  const ElementGeometry *g = f->geometry + e;
  return (FaceSide){g, theta * f->mu[e], theta * share * PENALTY_FACTOR * f->mu[e] * g->trace, (i + 1) % 3,
                    (i + 2) % 3};
}
#define PENALTY_INTERIOR 0.5 /* each side's share: eta = factor mu (TC_K + TC_N)/2 */
#define PENALTY_BOUNDARY 2.0

static inline const double *ElementVertex(const Mesh *m, int e, int i)
{
  return m->x + 2 * m->vertex[3 * e + i];
}
#endif
