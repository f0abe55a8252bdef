// ranks: 1 2
/* A standing wave of small amplitude between water and air in the unit square: inviscid theory has w^2 = g k (rho_0 -
 * rho_1)/(rho_0 coth k h_0 + rho_1 coth k h_1), and viscosity damps the amplitude by exp(-2 nu k^2 t).
 * standing_wave n periods steps-a-period amplitude viscosity [compressive]: prints each half period. */
#include "tests/fluid/tank.h"
#include "tests/phases/wave.h"

static PetscErrorCode WaveCreate(int n, double depth, double a, double viscosity, Tank *t)
{
  double outline[CREST + 3][2];
  Region region[2];
  PetscFunctionBeginUser;
  WaveRegions(depth, a, outline, region);
  PetscCall(TankCreate(n, 5u, viscosity, 2, region, t));
  PetscFunctionReturn(0);
}

/* What the wave did. */
typedef struct {
  double flat;      /* time of the last flat surface, periods */
  double amplitude; /* of the last crest, over the first */
  double fastest;   /* m/s */
} WaveReport;

/* Marches until the surface has been flat `times` times. */
static PetscErrorCode Wave(int n, int times, int steps, double a, double viscosity, int print, WaveReport *r)
{
  const double depth = 0.487, period = WavePeriod(depth, WATER, AIR), dt = period / steps;
  double before = 1.0, top = 1.0;
  int crossings = 0;
  PhasesStats stats;
  Tank t;
  PetscFunctionBeginUser;
  PetscCall(WaveCreate(n, depth, a, viscosity, &t));
  *r = (WaveReport){0.0, 1.0, 0.0};
  for (int s = 0; crossings < times && s < times * steps; s++) {
    PetscCall(FluidStep(t.fluid, dt));
    const double now = WaveAmplitude(PhaseTransportPhases(FluidPhases(t.fluid)), t.mesh) / a;
    r->fastest = fmax(r->fastest, TankSpeed(&t, 0));
    top = fmax(top, fabs(now));
    if ((before > 0.0) != (now > 0.0)) {
      r->flat = (s + 1.0 - now / (now - before)) / steps;
      r->amplitude = top;
      if (print)
        PetscCall(PetscPrintf(PETSC_COMM_WORLD,
                              "flat at %.4f periods, amplitude before %.4f, largest |u| %.4f m/s, in water "
                              "%.4f, %d iterations\n",
                              r->flat, top, TankSpeed(&t, 0), TankSpeed(&t, 1),
                              FluidGetStats(t.fluid)->momentum_iterations));
      top = 0.0;
      crossings++;
    }
    before = now;
  }
  PetscCall(PhasesGetStats(PhaseTransportPhases(FluidPhases(t.fluid)), &stats));
  if (print)
    PetscCall(PetscPrintf(PETSC_COMM_WORLD, "water %.15f m2, fractions %.1e .. 1 + %.1e, gap %.1e\n",
                          stats.volume[0], stats.lowest, stats.highest - 1.0, stats.gap));
  CHECK(stats.gap < 1e-10 && stats.lowest > -1e-10 && fabs(stats.volume[0] - depth) < 1e-6,
        "water %g m2, gap %g, lowest %g", stats.volume[0], stats.gap, stats.lowest);
  PetscCall(TankDestroy(&t));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  WaveReport r;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  if (argc > 6) tank_advection = PHASES_COMPRESSIVE;
  if (argc > 5) {
    PetscCall(Wave(atoi(argv[1]), 2 * atoi(argv[2]), atoi(argv[3]), atof(argv[4]), atof(argv[5]), 1, &r));
  } else {
    PetscCall(Wave(12, 2, 80, 0.01, 1e-3, 0, &r));
    CHECK(fabs(r.flat - 0.75) < 0.015 && fabs(r.amplitude - 1.0) < 0.03, "flat after %g periods, crest %g",
          r.flat, r.amplitude);
    CHECK(r.fastest < 0.4, "speeds up to %g m/s", r.fastest);
  }
  return PetscFinalize();
}
