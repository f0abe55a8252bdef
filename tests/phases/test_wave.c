// ranks: 1 2
/* A standing wave of small amplitude between water and air (tank.h) in the unit square.  The surface is flat
 * a quarter of a period after it was let go; theory: w^2 = g k (rho_0 - rho_1)/(rho_0 coth k h_0 + rho_1 coth
 * k h_1), less half a step by which the scheme is ahead.  With condensed ridges instead of kinks the wave is
 * late.
 *
 * wave [ridge | kink] [n] [periods] [steps a period] [amplitude]: marches and prints each half period. */
#include "tests/phases/tank.h"
#include "tests/phases/wave.h"

static PetscErrorCode MakeWave(int n, double depth, double a, Tank *t)
{
  double outline[CREST + 3][2];
  Region region[2];
  PetscFunctionBeginUser;
  WaveRegions(depth, a, outline, region);
  PetscCall(TankMake(n, 5u, 0.0, 2, region, t));
  PetscFunctionReturn(0);
}

/* Marches until the surface has been flat `times` times; *flat: the last such time over the period. */
static PetscErrorCode Wave(int form, int n, int times, int steps, double a, int print, double *flat)
{
  const double depth = 0.487, period = WavePeriod(depth, RHO[0], RHO[1]), dt = period / steps;
  double before, top = 1.0, defect = 0.0;
  int iterations, crossings = 0;
  PhasesStats stats;
  Tank t;
  PetscFunctionBeginUser;
  PetscCall(MakeWave(n, depth, a, &t));
  PetscCall(TankInertia(form, &t));
  before = WaveAmplitude(t.phases, t.mesh) / a;
  for (int s = 0; crossings < times && s < 2 * times * steps; s++) {
    PetscCall(TankStep(&t, form, dt, &iterations));
    PetscCall(TankMove(form, &t, dt, &defect));
    const double now = WaveAmplitude(t.phases, t.mesh) / a;
    top = fmax(top, fabs(now));
    if ((before > 0.0) != (now > 0.0)) {
      *flat = (s + 1.0 - now / (now - before) + 0.5) / steps;
      if (print)
        PetscCall(PetscPrintf(PETSC_COMM_WORLD,
                              "flat at %.4f periods, amplitude before %.4f, largest |u| %.3f m/s, %d "
                              "iterations, flux defect %.0e\n",
                              *flat, top, TankSpeed(&t), iterations, defect));
      top = 0.0;
      crossings++;
    }
    before = now;
  }
  PetscCall(PhasesGetStats(t.phases, &stats));
  if (print)
    PetscCall(PetscPrintf(PETSC_COMM_WORLD, "water %.15f m2, fractions %.1e .. 1 + %.1e, gap %.1e\n",
                          stats.volume[0], stats.lowest, stats.highest - 1.0, stats.gap));
  CHECK(stats.gap < 1e-10 && stats.lowest > -1e-10 && fabs(stats.volume[0] - depth) < 1e-6,
        "water %g m2, gap %g", stats.volume[0], stats.gap);
  PetscCall(TankDestroy(&t));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  double flat = 0.0;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  if (argc > 5) {
    const int form = argv[1][0] == 'r' ? RIDGE : KINK;
    PetscCall(Wave(form, atoi(argv[2]), 2 * atoi(argv[3]), atoi(argv[4]), atof(argv[5]), 1, &flat));
  } else {
    PetscCall(Wave(KINK, 12, 1, 160, 0.01, 0, &flat));
    CHECK(fabs(flat - 0.25) < 0.005, "the wave is flat after %g periods", flat);
  }
  return PetscFinalize();
}
