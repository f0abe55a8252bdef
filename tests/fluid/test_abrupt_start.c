// ranks: 1 2
/* A wall that moves at once sets a viscous fluid in motion: with theta 0.5 and mu dt/(rho h^2) = 100 the flow is steady within some
 * steps and does not swing (by 2 m/s in each without steps of backward Euler, now by 0.006 m/s, half of it after forty).  These steps are counted through a step that is redone, another
 * fluid and a checkpoint. */
#include "tests/check.h"
#include "tests/fluid/exact.h"
#include "tests/fluid/through_checkpoint.h"

#define H 0.1
#define DT 0.1
#define VISCOSITY (100.0 * RHO * H * H / DT)
#define STEPS 10

typedef enum {
  STRAIGHT,
  REDONE,
  TRANSFERRED,
  RESUMED,
  VARIANTS
} Variant; /* what comes after the first step */

static PetscErrorCode Create(Mesh *mesh, Fluid *fluid)
{
  Boundary boundary[8] = {0};
  const FluidSetup setup = {
      .theta = 0.5, .rho = RHO, .mu = VISCOSITY, .cfl = 1.0, .dt_max = 1.0, .boundary = boundary};
  PetscFunctionBeginUser;
  boundary[MeshTagIndex(mesh, "left")].kind = boundary[MeshTagIndex(mesh, "right")].kind = BOUNDARY_OPEN;
  boundary[MeshTagIndex(mesh, "top")].velocity[0] = 1.0;
  PetscCall(FluidCreate(mesh, &setup, fluid));
  PetscFunctionReturn(0);
}

static PetscErrorCode Redo(Fluid fluid)
{
  PetscFunctionBeginUser;
  PetscCall(FluidSaveState(fluid));
  PetscCall(FluidStep(fluid, DT));
  PetscCall(FluidStep(fluid, DT));
  PetscCall(FluidRestoreState(fluid));
  PetscFunctionReturn(0);
}

static PetscErrorCode Run(Mesh *mesh, int steps, Variant variant, Fluid *fluid)
{
  Fluid next;
  PetscFunctionBeginUser;
  PetscCall(Create(mesh, fluid));
  PetscCall(FluidSetInitial(*fluid, 0.0, NULL, NULL, NULL));
  if (variant == REDONE) PetscCall(Redo(*fluid));
  PetscCall(FluidStep(*fluid, DT));
  if (variant == REDONE) PetscCall(Redo(*fluid));
  if (variant == TRANSFERRED || variant == RESUMED) {
    PetscCall(Create(mesh, &next));
    if (variant == TRANSFERRED)
      PetscCall(FluidTransfer(*fluid, next));
    else
      PetscCall(ThroughCheckpoint(*fluid, mesh, next));
    PetscCall(FluidDestroy(fluid));
    *fluid = next;
  }
  for (int k = 1; k < steps; k++) PetscCall(FluidStep(*fluid, DT));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  Mesh *mesh;
  Fluid straight, other;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(PetscOptionsSetValue(NULL, "-momentum_ksp_rtol", "1e-12"));
  PetscCall(SquareMesh(H, &mesh));
  PetscCall(Run(mesh, STEPS, STRAIGHT, &straight));
  PetscCall(Run(mesh, STEPS + 1, STRAIGHT, &other));
  const double change = LargestVelocity(straight, other);
  if (argc > 1) PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%g m/s\n", change));
  CHECK(change < 0.02, "a step still changes the velocity by %g m/s", change);
  PetscCall(FluidDestroy(&other));
  for (Variant v = REDONE; v < VARIANTS; v++) {
    PetscCall(Run(mesh, STEPS, v, &other));
    const double difference = LargestVelocity(straight, other);
    /* the transfer to the same mesh leaves round-off */
    CHECK(difference <= (v == TRANSFERRED ? 1e-9 : 0.0), "variant %d differs by %g m/s", (int)v, difference);
    PetscCall(FluidDestroy(&other));
  }
  PetscCall(FluidDestroy(&straight));
  PetscCall(MeshDestroy(&mesh));
  PetscCall(PetscFinalize());
  return 0;
}
