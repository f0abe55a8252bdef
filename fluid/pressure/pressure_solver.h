/* The pressure's equation in P2: its matrix, from the elements' 6 x 6 blocks, and two solvers.
 *
 *   direct      a factor of one rank, for a matrix that stays, unless mesh or number of ranks are large (prefix
 *               pressure_)
 *   iterative   CG, preconditioned by relaxation and linear functions (pressure_preconditioner.h; prefix
 *               pressure_varying_)
 *
 * CG stops when what is left changes the velocity by less than 1e-8 (-pressure_varying_ksp_rtol) of what the
 * pressure changes in it, or, if allowed, by less than a hundred times that of the velocity.  It measures by the energy norm, which sees a
 * velocity u as rho u^2, and so goes on further by the square root of the densities' contrast, for the same where the fluid is light.  Where the domain is closed the pressure is known up to a
 * constant: the direct solver fixes the first node, CG works with the null space. */
#ifndef FLUID_PRESSURE_SOLVER_H
#define FLUID_PRESSURE_SOLVER_H
#include "fluid/discretization/domain.h"
#include "fluid/discretization/solver_options.h"
#include <petscksp.h>

typedef struct PressureSolver_s *PressureSolver;

/* t, s, for messages.  size: square root of int rho u*^2/dt^2, if CG may stop when the error is small beside u*,
 * else 0.  rhs: 0 on fixed nodes. */
typedef struct {
  double t, size;
  Vec rhs;
} PressureProblem;

/* is_fixed[n of the P2 space]: nodes with phi = 0; closed: no rank has any.  domain and is_fixed are borrowed.  Collective, like all of this. */
PetscErrorCode PressureSolverCreate(const FluidDomain *domain, const char is_fixed[], PetscBool closed,
                                    PressureSolver *s);
PetscErrorCode PressureSolverDestroy(PressureSolver *s);
/* block[ne][6][6], the elements' contributions: to be filled before PressureSolverSetMatrix, and kept until the next.  Not
 * collective. */
double (*PressureSolverBlocks(PressureSolver s))[36];
/* [ne], likewise: how much an element's coefficient depends on place and direction, the largest ratio of what its vertices have in the
 * diagonal of its block to what they have with a coefficient of one; 1 at the start. */
double *PressureSolverUnevenness(PressureSolver s);
/* The matrix is the sum of the blocks; varying: it will be another one soon.  contrast: square root of the fluid's largest density over its least. */
PetscErrorCode PressureSolverSetMatrix(PressureSolver s, PetscBool varying, double contrast);
PetscErrorCode PressureSolverSolve(PressureSolver s, const PressureProblem *problem, Vec phi,
                                   SolverReport *report);
#endif
