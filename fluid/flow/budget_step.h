/* Private to the budget of momentum: what its files give each other. */
#ifndef FLUID_BUDGET_STEP_H
#define FLUID_BUDGET_STEP_H
#include "fluid/flow/fluid_impl.h"

/* The velocities of a step and what weighs them. */
typedef struct {
  double t, dt, theta;
  const double *old, *new, *step, *mu; /* density at both ends and of the step, viscosity of the step */
  const PetscScalar *u, *u_star, *end, *flux,
      *p; /* at its start, before the projection, at its end; mass flux; pressure */
} BudgetStep;

/* budget_boundary.c: force[ntags] += what this rank's faces give to the boundaries.  Not collective. */
void BudgetAddBoundaries(Fluid f, const BudgetStep *s, BoundaryForce force[]);
#endif
