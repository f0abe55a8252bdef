// ranks: 1 2
/* Three phases, 1060 : 800 : 1.2 kg/m3: layers at rest stay at rest in any order of the phases, also where the middle one is
 * thinner than an element, between walls and with sides open to the same layers, and through adaptations; two phases written
 * as three, one of them empty, are two; a drop of one phase rises out of another one into the third; with either advection of the
 * phases.  Any argument: prints. */
#include "tests/fluid/adapting_tank.h"

#define OIL 800.0
#define LOW 0.373
#define STILL (1e-6 * 3.132) /* sqrt(g H), m/s */

/* Properties and layers with the phases' numbers chosen: water below LOW, oil below `high`, air. */
typedef struct {
  PhaseProperties phases;
  Region region[3];
  TankOutside outside;
} Layers;

static Layers MakeLayers(const int number[3], double high)
{
  const double rho[3] = {WATER, OIL, AIR}, mu[3] = {1e-3, 2e-3, 1.8e-5}, top[2] = {LOW, high};
  Layers l = {.phases.n = 3, .outside.nlevels = 2};
  for (int k = 0; k < 3; k++) {
    l.phases.rho[number[k]] = rho[k];
    l.phases.mu[number[k]] = mu[k];
  }
  l.region[0] = (Region){.shape = REGION_BOX, .phase = number[2], .a = {-1, -1}, .b = {2, 2}};
  for (int k = 0; k < 2; k++) {
    l.region[2 - k] =
        (Region){.shape = REGION_HALF_PLANE, .phase = number[k], .a = {0.5, top[k]}, .b = {0.0, 1.0}};
    l.outside.level_phase[k] = number[k];
    l.outside.level[k] = top[k];
  }
  return l;
}

static PetscErrorCode Still(const int number[3], double high, PetscBool open, int print)
{
  const Layers l = MakeLayers(number, high);
  double worst = 0.0;
  Tank t;
  PetscFunctionBeginUser;
  PetscCall(TankCreatePhases(8, 4u, &l.phases, 3, l.region, open ? &l.outside : NULL, &t));
  for (int k = 0; k < 20; k++) {
    PetscCall(FluidStep(t.fluid, 0.005));
    worst = fmax(worst, TankSpeed(&t, 0));
  }
  if (print)
    PetscCall(PetscPrintf(PETSC_COMM_WORLD, "order %d %d %d, oil up to %g, %s sides: %.1e m/s\n", number[0],
                          number[1], number[2], high, open ? "open" : "closed", worst));
  CHECK(worst < STILL, "layers of order %d %d %d, the second up to %g, %s sides, move at %g m/s", number[0],
        number[1], number[2], high, open ? "open" : "closed", worst);
  PetscCall(TankDestroy(&t));
  PetscFunctionReturn(0);
}

/* Elements of water and oil, two vertices of which have the interface of oil and air around them, with a trace of air, as advection may leave one. */
static PetscErrorCode Traced(int print)
{
  const int number[3] = {0, 1, 2};
  const Layers l = MakeLayers(number, 0.387);
  const double *volume;
  double worst = 0.0, *traced;
  int n = 0, *near;
  Tank t;
  PetscFunctionBeginUser;
  PetscCall(TankCreatePhases(16, 3u, &l.phases, 3, l.region, NULL, &t));
  Phases phases = PhaseTransportPhases(FluidPhases(t.fluid));
  PetscCall(PhasesGetVolumes(phases, &volume));
  PetscCall(PetscMalloc1(3 * (size_t)t.mesh->ne, &traced));
  PetscCall(PetscCalloc1(t.mesh->nv, &near));
  for (int e = 0; e < t.mesh->ne; e++) {
    const double little = 0.01 * ElementArea(t.mesh, e), *v = volume + 3 * (size_t)e;
    for (int i = 0; i < 3; i++) near[t.mesh->vertex[3 * e + i]] |= v[1] > little && v[2] > little;
  }
  for (int e = 0; e < t.mesh->ne; e++) {
    const double trace = 1e-11 * ElementArea(t.mesh, e), *v = volume + 3 * (size_t)e;
    const int *vertex = t.mesh->vertex + 3 * e,
              around = near[vertex[0]] + near[vertex[1]] + near[vertex[2]] > 1;
    const int mixed = around && v[0] > trace && v[1] > 2.0 * trace && v[2] < trace;
    for (int p = 0; p < 3; p++) traced[3 * e + p] = v[p] + (mixed ? trace * (p == 1 ? -1.0 : p == 2) : 0.0);
    n += mixed;
  }
  PetscCall(PhasesSetVolumes(phases, traced));
  PetscCall(PhasesReconstruct(phases));
  PetscCall(PetscFree(traced));
  PetscCall(PetscFree(near));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &n, 1, MPI_INT, MPI_SUM, PETSC_COMM_WORLD));
  for (int k = 0; k < 4; k++) {
    PetscCall(FluidStep(t.fluid, 0.005));
    worst = fmax(worst, TankSpeed(&t, 0));
  }
  if (print) PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%d elements with a trace: %.1e m/s\n", n, worst));
  CHECK(n > 0 && worst < STILL, "%d elements have a trace of a phase, layers move at %g m/s", n, worst);
  PetscCall(TankDestroy(&t));
  PetscFunctionReturn(0);
}

/* The volumes, m2, of all ranks. */
static PetscErrorCode Volumes(const Tank *t, double volume[3])
{
  PhasesStats stats;
  PetscFunctionBeginUser;
  PetscCall(PhasesGetStats(PhaseTransportPhases(FluidPhases(t->fluid)), &stats));
  for (int p = 0; p < 3; p++) volume[p] = stats.volume[p];
  PetscFunctionReturn(0);
}

static PetscErrorCode Adapted(int print)
{
  const int number[3] = {0, 1, 2};
  const Layers l = MakeLayers(number, 0.387);
  double worst = 0.0, before[3], after[3];
  AdaptingTank m = {0};
  PetscFunctionBeginUser;
  PetscCall(TankCreatePhases(10, 3u, &l.phases, 3, l.region, NULL, &m.tank));
  PetscCall(AdaptationCreate(&TANK_ADAPTATION, &m.adaptation));
  PetscCall(Volumes(&m.tank, before));
  for (int k = 0; k < 12; k++) {
    PetscCall(AdaptingTankStep(&m, 0.005));
    worst = fmax(worst, TankSpeed(&m.tank, 0));
  }
  PetscCall(Volumes(&m.tank, after));
  if (print)
    PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%d meshes: %.1e m/s, volumes changed by %.1e %.1e %.1e\n",
                          m.meshes, worst, after[0] - before[0], after[1] - before[1], after[2] - before[2]));
  CHECK(m.meshes == 4 && worst < STILL, "%d meshes, layers move at %g m/s", m.meshes, worst);
  for (int p = 0; p < 3; p++)
    CHECK(fabs(after[p] - before[p]) < 1e-12, "phase %d changes by %g m2", p, after[p] - before[p]);
  PetscCall(AdaptingTankDestroy(&m));
  PetscFunctionReturn(0);
}

/* A column of water and air, with an empty phase that has this number; *x: a mean of the velocities. */
static PetscErrorCode Column(int empty, double *x)
{
  const int water = empty == 0, air = empty == 2 ? 1 : 2;
  PhaseProperties p = {.n = 3, .rho = {OIL, OIL, OIL}, .mu = {1e-3, 1e-3, 1e-3}};
  Region region[2] = {{.shape = REGION_BOX, .phase = air, .a = {-1, -1}, .b = {2, 2}},
                      {.shape = REGION_BOX, .phase = water, .a = {-1, -1}, .b = {0.3, 0.6}}};
  double sum[2] = {0.0, 0.0};
  Tank t;
  PetscFunctionBeginUser;
  if (empty < 0) {
    p.n = 2;
    region[0].phase = 1;
    region[1].phase = 0;
  }
  p.rho[region[1].phase] = WATER;
  p.rho[region[0].phase] = AIR;
  p.mu[region[0].phase] = 1.8e-5;
  PetscCall(TankCreatePhases(10, 5u, &p, 2, region, NULL, &t));
  for (int k = 0; k < 8; k++) PetscCall(FluidStep(t.fluid, 0.004));
  for (int k = 0; k < 6 * t.mesh->ne; k++) {
    sum[0] += fabs(FluidVelocity(t.fluid)[k]);
    sum[1] += 1.0;
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sum, 2, MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD));
  *x = sum[0] / sum[1];
  PetscCall(TankDestroy(&t));
  PetscFunctionReturn(0);
}

static PetscErrorCode Empty(int print)
{
  double two, three;
  PetscFunctionBeginUser;
  PetscCall(Column(-1, &two));
  for (int empty = 0; empty < 3; empty++) {
    PetscCall(Column(empty, &three));
    if (print)
      PetscCall(
          PetscPrintf(PETSC_COMM_WORLD, "phase %d empty: %.15g m/s, two phases %.15g\n", empty, three, two));
    CHECK(fabs(three - two) < 1e-9 * two,
          "with phase %d empty the velocity is %.12g m/s, of two phases %.12g", empty, three, two);
  }
  PetscFunctionReturn(0);
}

/* The drop's centre, m. */
static PetscErrorCode Height(const Tank *t, int phase, double *y)
{
  double sum[2] = {0.0, 0.0};
  PetscFunctionBeginUser;
  for (int e = 0; e < t->mesh->ne; e++) {
    Polygon part;
    PetscCall(PhasesGetPolygon(PhaseTransportPhases(FluidPhases(t->fluid)), e, phase, &part));
    for (int k = 1; k + 1 < part.n; k++) {
      const double area = 0.5 * GeometryTurn(part.x[0], part.x[k], part.x[k + 1]);
      sum[0] += area;
      sum[1] += area / 3.0 * (part.x[0][1] + part.x[k][1] + part.x[k + 1][1]);
    }
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sum, 2, MPI_DOUBLE, MPI_SUM, t->mesh->comm));
  *y = sum[1] / sum[0];
  PetscFunctionReturn(0);
}

/* With surface tension between all three: a drop that starts below the interface at 0.5 m. */
static PetscErrorCode Rise(int print)
{
  const PhaseProperties p = {.n = 3,
                             .rho = {1000.0, 700.0, 300.0},
                             .mu = {2.0, 2.0, 1.0},
                             .surface_tension = {{{0.0, 5.0, 8.0}, {5.0, 0.0, 6.0}, {8.0, 6.0, 0.0}}}};
  const Region region[3] = {{.shape = REGION_BOX, .phase = 1, .a = {-1, -1}, .b = {2, 2}},
                            {.shape = REGION_HALF_PLANE, .phase = 0, .a = {0.5, 0.5}, .b = {0.0, 1.0}},
                            {.shape = REGION_DISC, .phase = 2, .a = {0.503, 0.32}, .radius = 0.12}};
  double before[3], after[3], y, t = 0.0;
  int steps = 0;
  Tank tank;
  PetscFunctionBeginUser;
  PetscCall(TankCreatePhases(16, 6u, &p, 3, region, NULL, &tank));
  PetscCall(Volumes(&tank, before));
  for (; t < 0.9; steps++) {
    double dt = fmin(FluidTimeStep(tank.fluid), 0.01);
    PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &dt, 1, MPI_DOUBLE, MPI_MIN, PETSC_COMM_WORLD));
    PetscCall(FluidStep(tank.fluid, dt));
    t += dt;
    if (print && steps % 20 == 0) {
      PetscCall(Height(&tank, 2, &y));
      PetscCall(PetscPrintf(PETSC_COMM_WORLD, "t %.3f dt %.1e: drop at %.4f m, largest |u| %.3f m/s\n", t, dt,
                            y, TankSpeed(&tank, 0)));
    }
  }
  PetscCall(Volumes(&tank, after));
  PetscCall(Height(&tank, 2, &y));
  if (print)
    PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%d steps, drop at %.4f m, volumes changed by %.1e %.1e %.1e\n",
                          steps, y, after[0] - before[0], after[1] - before[1], after[2] - before[2]));
  CHECK(y > 0.6, "after %g s the drop is at %g m", t, y);
  for (int k = 0; k < 3; k++)
    CHECK(fabs(after[k] - before[k]) < 1e-12, "phase %d changes by %g m2", k, after[k] - before[k]);
  PetscCall(TankDestroy(&tank));
  PetscFunctionReturn(0);
}

/* The step at rest is that of the shortest waves of the interface with the greatest contrast that cuts elements, and of no other. */
static PetscErrorCode ShortestWave(void)
{
  const PhaseProperties p = {.n = 3, .rho = {1000.0, 990.0, 1.2}, .mu = {1e-3, 1e-3, 1.8e-5}};
  const int n = 16;
  PetscFunctionBeginUser;
  for (int light = 1; light < 3; light++) {
    const double contrast = (p.rho[0] - p.rho[light]) / (p.rho[0] + p.rho[light]);
    const Region region[2] = {{.shape = REGION_BOX, .phase = light, .a = {-1, -1}, .b = {2, 2}},
                              {.shape = REGION_HALF_PLANE, .phase = 0, .a = {0.5, 0.513}, .b = {0.0, 1.0}}};
    Tank tank;
    PetscCall(TankCreatePhases(n, 6u, &p, 2, region, NULL, &tank));
    double dt = FluidTimeStep(tank.fluid);
    PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &dt, 1, MPI_DOUBLE, MPI_MIN, PETSC_COMM_WORLD));
    const double even = GRAVITY_CFL / sqrt(9.81 * PETSC_PI * n * contrast); /* of elements all alike */
    CHECK(dt > 0.5 * even && dt < even, "contrast %g: a step of %g s, %g on an even mesh", contrast, dt,
          even);
    PetscCall(TankDestroy(&tank));
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode All(int print)
{
  const int order[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
  PetscFunctionBeginUser;
  for (int k = 0; k < 6; k++) PetscCall(Still(order[k], 0.72, (PetscBool)(k % 2), print));
  for (int k = 0; k < 2; k++) PetscCall(Still(order[0], LOW + 0.013, (PetscBool)k, print));
  PetscCall(Traced(print));
  PetscCall(Adapted(print));
  PetscCall(Empty(print));
  PetscCall(Rise(print));
  PetscCall(ShortestWave());
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(All(argc > 1));
  tank_advection = PHASES_COMPRESSIVE;
  PetscCall(All(argc > 1));
  return PetscFinalize();
}
