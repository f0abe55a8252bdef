// ranks: 1 2 3
/* Still water below air, 1060 : 1.2 kg/m3, on a random mesh stays still: level, and with gravity normal to a slope.
 * still_tank n steps viscosity: prints. */
#include "tests/fluid/tank.h"

static PetscErrorCode Still(int n, unsigned seed, int steps, double viscosity, int print)
{
  const Region region[2] = {{.shape = REGION_BOX, .phase = 1, .a = {-1, -1}, .b = {2, 2}},
                            {.shape = REGION_HALF_PLANE, .phase = 0, .a = {0.5, 0.473}, .b = {0.0, 1.0}}};
  const double dt = 0.005;
  double worst = 0.0;
  Tank t;
  PetscFunctionBeginUser;
  PetscCall(TankCreate(n, seed, viscosity, 2, region, &t));
  for (int k = 0; k < steps; k++) {
    PetscCall(FluidStep(t.fluid, dt));
    const double now = TankSpeed(&t, 0);
    worst = fmax(worst, now);
    if (print && (k < 5 || k % (steps / 10) == 0))
      PetscCall(PetscPrintf(PETSC_COMM_WORLD, "seed %u step %d: %.2e m/s\n", seed, k, now));
  }
  CHECK(worst < 1e-6 * sqrt(9.81), "still water moves at %g m/s", worst);
  PetscCall(TankDestroy(&t));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  if (argc > 3) {
    for (unsigned seed = 1; seed <= 3; seed++)
      PetscCall(Still(atoi(argv[1]), seed, atoi(argv[2]), atof(argv[3]), 1));
  } else {
    PetscCall(Still(8, 4u, 50, 0.001, 0));
  }
  return PetscFinalize();
}
