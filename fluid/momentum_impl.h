/* Private to the momentum solver: its data, and what its files give each other. */
#ifndef FLUID_MOMENTUM_IMPL_H
#define FLUID_MOMENTUM_IMPL_H
#include "fluid/momentum.h"
#include "fluid/preconditioner.h"

struct MomentumSolver_s {
  const FluidDomain *domain; /* borrowed */
  MomentumSetup setup;
  Mat matrix;     /* element_matrix.h, 6 unknowns an element */
  PetscInt *slot; /* [ne][4] */
  Vec load, product;
  KSP ksp;
  Preconditioner preconditioner;
};

/* Matrix and load of a step, but for the part of A u^n: the load still lacks -(1 - theta)/theta A u^n.
 * momentum_assembly.c */
PetscErrorCode MomentumAssemble(MomentumSolver s, const MomentumStep *step);
#endif
