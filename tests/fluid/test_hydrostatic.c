// ranks: 1 2 3
/* A tank under gravity at rest stays at rest to 1e-10, closed and open. */
#include "tests/fluid/exact.h"

static PetscErrorCode Rest(BoundaryKind kind)
{
  const double h = 0.1;
  Boundary boundary[8] = {0};
  FluidSetup setup = {
      .theta = 0.5, .rho = 1000.0, .mu = 1.0, .gravity = {1.0, -9.81}, .cfl = 0.5, .dt_max = 0.01};
  Mesh *mesh;
  Fluid fluid;
  double speed = 0.0;
  PetscFunctionBeginUser;
  PetscCall(SquareMesh(h, &mesh));
  for (int b = 0; b < mesh->ntags; b++) boundary[b].kind = kind;
  setup.boundary = boundary;
  PetscCall(FluidCreate(mesh, &setup, &fluid));
  PetscCall(FluidSetInitial(fluid, 0.0, NULL, NULL, NULL));
  for (int k = 0; k < 20; k++) PetscCall(FluidStep(fluid, 0.01));
  for (int k = 0; k < 6 * mesh->ne; k++) speed = fmax(speed, fabs(FluidVelocity(fluid)[k]));
  PetscCheck(speed < 1e-10, PETSC_COMM_SELF, PETSC_ERR_PLIB,
             "boundary kind %d: a fluid at rest moves at %g m/s", kind, speed);
  PetscCall(FluidDestroy(&fluid));
  PetscCall(MeshDestroy(&mesh));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(Rest(BOUNDARY_VELOCITY));
  PetscCall(Rest(BOUNDARY_FREE_SLIP));
  PetscCall(Rest(BOUNDARY_OPEN));
  PetscCall(PetscFinalize());
  return 0;
}
