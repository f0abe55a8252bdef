/* Strong coupling: a step is tried until the velocity that the solid ends with is the one that the fluid
 * has met in it.
 *
 *     predict v of the solid;   do   fluid with v -> force -> solid's v'   until v' = v;   v <- accelerate.h
 *
 * A staggered step is one try in which the fluid meets the velocity of the step before.  The geometry is
 * that of the step's start in either case.  Nodes that give way by themselves (inertia.h) take no part. */
#ifndef CORACLE_TRIES_H
#define CORACLE_TRIES_H
#include "common/link/server.h"
#include "coupler/quasi_newton.h"

typedef struct {
  MPI_Comm comm;
  int most;          /* 1: staggered */
  double tolerance;  /* of the difference, over the velocity; root mean squares */
  double thickness;  /* of the shell, m */
  int n;             /* nodes on this rank */
  double *start;     /* [n][2] velocity as the step began, m/s */
  double *met;       /* [n][2] what the fluid meets */
  double *end;       /* [n][2] what the last try has led to; met where nodes give way */
  double *rate;      /* [n][2] acceleration of the last step, m/s2 */
  double *mobility;  /* [n] */
  double dt;         /* of the step, s */
  double difference; /* of the last try, m/s */
  PetscBool has_rate;
  QuasiNewton acceleration;
} CouplingIteration;

/* All collective. */
PetscErrorCode CouplingIterationCreate(MPI_Comm comm, int most, double tolerance, double thickness,
                                       CouplingIteration *t);
PetscErrorCode CouplingIterationDestroy(CouplingIteration *t);
/* A step of dt seconds, of several tries, from the solid as it is; *u [n][2]: the velocity to begin with. */
PetscErrorCode CouplingIterationBegin(CouplingIteration *t, const ServerSolid *solid, double dt,
                                      const double **u);
/* Whether the try stands that has led to `solid`: it agrees, or there is nothing to compare (one try only,
 * or a mesh that is another one), or it is the last and cracks, which come or do not, keep it from
 * agreeing. */
PetscErrorCode CouplingIterationHasConverged(CouplingIteration *t, int tries, const ServerSolid *solid,
                                             PetscBool *agree);
/* The velocity of the next try. */
PetscErrorCode CouplingIterationNext(CouplingIteration *t, const double **u);
/* The step has ended. */
PetscErrorCode CouplingIterationEnd(CouplingIteration *t);
#endif
