/* Coupling iterations: strong coupling by repetition of the step.  The solid's velocity at the step's end is the
 * fixed point of
 *
 *     H:  iterate v  -->  fluid solve with u_s = v  -->  force on the solid  -->  solid's velocity H(v)
 *
 *     v_0 = v^n + dt (acceleration of the last step);     repeat  v_k+1 = quasi-Newton(v_k, H(v_k))
 *     until  rms(H(v_k) - v_k) <= max(tolerance rms(H(v_k)), 1e-4 dr/dt).
 *
 * A staggered step is one iteration with the velocity of the step before.  The geometry is that of the step's
 * start in either case.  Nodes with a mobility (inertia.h) are coupled implicitly and take no part.
 * All functions are collective. */
#ifndef CORACLE_COUPLING_ITERATION_H
#define CORACLE_COUPLING_ITERATION_H
#include "coupler/quasi_newton.h"
#include "coupler/solid_state.h"

typedef struct {
  MPI_Comm comm;
  int max_iterations;   /* of a step; 1: staggered */
  double tolerance;     /* of the residual's root mean square, relative to the velocity's */
  double thickness;     /* of the shell, dr, m */
  int n;                /* nodes on this rank at the step's start; -1: no step yet */
  double *start;        /* [n][2] velocity at the step's start, m/s */
  double *iterate;      /* [n][2] v_k, the velocity that the fluid couples to, m/s */
  double *result;       /* [n][2] H(v_k); v_k on nodes with a mobility, m/s */
  double *acceleration; /* [n][2] mean over the last step, m/s2 */
  double *mobility;     /* [n] 1/kg */
  double dt;            /* of the step, s */
  double residual;      /* rms(H(v_k) - v_k) of the last iteration, m/s */
  PetscBool has_acceleration;
  QuasiNewton quasi_newton;
} CouplingIteration;

PetscErrorCode CouplingIterationCreate(MPI_Comm comm, int max_iterations, double tolerance, double thickness,
                                       CouplingIteration *t);
PetscErrorCode CouplingIterationDestroy(CouplingIteration *t);
/* Starts a step of dt seconds from the solid as it is; *u = v_0 [n][2], m/s, borrowed until the next step. */
PetscErrorCode CouplingIterationBegin(CouplingIteration *t, const SolidState *solid, double dt,
                                      const double **u);
/* Has the step converged with `solid` as the result of iteration number `iteration` (from 1)?  Always true when
 * there is no residual (staggered, or the nodes of the start are lost), and in the last iteration of a step in
 * which cracks have opened: whether they do may alternate from iteration to iteration. */
PetscErrorCode CouplingIterationHasConverged(CouplingIteration *t, int iteration, const SolidState *solid,
                                             PetscBool *converged);
/* *u = v_k+1 [n][2], m/s, borrowed until the next step. */
PetscErrorCode CouplingIterationNext(CouplingIteration *t, const double **u);
/* The step is accepted. */
PetscErrorCode CouplingIterationEnd(CouplingIteration *t);
#endif
