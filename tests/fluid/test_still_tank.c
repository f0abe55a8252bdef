// ranks: 1 2 3
/* Still water below air, 1060 : 1.2 kg/m3, on a random mesh stays still, also where it is not quite level: between walls, and with sides open to
 * water at the same level; water flows in where that is higher outside, as it does where the level swings from step to step and is
 * the same in their middle; with either advection of the phases.
 * still_tank n steps viscosity, still_tank sway n seed dt end: print. */
#include "tests/fluid/tank.h"

#define LEVEL 0.473

static double Water(const Tank *t)
{
  double water = 0.0;
  for (int e = 0; e < t->mesh->ne; e++) {
    const double *x[3];
    for (int i = 0; i < 3; i++) x[i] = t->mesh->x + 2 * t->mesh->vertex[3 * e + i];
    const double area =
        0.5 * ((x[1][0] - x[0][0]) * (x[2][1] - x[0][1]) - (x[1][1] - x[0][1]) * (x[2][0] - x[0][0]));
    water += area * (FluidDensity(t->fluid)[e] - AIR) / (WATER - AIR);
  }
  MPI_Allreduce(MPI_IN_PLACE, &water, 1, MPI_DOUBLE, MPI_SUM, t->mesh->comm);
  return water;
}

/* It comes no faster than it falls: sqrt(2 g above). */
static PetscErrorCode Higher(int n, unsigned seed)
{
  const double above = 0.05, dt = 0.002, time = 0.1;
  const Region region[2] = {{.shape = REGION_BOX, .phase = 1, .a = {-1, -1}, .b = {2, 2}},
                            {.shape = REGION_HALF_PLANE, .phase = 0, .a = {0.5, LEVEL}, .b = {0.0, 1.0}}};
  Tank t;
  PetscFunctionBeginUser;
  PetscCall(TankCreateOpen(n, seed, 0.001, 2, region, PETSC_TRUE, LEVEL + above, &t));
  for (int k = 0; k * dt < time; k++) PetscCall(FluidStep(t.fluid, dt));
  const double gain = Water(&t) - LEVEL;
  CHECK(gain > 0.01 * above, "%g m2 of water have come in", gain);
  CHECK(gain < 2.0 * (LEVEL + above) * sqrt(2.0 * 9.81 * above) * time, "%g m2 of water have come in", gain);
  PetscCall(TankDestroy(&t));
  PetscFunctionReturn(0);
}

/* Water that falls into a tank of air through its sides, across the level in one element and step: no density below that of air. */
static PetscErrorCode Dry(int n, unsigned seed)
{
  const Region region = {.shape = REGION_BOX, .phase = 1, .a = {-1, -1}, .b = {2, 2}};
  Tank t;
  PetscFunctionBeginUser;
  PetscCall(TankCreateOpen(n, seed, 0.001, 1, &region, PETSC_TRUE, LEVEL, &t));
  for (int k = 0; k < 8; k++) {
    PetscCall(FluidStep(t.fluid, fmin(0.01, 0.5 / n / fmax(TankSpeed(&t, 0), 1e-3))));
    for (int e = 0; e < t.mesh->ne; e++)
      CHECK(FluidDensity(t.fluid)[e] > AIR * (1.0 - 1e-6) && FluidDensity(t.fluid)[e] < WATER * (1.0 + 1e-6),
            "a density of %.12g kg/m3 after step %d", FluidDensity(t.fluid)[e], k);
  }
  CHECK(Water(&t) > 0.0, "no water has come in");
  PetscCall(TankDestroy(&t));
  PetscFunctionReturn(0);
}

#define SWINGS 12
#define STEP 0.005

/* The water, m2, that has come into a tank after SWINGS steps, and its speed, m/s. */
static PetscErrorCode After(int n, unsigned seed, const TankOutside *outside, double *water, double *speed)
{
  const Region region[2] = {{.shape = REGION_BOX, .phase = 1, .a = {-1, -1}, .b = {2, 2}},
                            {.shape = REGION_HALF_PLANE, .phase = 0, .a = {0.5, LEVEL}, .b = {0.0, 1.0}}};
  const PhaseProperties phases = {.n = 2, .rho = {WATER, AIR}, .mu = {0.001, 0.001}};
  Tank t;
  PetscFunctionBeginUser;
  PetscCall(TankCreatePhases(n, seed, &phases, 2, region, outside, &t));
  for (int k = 0; k < SWINGS; k++) PetscCall(FluidStep(t.fluid, STEP));
  *water = Water(&t) - LEVEL;
  *speed = TankSpeed(&t, 0);
  PetscCall(TankDestroy(&t));
  PetscFunctionReturn(0);
}

/* What counts of a level that depends on time is the middle of the steps: at their ends this one is 0.02 m above or below.  The
 * pressure holds still water, and as much water comes in where it stands higher outside (but for what round-off makes of lines,
 * 0.2 %; with the level of the steps' start 13 %). */
static PetscErrorCode Swinging(int n, unsigned seed, double above)
{
  double row[SWINGS + 1][2], water[2], speed[2];
  const TankOutside constant = {.nlevels = 1, .level = {LEVEL + above}},
                    swings = {.nlevels = 1, .level_table = {{SWINGS + 1, 2, row[0]}}};
  PetscFunctionBeginUser;
  for (int k = 0; k <= SWINGS; k++) {
    row[k][0] = k * STEP;
    row[k][1] = LEVEL + above + (k % 2 ? -0.02 : 0.02);
  }
  PetscCall(After(n, seed, &constant, &water[0], &speed[0]));
  PetscCall(After(n, seed, &swings, &water[1], &speed[1]));
  CHECK(above > 0.0 || speed[1] < 1e-6 * sqrt(9.81),
        "still water moves at %g m/s, beside a level that swings from step to step", speed[1]);
  CHECK(fabs(water[1] - water[0]) < 0.02 * fabs(water[0]) + 1e-9,
        "%g m2 of water have come in, %g with a level that swings from step to step", water[0], water[1]);
  PetscFunctionReturn(0);
}

static PetscErrorCode Still(int n, unsigned seed, int steps, double viscosity, PetscBool open, int print)
{
  const Region region[2] = {{.shape = REGION_BOX, .phase = 1, .a = {-1, -1}, .b = {2, 2}},
                            {.shape = REGION_HALF_PLANE, .phase = 0, .a = {0.5, LEVEL}, .b = {0.0, 1.0}}};
  const double dt = 0.005;
  double worst = 0.0;
  Tank t;
  PetscFunctionBeginUser;
  PetscCall(TankCreateOpen(n, seed, viscosity, 2, region, open, LEVEL, &t));
  for (int k = 0; k < steps; k++) {
    PetscCall(FluidStep(t.fluid, dt));
    const double now = TankSpeed(&t, 0);
    worst = fmax(worst, now);
    if (print && (k < 5 || k % (steps / 10) == 0))
      PetscCall(PetscPrintf(PETSC_COMM_WORLD, "seed %u step %d: %.2e m/s\n", seed, k, now));
  }
  CHECK(worst < 1e-6 * sqrt(9.81), "still water moves at %g m/s, %s sides", worst, open ? "open" : "closed");
  PetscCall(TankDestroy(&t));
  PetscFunctionReturn(0);
}

enum { TENTHS = 10 };

/* Water that is not quite level moves no faster at the end than at the start.  (Without viscosity beside the interface 140 and 37 000 times as fast on the meshes of seeds 4 and 7.) */
static PetscErrorCode Swaying(int n, unsigned seed, double dt, double end, int print)
{
  const Region region[2] = {{.shape = REGION_BOX, .phase = 1, .a = {-1, -1}, .b = {2, 2}},
                            {.shape = REGION_HALF_PLANE, .phase = 0, .a = {0.5, LEVEL}, .b = {1e-6, 1.0}}};
  const int steps = (int)(end / dt + 0.5);
  double fastest[TENTHS] = {0.0};
  Tank t;
  PetscFunctionBeginUser;
  PetscCall(TankCreate(n, seed, 0.001, 2, region, &t));
  for (int k = 0; k < steps; k++) {
    double *now = &fastest[k * TENTHS / steps];
    PetscCall(FluidStep(t.fluid, dt));
    *now = fmax(*now, TankSpeed(&t, 0));
  }
  for (int k = 0; k < TENTHS && print; k++)
    PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%.1e%s", fastest[k], k + 1 < TENTHS ? " " : " m/s\n"));
  CHECK(print || fastest[TENTHS - 1] < 5.0 * fastest[0], "speeds grow from %g to %g m/s", fastest[0],
        fastest[TENTHS - 1]);
  PetscCall(TankDestroy(&t));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  if (argc > 5) {
    PetscCall(Swaying(atoi(argv[2]), (unsigned)atoi(argv[3]), atof(argv[4]), atof(argv[5]), 1));
  } else if (argc > 3) {
    for (unsigned seed = 1; seed <= 3; seed++)
      PetscCall(Still(atoi(argv[1]), seed, atoi(argv[2]), atof(argv[3]), PETSC_FALSE, 1));
  } else {
    for (int k = 0; k < 2; k++) {
      tank_advection = k ? PHASES_COMPRESSIVE : PHASES_GEOMETRIC;
      PetscCall(Still(8, 4u, 50, 0.001, PETSC_FALSE, 0));
      PetscCall(Still(8, 4u, 50, 0.001, PETSC_TRUE, 0));
      PetscCall(Swinging(8, 4u, 0.0));
      PetscCall(Swinging(8, 4u, 0.05));
      PetscCall(Higher(8, 4u));
      for (unsigned seed = 1u; seed < 4u; seed++) PetscCall(Dry(8, seed));
    }
    tank_advection = PHASES_GEOMETRIC;
    PetscCall(Swaying(20, 6u, 0.01, 8.0, 0));
    PetscCall(Swaying(20, 4u, 0.02, 8.0, 0));
    PetscCall(Swaying(20, 7u, 0.02, 8.0, 0));
  }
  return PetscFinalize();
}
