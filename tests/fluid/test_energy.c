// ranks: 1 2
/* Kinetic and potential energy of water and air in a closed tank, E = K + P, step by step: a wave of finite amplitude, on a
 * mesh that stays and on one that adapts, and a column that collapses.
 *
 * E of a wave falls from period to period, but not in each step.  Within a period it swings twice, for two reasons:
 *   - time: volumes move with the velocity extrapolated to the middle of the step, which is off by -5/12 dt^2 u'', so what is kept
 *     is (1 + 5/12 (w dt)^2) K + P; in the first step, which has nothing to extrapolate from, the volumes lag by (w dt)^2/2;
 *   - space: P has the water's polygons, the force of gravity one density an element: in an element the water's centre is off by
 *     up to h/4, which the velocity's gradient makes a swing of (k h)^2/4 (a tenth is found).
 * Bounds: no rise above the lowest E before is more than (w dt)^2 + (k h)^2/4 of the wave's energy; after a period E is lower.
 * A projection that moves cut elements by another tensor than 1/rho makes a column's E rise by 0.15 of it (../../fluid/README.md).
 * energy [wave n steps periods amplitude viscosity [adapting] | column n time]: prints. */
#include "tests/fluid/adapting_tank.h"
#include "tests/phases/wave.h"

#define DEPTH 0.487

typedef struct {
  double start, now, lowest;
  double rise, step, sum, above; /* of E above its lowest before, in one step, all of them, above the start */
} Energy;

static PetscErrorCode EnergyAdd(Energy *e, Fluid f)
{
  double momentum[2], kinetic, potential;
  PetscFunctionBeginUser;
  PetscCall(FluidMomentumTotal(f, momentum, &kinetic));
  PetscCall(FluidPotentialEnergy(f, &potential));
  const double now = kinetic + potential;
  if (e->start == 0.0) e->start = e->now = e->lowest = now;
  e->rise = fmax(e->rise, now - e->lowest);
  e->step = fmax(e->step, now - e->now);
  e->sum += fmax(now - e->now, 0.0);
  e->above = fmax(e->above, now - e->start);
  e->lowest = fmin(e->lowest, now);
  e->now = now;
  PetscFunctionReturn(0);
}

static PetscErrorCode EnergyPrint(const Energy *e, const char *what, double scale)
{
  PetscFunctionBeginUser;
  PetscCall(PetscPrintf(
      PETSC_COMM_WORLD,
      "%s: end %+.2e, rise %.2e, of a step %.2e, all rises %.2e, above the start %.2e of %.4g J/m\n", what,
      (e->now - e->start) / scale, e->rise / scale, e->step / scale, e->sum / scale, e->above / scale,
      scale));
  PetscFunctionReturn(0);
}

/* A tank whose mesh has cells of 1/n at the surface and adapts to it every tenth step, or stays (every 0). */
static PetscErrorCode Create(int n, double viscosity, const Region region[2], AdaptingTank *m)
{
  AdaptationSetup setup = TANK_ADAPTATION;
  PetscFunctionBeginUser;
  setup.size_min = setup.corner_size = setup.interface_size = 1.0 / n;
  setup.every = 10;
  *m = (AdaptingTank){0};
  PetscCall(TankCreate(n, 5u, viscosity, 2, region, &m->tank));
  PetscCall(AdaptationCreate(&setup, &m->adaptation));
  PetscFunctionReturn(0);
}

static PetscErrorCode Wave(int n, int steps, int periods, double a, double viscosity, int adapting, int print)
{
  const double dt = WavePeriod(DEPTH, WATER, AIR) / steps;
  const double flat = 0.5 * 9.81 * ((WATER - AIR) * DEPTH * DEPTH + AIR);
  const double bound = pow(2.0 * M_PI / steps, 2) + 0.25 * pow(M_PI / n, 2);
  double outline[CREST + 3][2], *before;
  Region region[2];
  AdaptingTank m;
  Energy e = {0};
  PetscFunctionBeginUser;
  WaveRegions(DEPTH, a, outline, region);
  PetscCall(Create(n, viscosity, region, &m));
  PetscCall(PetscMalloc1(periods * steps + 1, &before));
  PetscCall(EnergyAdd(&e, m.tank.fluid));
  const double scale = e.start - flat;
  for (int s = 1; s <= periods * steps; s++) {
    if (adapting)
      PetscCall(AdaptingTankStep(&m, dt));
    else
      PetscCall(FluidStep(m.tank.fluid, dt));
    PetscCall(EnergyAdd(&e, m.tank.fluid));
    before[s] = e.now;
    CHECK(e.rise < bound * scale, "%s mesh, step %d: E rises by %g of the wave's, bound %g",
          adapting ? "adapting" : "fixed", s, e.rise / scale, bound);
    CHECK(s <= steps || e.now < before[s - steps],
          "%s mesh, step %d: E has grown by %g of the wave's in a period", adapting ? "adapting" : "fixed", s,
          (e.now - before[s - steps]) / scale);
  }
  if (print) PetscCall(EnergyPrint(&e, "wave", scale));
  PetscCall(PetscFree(before));
  PetscCall(AdaptingTankDestroy(&m));
  PetscFunctionReturn(0);
}

/* A column collapses, strikes the wall, and breaks.  It is a layer of the depth H in the end: no longer waves than k H = 1. */
static PetscErrorCode Column(int n, double end, int print)
{
  const double depth = 0.18, bound = 0.25 / (n * n * depth * depth);
  const Region region[2] = {{.shape = REGION_BOX, .phase = 1, .a = {-1, -1}, .b = {2, 2}},
                            {.shape = REGION_BOX, .phase = 0, .a = {-1, -1}, .b = {0.3, 0.6}}};
  AdaptingTank m;
  Energy e = {0};
  PetscFunctionBeginUser;
  PetscCall(Create(n, 1e-3, region, &m));
  PetscCall(EnergyAdd(&e, m.tank.fluid));
  /* what it falls from to a layer on the floor */
  const double scale = 9.81 * (WATER - AIR) * depth * (0.3 - 0.5 * depth);
  for (double t = 0.0, dt = 1e-4; t < end; t += dt) {
    dt = fmin(fmin(FluidTimeStep(m.tank.fluid), 1.2 * dt), 0.2 / n);
    MPI_Allreduce(MPI_IN_PLACE, &dt, 1, MPI_DOUBLE, MPI_MIN, PETSC_COMM_WORLD);
    PetscCall(AdaptingTankStep(&m, dt));
    PetscCall(EnergyAdd(&e, m.tank.fluid));
    CHECK(e.rise < bound * scale && e.above < 1e-6 * scale,
          "column, %g s: E rises by %g, bound %g, %g above the start", t, e.rise / scale, bound,
          e.above / scale);
  }
  if (print) PetscCall(EnergyPrint(&e, "column", scale));
  PetscCall(AdaptingTankDestroy(&m));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  if (argc > 6) {
    PetscCall(Wave(atoi(argv[2]), atoi(argv[3]), atoi(argv[4]), atof(argv[5]), atof(argv[6]), argc > 7, 1));
  } else if (argc > 3) {
    PetscCall(Column(atoi(argv[2]), atof(argv[3]), 1));
  } else {
    for (int adapting = 0; adapting < 2; adapting++)
      PetscCall(Wave(16, 80, 2, 0.05, 1e-3, adapting, argc > 1));
    PetscCall(Column(16, 1.2, argc > 1));
  }
  return PetscFinalize();
}
