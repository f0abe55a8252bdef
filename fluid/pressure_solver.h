/* The pressure's equation in P2: its matrix, from the elements' 6 x 6 blocks, and two solvers.
 *
 *   constant    direct: a factor, made when the matrix is set (prefix pressure_)
 *   varying     CG, preconditioned by relaxation and linear functions (pressure_preconditioner.h; prefix
 *               pressure_varying_)
 *
 * Where the domain is closed the pressure is known up to a constant: the direct solver fixes the first node,
 * CG works with the null space. */
#ifndef FLUID_PRESSURE_SOLVER_H
#define FLUID_PRESSURE_SOLVER_H
#include "fluid/domain.h"
#include <petscksp.h>

typedef struct PressureSolver_s *PressureSolver;

typedef struct {
  double t; /* s, for messages */
  double
      size; /* square root of int rho u*^2/dt^2: errors that change u* less than relatively do not matter */
  Vec rhs;  /* 0 on fixed nodes */
} PressureProblem;

/* is_fixed[n of the P2 space]: nodes with phi = 0; closed: no rank has any.  domain and is_fixed are borrowed.  Collective, like all of this. */
PetscErrorCode PressureSolverCreate(const FluidDomain *domain, const char is_fixed[], PetscBool closed,
                                    PressureSolver *s);
PetscErrorCode PressureSolverDestroy(PressureSolver *s);
/* *block[ne][6][6], to be filled with the elements' contributions before PressureSolverSetMatrix. */
PetscErrorCode PressureSolverGetBlocks(PressureSolver s, double (**block)[36]);
/* The matrix is the sum of the blocks, which are void then; varying: it will be another one soon. */
PetscErrorCode PressureSolverSetMatrix(PressureSolver s, PetscBool varying, double (**block)[36]);
PetscErrorCode PressureSolverSolve(PressureSolver s, const PressureProblem *problem, Vec phi,
                                   int *iterations);
#endif
