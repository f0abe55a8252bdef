/* The momentum equation of one step, for u*:
 *
 *   [rho M/dt + theta L + a] u* = [rho M/dt - (1 - theta) L] u^n + M (rho g - grad p + source + rho k U) + s
 *
 * L is upwind advection by a mass flux, the viscous stress (kernels.h) and rho k u, k and U of absorption.h; a and s are the solid's coupling.
 * Assembled in one pass over the elements and one over those that the solid overlaps, solved by GMRES (prefix momentum_)
 * until the preconditioned residual is 1e-5 of the velocity (-momentum_ksp_rtol), less beside solids more than 20 times as heavy; elements
 * in which a solid is heavier than all fluid around are solved once more, each alone, for the force on it. */
#ifndef FLUID_MOMENTUM_H
#define FLUID_MOMENTUM_H
#include "fluid/discretization/absorption.h"
#include "fluid/discretization/domain.h"
#include "fluid/discretization/solid_coupling.h"
#include "fluid/discretization/solver_options.h"
#include "fluid/transport/phase_transport.h"
#include <petscksp.h>

typedef struct MomentumSolver_s *MomentumSolver;

/* What stays from step to step. */
typedef struct {
  FieldFunction source; /* body force per volume, N/m3, or NULL */
  void *source_context;
} MomentumSetup;

/* One step.  Vectors have a block [2][3] an element (component, vertex) and ghosts; those of mass_flux and p are up to date. */
typedef struct {
  double t, dt;      /* from t to t + dt, s */
  double theta;      /* 0.5 Crank-Nicolson .. 1 backward Euler */
  double gravity[2]; /* m/s2 */
  const double *rho; /* [ne + ng] density of inertia and weight, kg/m3 */
  const double *mu;  /* [ne + ng] Pa s */
  int revision;      /* of rho and mu; 0: they have always been these */
  Vec mass_flux;     /* m = rho beta at t + theta dt, kg/(m2 s); on a face the mean of its two sides counts */
  Vec u, p;          /* u^n, m/s; pressure on P2 nodes, Pa */
  SolidCoupling solid;
  /* [ne + ng] with phases: density of what an element has beside a solid, 0 where it has nothing but the solid, kg/m3; NULL: one fluid */
  const double *outside;
  /* [ne] with phases: the pressure acts as rho R^-1 grad p and gravity is the weight (effective_density.h), and what comes
   * in through open boundaries is at rest; NULL: one fluid */
  const InverseDensity *inverse_density;
  const AbsorptionAt *absorption; /* [ne]; NULL: none */
} MomentumStep;

typedef struct {
  SolverReport solver;
  double seconds_assembly, seconds_solve;
} MomentumReport;

/* like: a vector of the velocity; domain is borrowed.  Collective, like all of this. */
PetscErrorCode MomentumSolverCreate(const FluidDomain *domain, const MomentumSetup *setup, Vec like,
                                    MomentumSolver *s);
PetscErrorCode MomentumSolverDestroy(MomentumSolver *s);
/* [ne], borrowed: the weak divergence of the last step's mass flux, as each function of an element sees it (kernels.h), kg/(m s);
 * advected: the sum over this rank's elements of it times u^n, N/m.  Not collective. */
const double (*MomentumSolverDivergence(MomentumSolver s, double advected[2]))[3];
/* Operator and load of the step but for the solid's coupling, which may not be known yet. */
PetscErrorCode MomentumSolverAssemble(MomentumSolver s, const MomentumStep *step);
/* After that, borrowed, to be added to: the load, blocks [2][3] of the elements, N.  Not collective. */
Vec MomentumSolverLoad(MomentumSolver s);
/* After that, for the same step.  u_star: the first guess in, the solution out. */
PetscErrorCode MomentumSolverSolve(MomentumSolver s, const MomentumStep *step, Vec u_star,
                                   MomentumReport *report);
#endif
