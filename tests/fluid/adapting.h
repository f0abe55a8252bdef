/* A step of a fluid whose mesh adapts, as in main.c. */
#ifndef TEST_FLUID_ADAPTING_H
#define TEST_FLUID_ADAPTING_H
#include "fluid/remeshing/adaptation.h"

/* The flow goes over to a new mesh by transfer, FluidTransfer or one that checks it.  *new_mesh: whether this step has made a mesh, and on
 * entry whether the step before it has. */
static inline PetscErrorCode AdaptingStep(Adaptation adaptation, double dt,
                                          PetscErrorCode (*transfer)(Fluid from, Fluid to), Mesh **mesh,
                                          Fluid *fluid, PetscBool *new_mesh)
{
  Mesh *next_mesh;
  Fluid next;
  PetscFunctionBeginUser;
  if (*new_mesh) PetscCall(FluidMakeSolenoidal(*fluid));
  PetscCall(FluidMomentum(*fluid, dt));
  PetscCall(FluidProject(*fluid, dt));
  PetscCall(AdaptationDue(adaptation, *fluid, new_mesh));
  if (*new_mesh) PetscCall(AdaptationMesh(adaptation, *fluid, &next_mesh));
  PetscCall(FluidCorrect(*fluid, dt, NULL));
  if (!*new_mesh) PetscFunctionReturn(0);
  PetscCall(FluidCreateLike(*fluid, next_mesh, &next));
  PetscCall(transfer(*fluid, next));
  PetscCall(FluidDestroy(fluid));
  PetscCall(MeshDestroy(mesh));
  *mesh = next_mesh;
  *fluid = next;
  PetscFunctionReturn(0);
}
#endif
