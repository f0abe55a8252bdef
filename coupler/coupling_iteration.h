/* Coupling iterations: the step is repeated until the solid's velocity at its end is the one that the fluid
 * was solved with, the fixed point of
 *
 *     H:  iterate v  -->  fluid solve with u_s = v  -->  force on the solid  -->  solid's velocity H(v)
 *
 *     v_0 = CouplerPredictedVelocity;     repeat  v_k+1 = quasi-Newton(v_k, H(v_k))
 *     until  rms(e (H(v_k) - v_k)) <= max(tolerance rms(H(v_k)), 1e-4 dr/dt).
 *
 * e is the explicit fraction (inertia.h): 0 at nodes whose inertia is in the fluid's solve, so where all are
 * such the first iteration is accepted.  The geometry is built once, for all iterations over the same dt.  All functions are
 * collective. */
#ifndef CORACLE_COUPLING_ITERATION_H
#define CORACLE_COUPLING_ITERATION_H
#include "coupler/geometry/solid_state.h"
#include "coupler/quasi_newton.h"

/* Part of the shell's thickness: displacements over a step that differ by less are taken as equal. */
#define NEGLIGIBLE_DISPLACEMENT 1e-4

typedef struct {
  MPI_Comm comm;
  int max_iterations;        /* of a step; 1: the first is accepted */
  double tolerance;          /* of the residual's root mean square, relative to the velocity's */
  double thickness;          /* of the shell, dr, m */
  int n;                     /* nodes on this rank at the step's start; -1: no step yet */
  double *iterate;           /* [n][2] v_k, the velocity that the fluid couples to, m/s */
  double *result;            /* [n][2] H(v_k), m/s */
  double *explicit_fraction; /* [n] e */
  char *given;               /* [n] */
  double dt;                 /* of the step, s */
  double residual;           /* rms(e (H(v_k) - v_k)) of the last iteration, m/s */
  int failures;              /* so often in a row a step has not converged, or could not be made */
  QuasiNewton quasi_newton;
} CouplingIteration;

PetscErrorCode CouplingIterationCreate(MPI_Comm comm, int max_iterations, double tolerance, double thickness,
                                       CouplingIteration *t);
PetscErrorCode CouplingIterationDestroy(CouplingIteration *t);
/* Starts a step of dt seconds from the solid as it is; predicted[n][2] v_0, m/s, explicit_fraction[n] and given[n], whose nodes
 * keep v_0, are copied.  When a step has not converged twice the quasi-Newton method begins
 * anew. */
PetscErrorCode CouplingIterationBegin(CouplingIteration *t, const SolidState *solid, double dt,
                                      const double predicted[], const double explicit_fraction[],
                                      const char given[]);
/* Has the step converged with `solid` as the result of iteration number `iteration` (from 1)?  Always true
 * when at most one is allowed or the nodes of the start are lost.  In a step in which cracks open they may do so in one iteration and
 * not, or at another time, in the next: it converges over a part of dt (time_loop.c). */
PetscErrorCode CouplingIterationHasConverged(CouplingIteration *t, int iteration, const SolidState *solid,
                                             PetscBool *converged);
/* *u = v_k+1 [n][2], m/s, borrowed until the next step. */
PetscErrorCode CouplingIterationNext(CouplingIteration *t, const double **u);
#endif
