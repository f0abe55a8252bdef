/* The projection of a velocity on those whose bulk velocity is free of divergence.  For all q in P2, phi in P2
 * with phi = 0 on open boundaries (in one node, if there are none):
 *
 *   int dt/rho grad phi.grad q = int u_hat*.grad q - <q, g.n>,     u_projected = u* - dt/rho grad phi
 *
 * grad(P2) lies in P1DG, so the second is exact and the matrix of the first is C^T M^-1 C itself.
 * u_hat* = u* + M^-1 (us - ms u*): inside the solid the flow that must be free of divergence is the solid's.
 * Where the solid has implicit inertia weighted_projection.h replaces dt/rho.
 *
 * The matrix is made once, and again when the density's revision (material.h) or the solid's implicit inertia times dt
 * changes; how it is solved: pressure_solver.h. */
#ifndef FLUID_PROJECTION_H
#define FLUID_PROJECTION_H
#include "fluid/discretization/domain.h"
#include "fluid/discretization/solid_coupling.h"
#include "fluid/discretization/solver_options.h"
#include "fluid/phases/effective_density.h"
#include "fluid/pressure/compressibility.h"
#include <petscksp.h>

typedef struct ProjectionSolver_s *ProjectionSolver;

typedef struct {
  double t, dt;        /* of the boundaries' velocity, s; the step, s */
  const double *rho;   /* [ne] that the pressure moves, kg/m3 */
  int revision;        /* of rho */
  SolidCoupling solid; /* borrowed until ProjectionSolverSubtract */
  /* [ne] of phases, in place of 1/rho (effective_density.h), for the pressure that gravity makes; NULL: 1/rho */
  const InverseDensity *inverse_density;
  PetscBool inertia;                       /* whether the solid's implicit inertia takes part */
  const CompressibleElement *compressible; /* [ne]; NULL: the velocity is to be free of divergence */
  Vec pressure;                            /* before phi is added, ghosted; NULL: that of `compressible` */
} ProjectionStep;

/* like: a ghosted vector of the P2 nodes; domain is borrowed; compressible: steps may have such elements.  Collective, like all of this. */
PetscErrorCode ProjectionSolverCreate(const FluidDomain *domain, Vec like, PetscBool compressible,
                                      ProjectionSolver *s);
PetscErrorCode ProjectionSolverDestroy(ProjectionSolver *s);
/* p, ghosted on the P2 nodes, becomes 0 but on open boundaries. */
PetscErrorCode ProjectionSolverKeepFixed(ProjectionSolver s, Vec p);
/* phi (borrowed, Pa, ghosts up to date) for the velocity u* (blocks [2][3] an element). */
PetscErrorCode ProjectionSolverSolve(ProjectionSolver s, const ProjectionStep *step, Vec velocity, Vec *phi,
                                     SolverReport *report);
/* phi of the last solve, borrowed. */
Vec ProjectionSolverLast(ProjectionSolver s);
/* velocity -= dt/rho grad phi (or the response of the solid's inertia), phi being that of the last solve. */
PetscErrorCode ProjectionSolverSubtract(ProjectionSolver s, const ProjectionStep *step, Vec velocity);
/* p += the rotational increment (rotational_increment.h) of the velocity of the last solve; mu[ne], Pa s; theta: of the viscous stress. */
PetscErrorCode ProjectionSolverAddRotational(ProjectionSolver s, const ProjectionStep *step,
                                             const double mu[], double theta, Vec p);
#endif
