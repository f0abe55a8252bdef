// ranks: 1 2 3
/* A still tank of water below air, 1060 : 1.2 kg/m3, on a mesh that knows nothing of the surface: the first
 * step's velocity over g dt.  With the sub-cell mass matrix and its kinks or ridges it is at rest; with
 * neither it is not.  It stays at rest while the interface moves with what is left.  still print: says how
 * much. */
#include "tests/phases/tank.h"

static int print;

static PetscErrorCode FirstStep(unsigned seed, int form)
{
  static const char *const NAME[FORMS] = {"one density an element", "sub-cell mass",
                                          "sub-cell mass and ridges", "sub-cell mass and kinks"};
  const double slope = seed == 3 ? 0.31 : 0.0, dt = 0.01;
  const Region region[2] = {{.shape = REGION_BOX, .phase = 1, .a = {-1, -1}, .b = {2, 2}},
                            {.shape = REGION_HALF_PLANE, .phase = 0, .a = {0.5, 0.473}, .b = {-slope, 1.0}}};
  int iterations;
  Tank t;
  PetscFunctionBeginUser;
  PetscCall(TankMake(16, seed, slope, 2, region, &t));
  PetscCall(TankInertia(form, &t));
  PetscCall(TankStep(&t, form, dt, &iterations));
  const double speed = TankSpeed(&t) / (9.81 * dt);
  if (print)
    PetscCall(PetscPrintf(PETSC_COMM_WORLD, "seed %u, %-26s largest |u|/(g dt) %.1e, %d iterations\n", seed,
                          NAME[form], speed, iterations));
  CHECK(form >= RIDGE ? speed < 1e-8 : speed > 0.1, "%s: largest |u|/(g dt) is %g", NAME[form], speed);
  PetscCall(TankDestroy(&t));
  PetscFunctionReturn(0);
}

static PetscErrorCode March100(void)
{
  const Region region[2] = {{.shape = REGION_BOX, .phase = 1, .a = {-1, -1}, .b = {2, 2}},
                            {.shape = REGION_HALF_PLANE, .phase = 0, .a = {0.5, 0.473}, .b = {0.0, 1.0}}};
  const double dt = 0.01;
  double worst = 0.0, defect;
  int iterations;
  Tank t;
  PetscFunctionBeginUser;
  PetscCall(TankMake(10, 4u, 0.0, 2, region, &t));
  PetscCall(TankInertia(KINK, &t));
  for (int k = 0; k < 100; k++) {
    PetscCall(TankStep(&t, KINK, dt, &iterations));
    worst = fmax(worst, TankSpeed(&t));
    PetscCall(TankMove(KINK, &t, dt, &defect));
  }
  if (print) PetscCall(PetscPrintf(PETSC_COMM_WORLD, "100 steps: largest |u| %.1e m/s\n", worst));
  CHECK(worst < 1e-6 * sqrt(9.81), "still water moves at %g m/s", worst);
  PetscCall(TankDestroy(&t));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  print = argc > 1;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  for (unsigned seed = 1; seed <= 3; seed++) {
    for (int form = MEAN; form < FORMS; form++) PetscCall(FirstStep(seed, form));
  }
  PetscCall(March100());
  return PetscFinalize();
}
