// ranks: 1 2
/* Compressible phases in a closed box: the period of a standing wave of sound; a column of water that falls onto a cushion of gas
 * against the equation of motion of its mass between two springs (Bagnold 1939), on a mesh that stays and on one that adapts, and
 * with compressive advection; mass and volumes to round-off.  A mass below 0 is refused.
 * gas n steps: prints the standing wave; gas n dt steps: the cushion. */
#include "fluid/flow/fluid_impl.h"
#include "tests/fluid/adapting_tank.h"

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

/* The first mode along the box, of some steps a period. */
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
  CHECK(fabs(Mass(&t) / mass - 1.0) < 1e-13, "mass changes by %g of it", Mass(&t) / mass - 1.0);
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

#define BOTTOM 0.31
#define TOP 0.73
#define PRESSURE 2.0e4
#define EXPONENT 1.4
#define G 9.81

/* The column's lower end and its velocity. */
typedef struct {
  double h, v;
} Column;

/* Midpoint rule in small steps. */
static void MoveColumn(double dt, Column *c)
{
  const int parts = 100;
  for (int j = 0; j < parts; j++) {
    const double part = dt / parts, middle = c->h + 0.5 * c->v * part, below = pow(BOTTOM / middle, EXPONENT),
                 above = pow((1.0 - TOP) / (1.0 - TOP + BOTTOM - middle), EXPONENT);
    const double a = PRESSURE * (below - above) / (1000.0 * (TOP - BOTTOM)) - G;
    c->h += c->v * part + 0.5 * a * part * part;
    c->v += a * part;
  }
}

/* The first minimum and the maximum after it of a series. */
typedef struct {
  double last[2], time[2];
  int found;
} Turns;

static void Turn(Turns *t, int k, double dt, double now)
{
  const double rise = now - t->last[1], before = t->last[1] - t->last[0];
  if (k > 1 && t->found < 2 && (t->found ? rise < 0.0 && before > 0.0 : rise > 0.0 && before < 0.0))
    t->time[t->found++] = (k - 1 + 0.5 * (rise + before) / (before - rise)) * dt;
  t->last[0] = t->last[1];
  t->last[1] = now;
}

static PetscErrorCode CreateCushion(int n, Tank *t)
{
  const PhaseProperties p = {.n = 2,
                             .rho = {1000.0, 1.2},
                             .mu = {100.0, 1.8e-5},
                             .state = {{0.0, 0.0, 0.0}, {0.0, PRESSURE, EXPONENT}}};
  const Region region[3] = {{.shape = REGION_BOX, .phase = 1, .a = {-1, -1}, .b = {2, 2}},
                            {.shape = REGION_HALF_PLANE, .phase = 0, .a = {0.5, TOP}, .b = {0.0, 1.0}},
                            {.shape = REGION_HALF_PLANE, .phase = 1, .a = {0.5, BOTTOM}, .b = {0.0, 1.0}}};
  PetscFunctionBeginUser;
  PetscCall(TankCreatePhases(n, 2u, &p, 3, region, NULL, t));
  PetscFunctionReturn(0);
}

/* adapts: every third step, else never. */
static PetscErrorCode Cushion(int n, double dt, int steps, PetscBool adapts, int print)
{
  Column column = {BOTTOM, 0.0};
  Turns exact = {{BOTTOM, BOTTOM}, {0.0, 0.0}, 0}, found = exact;
  AdaptingTank m = {0};
  double worst = 0.0;
  GasSum start, now;
  PetscFunctionBeginUser;
  PetscCall(CreateCushion(n, &m.tank));
  PetscCall(AdaptationCreate(&TANK_ADAPTATION, &m.adaptation));
  PetscCall(SumGas(&m.tank, 0.5, &start));
  for (int k = 1; k <= steps; k++) {
    PetscCall(adapts ? AdaptingTankStep(&m, dt) : FluidStep(m.tank.fluid, dt));
    MoveColumn(dt, &column);
    PetscCall(SumGas(&m.tank, column.h + 0.2, &now));
    worst = fmax(worst, fabs(now.below - column.h));
    Turn(&exact, k, dt, column.h);
    Turn(&found, k, dt, now.below);
    CHECK(fabs(now.volume - start.volume) < 1e-13 && fabs(now.mass / start.mass - 1.0) < 1e-13,
          "step %d: the gas's volume has changed by %g m2, its mass by %g of it", k,
          now.volume - start.volume, now.mass / start.mass - 1.0);
    if (print && k % (steps / 10) == 0)
      PetscCall(PetscPrintf(PETSC_COMM_WORLD, "t %.4f: %.5f m, exact %.5f; mass %.1e, largest |u| %.3f m/s\n",
                            k * dt, now.below, column.h, now.mass / start.mass - 1.0, TankSpeed(&m.tank, 0)));
  }
  if (print)
    PetscCall(PetscPrintf(PETSC_COMM_WORLD,
                          "turns at %.4f, %.4f s, exact %.4f, %.4f; worst %.2e m; %d meshes\n", found.time[0],
                          found.time[1], exact.time[0], exact.time[1], worst, m.meshes));
  CHECK(worst < 0.1 * (BOTTOM - 0.2676), "the column is %g m from where it should be", worst);
  for (int k = 0; k < exact.found; k++)
    CHECK(fabs(found.time[k] / exact.time[k] - 1.0) < 0.01, "it turns at %g s in place of %g s",
          found.time[k], exact.time[k]);
  PetscCall(AdaptingTankDestroy(&m));
  PetscFunctionReturn(0);
}

static char reason[1024];

static PetscErrorCode Catch(MPI_Comm comm, int line, const char *function, const char *file,
                            PetscErrorCode code, PetscErrorType type, const char *message, void *context)
{
  if (message && type == PETSC_ERROR_INITIAL) snprintf(reason, sizeof reason, "%s", message);
  return code;
}

/* A mass below 0 is refused, with the phase and the place. */
static PetscErrorCode Impossible(void)
{
  const PhaseProperties p = {.n = 2,
                             .rho = {1000.0, 1.2},
                             .mu = {1e-3, 1.8e-5},
                             .state = {{0.0, 0.0, 0.0}, {0.0, PRESSURE, EXPONENT}},
                             .name = {"water", "air"}};
  const Region region = {.shape = REGION_BOX, .phase = 1, .a = {-1, -1}, .b = {2, 2}};
  PetscErrorCode code;
  char place[64];
  Tank t;
  PetscFunctionBeginUser;
  PetscCall(TankCreatePhases(6, 2u, &p, 1, &region, NULL, &t));
  double center[2] = {0.0, 0.0};
  for (int k = 0; k < 6; k++) center[k % 2] += t.mesh->x[2 * t.mesh->vertex[k / 2] + k % 2] / 3.0;
  PetscCall(PetscSNPrintf(place, sizeof place, "(%.4g, %.4g)", center[0], center[1]));
  PhasesMasses(PhaseTransportPhases(FluidPhases(t.fluid)))[1] = -1e-3;
  PetscCall(PetscPushErrorHandler(Catch, NULL));
  code = FluidPhasesChanged(t.fluid);
  PetscCall(PetscPopErrorHandler());
  CHECK(code == PETSC_ERR_ARG_OUTOFRANGE && strstr(reason, "'air' has -0.001 kg") && strstr(reason, place) &&
            strstr(reason, "time.dt_max"),
        "error %d: %s", (int)code, reason);
  PetscCall(TankDestroy(&t));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  if (argc == 3) {
    PetscCall(Standing(atoi(argv[1]), atoi(argv[2]), 1));
  } else if (argc > 3) {
    PetscCall(Cushion(atoi(argv[1]), atof(argv[2]), atoi(argv[3]), PETSC_FALSE, 1));
    PetscCall(Cushion(atoi(argv[1]), atof(argv[2]), atoi(argv[3]), PETSC_TRUE, 1));
  } else {
    PetscCall(Impossible());
    PetscCall(Standing(14, 100, 0));
    PetscCall(Cushion(12, 0.002, 150, PETSC_FALSE, 0));
    PetscCall(Cushion(8, 0.002, 80, PETSC_TRUE, 0));
    tank_advection = PHASES_COMPRESSIVE;
    PetscCall(Cushion(12, 0.002, 150, PETSC_FALSE, 0));
  }
  return PetscFinalize();
}
