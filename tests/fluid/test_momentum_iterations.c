// ranks: 1 2 3
/* The momentum equation takes about as many iterations whether viscosity spreads within a step over a hundredth
 * of an element or over many: mu dt/(rho h^2) from 0.01 to 100. */
#include "tests/fluid/exact.h"

#define H 0.04
#define ITERATIONS_MAX 7 /* of GMRES, to 1e-5; measured 4 to 6 on one, two and three ranks */

int main(int argc, char **argv)
{
  Exact exact = {1.0};
  Mesh *mesh;
  Fluid fluid;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(SquareMesh(H, &mesh));
  for (double number = 0.01; number < 200.0; number *= 10.0) {
    const double dt = 0.5 * H;
    PetscCall(ExactFluid(mesh, &exact, NULL, number * RHO * H * H / dt, &fluid));
    int most = 0;
    for (int k = 0; k < 4; k++) {
      PetscCall(FluidStep(fluid, dt));
      most = PetscMax(most, FluidGetStats(fluid)->momentum_iterations);
    }
    PetscCheck(most <= ITERATIONS_MAX, PETSC_COMM_SELF, PETSC_ERR_PLIB,
               "mu dt/(rho h^2) = %g: %d iterations, expected %d at most", number, most, ITERATIONS_MAX);
    if (argc > 1) PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%g: %d iterations\n", number, most));
    PetscCall(FluidDestroy(&fluid));
  }
  PetscCall(MeshDestroy(&mesh));
  PetscCall(PetscFinalize());
  return 0;
}
