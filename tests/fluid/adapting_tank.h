/* A tank whose mesh adapts to the interfaces. */
#ifndef TEST_FLUID_ADAPTING_TANK_H
#define TEST_FLUID_ADAPTING_TANK_H
#include "tests/fluid/adapting.h"
#include "tests/fluid/tank.h"

typedef struct {
  Tank tank;
  Adaptation adaptation;
  PetscBool new_mesh;
  int meshes;
} AdaptingTank;

static const AdaptationSetup TANK_ADAPTATION = {.size_min = 0.03,
                                                .corner_size = 0.03,
                                                .size_max = 0.3,
                                                .interface_size = 0.03,
                                                .velocity_error = 0.05,
                                                .growth = 1.5,
                                                .anisotropy = 5.0,
                                                .elements_max = 1e5,
                                                .every = 3};

static inline PetscErrorCode AdaptingTankDestroy(AdaptingTank *m)
{
  PetscFunctionBeginUser;
  PetscCall(AdaptationDestroy(&m->adaptation));
  PetscCall(TankDestroy(&m->tank));
  PetscFunctionReturn(0);
}

static inline PetscErrorCode AdaptingTankStep(AdaptingTank *m, double dt)
{
  PetscFunctionBeginUser;
  PetscCall(AdaptingStep(m->adaptation, dt, FluidTransfer, &m->tank.mesh, &m->tank.fluid, &m->new_mesh));
  m->meshes += m->new_mesh;
  PetscFunctionReturn(0);
}
#endif
