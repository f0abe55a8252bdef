// ranks: 1 2
/* Manufactured solution: observed orders of velocity and pressure in space, and of velocity in time. */
#include "tests/fluid/exact.h"

static PetscErrorCode Errors(double h, double omega, double dt, int steps, double *velocity, double *pressure)
{
  Exact exact = {omega};
  Mesh *mesh;
  Fluid fluid;
  PetscFunctionBeginUser;
  PetscCall(SquareMesh(h, &mesh));
  PetscCall(ExactFluid(mesh, &exact, ExactSource, MU, &fluid));
  for (int k = 0; k < steps; k++) PetscCall(FluidStep(fluid, dt));
  /* the projection's pressure belongs to the middle of the last step */
  const double t[2] = {steps * dt, (steps - 0.5) * dt};
  PetscCall(ExactErrors(fluid, &exact, t, velocity, pressure));
  PetscCall(FluidDestroy(&fluid));
  PetscCall(MeshDestroy(&mesh));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  double u[3], p[3], h = 1.0 / 8.0, dt = 0.1;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "      h    velocity  order    pressure  order\n"));
  for (int k = 0; k < 3; k++, h /= 2.0) {
    PetscCall(Errors(h, 0.0, 0.25 * h, (int)(16.0 / h), &u[k], &p[k]));
    PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%7.4f  %10.3e  %5.2f  %10.3e  %5.2f\n", h, u[k],
                          k ? log2(u[k - 1] / u[k]) : 0.0, p[k], k ? log2(p[k - 1] / p[k]) : 0.0));
  }
  PetscCheck(log2(u[1] / u[2]) > 1.9, PETSC_COMM_WORLD, PETSC_ERR_PLIB, "velocity order in space below 1.9");
  PetscCheck(log2(p[1] / p[2]) > 1.9, PETSC_COMM_WORLD, PETSC_ERR_PLIB, "pressure order in space below 1.9");
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "     dt    velocity  order    pressure  order\n"));
  for (int k = 0; k < 3; k++, dt /= 2.0) {
    PetscCall(Errors(1.0 / 48.0, 4.0, dt, (int)(1.0 / dt + 0.5), &u[k], &p[k]));
    PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%7.4f  %10.3e  %5.2f  %10.3e  %5.2f\n", dt, u[k],
                          k ? log2(u[k - 1] / u[k]) : 0.0, p[k], k ? log2(p[k - 1] / p[k]) : 0.0));
  }
  PetscCheck(log2(u[1] / u[2]) > 1.8, PETSC_COMM_WORLD, PETSC_ERR_PLIB, "velocity order in time below 1.8");
  PetscCall(PetscFinalize());
  return 0;
}
