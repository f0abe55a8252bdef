// ranks: 1 2 3
/* A compressible phase.  Any argument: prints. */
#include "tests/fluid/tank.h"

#define SOUND 340.0
#define GAS 1.2

static void Mode(void *context, double t, const double x[2], double v[])
{
  (void)context, (void)t;
  v[0] = 0.1 * sin(M_PI * x[0]);
  v[1] = 0.0;
}

/* Share of the mode in the velocity. */
static double Amplitude(const Tank *t)
{
  const double *u = FluidVelocity(t->fluid);
  double sum = 0.0;
  for (int e = 0; e < t->mesh->ne; e++)
    for (int i = 0; i < 3; i++)
      sum += ElementArea(t->mesh, e) / 3.0 * 2.0 * u[6 * e + i] *
             sin(M_PI * t->mesh->x[2 * t->mesh->vertex[3 * e + i]]);
  MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, t->mesh->comm);
  return sum / 0.1;
}

static double Mass(const Tank *t)
{
  const Phases f = PhaseTransportPhases(FluidPhases(t->fluid));
  double sum = 0.0;
  for (int e = 0; e < t->mesh->ne; e++) sum += PhasesMasses(f)[2 * e + 1];
  MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, t->mesh->comm);
  return sum;
}

static PetscErrorCode Standing(int cells, int steps_a_period, int print)
{
  const PhaseProperties p = {.n = 2,
                             .rho = {1000.0, GAS},
                             .mu = {1e-3, 1.8e-5},
                             .state = {{0.0, 0.0, 0.0}, {0.0, GAS * SOUND * SOUND, 1.0}}};
  const Region region = {.shape = REGION_BOX, .phase = 1, .a = {-1, -1}, .b = {2, 2}};
  const double period = 2.0 / SOUND, dt = period / steps_a_period;
  double before = 1.0, crossing[4] = {0.0}, mass;
  int n = 0;
  Tank t;
  PetscFunctionBeginUser;
  PetscCall(TankCreatePhases(cells, 2u, &p, 1, &region, NULL, &t));
  PetscCall(FluidSetInitial(t.fluid, 0.0, Mode, NULL, NULL));
  mass = Mass(&t);
  for (int k = 1; n < 4 && k < 3 * steps_a_period; k++) {
    PetscCall(FluidStep(t.fluid, dt));
    const double now = Amplitude(&t);
    if (print && k % (steps_a_period / 10) == 0)
      PetscCall(PetscPrintf(PETSC_COMM_WORLD, "t/T %.3f: %.4f, pressure iterations %d\n", k * dt / period,
                            now, FluidGetStats(t.fluid)->pressure_iterations));
    if (now * before < 0.0) crossing[n++] = (k - now / (now - before)) * dt / period;
    before = now;
  }
  if (print)
    PetscCall(PetscPrintf(PETSC_COMM_WORLD, "crossings %g %g %g %g; mass changed by %.1e of it\n",
                          crossing[0], crossing[1], crossing[2], crossing[3], Mass(&t) / mass - 1.0));
  CHECK(n == 4 && fabs(crossing[2] - crossing[0] - 1.0) < 0.01, "a period of %g", crossing[2] - crossing[0]);
  PetscCall(TankDestroy(&t));
  PetscFunctionReturn(0);
}

/* Of the gas, m2 and kg, and of all its parts below the middle of the water. */
typedef struct {
  double volume, mass, below;
} GasSum;

static PetscErrorCode SumGas(const Tank *t, double middle, GasSum *sum)
{
  const Phases f = PhaseTransportPhases(FluidPhases(t->fluid));
  const double *volume;
  PetscFunctionBeginUser;
  PetscCall(PhasesGetVolumes(f, &volume));
  *sum = (GasSum){0.0, 0.0, 0.0};
  for (int e = 0; e < t->mesh->ne; e++) {
    sum->volume += volume[2 * e + 1];
    sum->mass += PhasesMasses(f)[2 * e + 1];
    if (t->mesh->x[2 * t->mesh->vertex[3 * e] + 1] < middle) sum->below += volume[2 * e + 1];
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sum, 3, MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD));
  PetscFunctionReturn(0);
}

/* A column of water falls in a closed tube onto the gas below it, which it compresses, while that above expands. */
static PetscErrorCode Cushion(int n, double dt, int steps, int print)
{
  const double bottom = 0.31, top = 0.73, pressure = 2.0e4, exponent = 1.4, g = 9.81;
  const PhaseProperties p = {.n = 2,
                             .rho = {1000.0, 1.2},
                             .mu = {100.0, 1.8e-5},
                             .state = {{0.0, 0.0, 0.0}, {0.0, pressure, exponent}}};
  const Region region[3] = {{.shape = REGION_BOX, .phase = 1, .a = {-1, -1}, .b = {2, 2}},
                            {.shape = REGION_HALF_PLANE, .phase = 0, .a = {0.5, top}, .b = {0.0, 1.0}},
                            {.shape = REGION_HALF_PLANE, .phase = 1, .a = {0.5, bottom}, .b = {0.0, 1.0}}};
  const double column = 1000.0 * (top - bottom);
  double h = bottom, v = 0.0, worst = 0.0;
  GasSum start, now;
  Tank t;
  PetscFunctionBeginUser;
  PetscCall(TankCreatePhases(n, 2u, &p, 3, region, NULL, &t));
  PetscCall(SumGas(&t, 0.5, &start));
  for (int k = 1; k <= steps; k++) {
    PhasesStats stats;
    PetscCall(FluidStep(t.fluid, dt));
    for (int j = 0; j < 100; j++) { /* the ODE */
      const double middle = h + 0.5 * v * dt / 100;
      const double a =
          pressure / column *
              (pow(bottom / middle, exponent) - pow((1.0 - top) / (1.0 - top + bottom - middle), exponent)) -
          g;
      h += v * dt / 100 + 0.5 * a * (dt / 100) * (dt / 100);
      v += a * dt / 100;
    }
    PetscCall(PhasesGetStats(PhaseTransportPhases(FluidPhases(t.fluid)), &stats));
    PetscCall(SumGas(&t, h + 0.2, &now));
    worst = fmax(worst, fabs(now.below - h));
    if (print && k % (steps / 20) == 0)
      PetscCall(PetscPrintf(
          PETSC_COMM_WORLD,
          "t %.4f: gas below %.5f m2, ODE %.5f, all %.1e, mass %.1e, water %.2e, gap %.1e, lowest "
          "%.1e, |u| %.3f, v %.3f\n",
          k * dt, now.below, h, now.volume - start.volume, now.mass / start.mass - 1.0,
          stats.volume[0] - (top - bottom), stats.gap, stats.lowest, TankSpeed(&t, 0), v));
  }
  PetscCall(TankDestroy(&t));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  if (argc > 3)
    PetscCall(Cushion(atoi(argv[1]), atof(argv[2]), atoi(argv[3]), 1));
  else if (argc > 2)
    PetscCall(Standing(atoi(argv[1]), atoi(argv[2]), 1));
  else
    PetscCall(Standing(10, 200, argc > 1));
  return PetscFinalize();
}
