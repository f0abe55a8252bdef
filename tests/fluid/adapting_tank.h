/* A tank whose mesh adapts to the interfaces. */
#ifndef TEST_FLUID_ADAPTING_TANK_H
#define TEST_FLUID_ADAPTING_TANK_H
#include "fluid/remeshing/adaptation.h"
#include "tests/fluid/tank.h"

typedef struct {
  Tank tank;
  Adaptation adaptation;
  PetscBool new_mesh;
  int meshes;
} AdaptingTank;

static const AdaptationSetup TANK_ADAPTATION = {.size_min = 0.03,
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

/* As in main.c. */
static inline PetscErrorCode AdaptingTankStep(AdaptingTank *m, double dt)
{
  Fluid f = m->tank.fluid, next;
  PetscBool due;
  Mesh *mesh;
  PetscFunctionBeginUser;
  if (m->new_mesh) PetscCall(FluidMakeSolenoidal(f));
  m->new_mesh = PETSC_FALSE;
  PetscCall(FluidMomentum(f, dt));
  PetscCall(FluidProject(f, dt));
  PetscCall(AdaptationDue(m->adaptation, f, &due));
  if (due) PetscCall(AdaptationMesh(m->adaptation, f, &mesh));
  PetscCall(FluidCorrect(f, dt, NULL));
  if (!due) PetscFunctionReturn(0);
  PetscCall(FluidCreateLike(f, mesh, &next));
  PetscCall(FluidTransfer(f, next));
  PetscCall(TankDestroy(&m->tank));
  m->tank = (Tank){mesh, next};
  m->new_mesh = PETSC_TRUE;
  m->meshes++;
  PetscFunctionReturn(0);
}
#endif
