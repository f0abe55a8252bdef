/* Private to the momentum solver: its data, and what its files give each other. */
#ifndef FLUID_MOMENTUM_IMPL_H
#define FLUID_MOMENTUM_IMPL_H
#include "fluid/momentum/momentum.h"
#include "fluid/momentum/momentum_operator.h"
#include "fluid/momentum/preconditioner.h"
#include "fluid/momentum/single_operator.h"

struct MomentumSolver_s {
  const FluidDomain *domain; /* borrowed */
  MomentumSetup setup;
  double theta; /* of the step */
  MomentumOperator op;
  ScalarBlocks *faces; /* [ne] what viscosity makes of interior faces, times theta; NULL while it varies */
  double (*divergence)[3]; /* [ne] of the step's mass flux (kernels.h) */
  double advected[2];      /* this rank's sum of divergence u^n */
  SingleOperator single;
  Mat matrix; /* MATSHELL of single */
  Vec load, product, sum;
  KSP ksp;
  PetscReal tolerance; /* relative, of the velocity */
  Preconditioner preconditioner;
};

/* momentum_assembly.c: the solid's part of operator and load; the load still lacks -(1 - theta)/theta A u^n. */
PetscErrorCode MomentumAssembleSolid(MomentumSolver s, const MomentumStep *step);
#endif
