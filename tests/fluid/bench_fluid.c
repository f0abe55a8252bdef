/* Time per step of the fluid alone, split; and velocity unknowns per second.  bench_fluid -h 0.01 -steps 20
 */
#include "tests/fluid/exact.h"

int main(int argc, char **argv)
{
  double h = 0.01, mu = MU, dt, t0, seconds;
  PetscInt steps = 20, warm = 3;
  Exact exact = {1.0};
  Mesh *mesh;
  Fluid fluid;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(PetscOptionsGetReal(NULL, NULL, "-h", &h, NULL));
  PetscCall(PetscOptionsGetInt(NULL, NULL, "-steps", &steps, NULL));
  PetscCall(PetscOptionsGetReal(NULL, NULL, "-mu", &mu, NULL));
  PetscCall(SquareMesh(h, &mesh));
  PetscCall(ExactFluid(mesh, &exact, NULL, mu, &fluid));
  dt = 0.5 * h;
  for (int k = 0; k < warm; k++) PetscCall(FluidStep(fluid, dt));
  const FluidStats before = *FluidGetStats(fluid);
  int iterations = 0;
  t0 = MPI_Wtime();
  for (int k = 0; k < steps; k++) {
    PetscCall(FluidStep(fluid, dt));
    iterations += FluidGetStats(fluid)->momentum_iterations;
  }
  seconds = (MPI_Wtime() - t0) / steps;
  const FluidStats *after = FluidGetStats(fluid);
  PetscCall(
      PetscPrintf(PETSC_COMM_WORLD,
                  "triangles %d  step %.4f s  assembly %.4f  momentum %.4f (%.1f iterations)  pressure %.4f  "
                  "velocity unknowns/s %.3g\n",
                  (int)mesh->nglobal, seconds, (after->seconds[0] - before.seconds[0]) / steps,
                  (after->seconds[1] - before.seconds[1]) / steps, (double)iterations / steps,
                  (after->seconds[2] - before.seconds[2]) / steps, 6.0 * mesh->nglobal / seconds));
  PetscCall(FluidDestroy(&fluid));
  PetscCall(MeshDestroy(&mesh));
  PetscCall(PetscFinalize());
  return 0;
}
