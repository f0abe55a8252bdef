/* A standing wave of small amplitude between water and air in the unit square: amplitude a cos(pi x) about `depth`. */
#ifndef TESTS_PHASES_WAVE_H
#define TESTS_PHASES_WAVE_H
#include "fluid/phases/phases.h"
#include "fluid/phases/region.h"
#include <math.h>

enum { CREST = 400 };

/* Air everywhere, water below the wave: its outline is in `outline`. */
static inline void WaveRegions(double depth, double a, double outline[CREST + 3][2], Region region[2])
{
  for (int i = 0; i <= CREST; i++) {
    outline[i][0] = 1.0 - (double)i / CREST;
    outline[i][1] = depth + a * cos(M_PI * outline[i][0]);
  }
  outline[CREST + 1][0] = 0.0;
  outline[CREST + 2][0] = 1.0;
  outline[CREST + 1][1] = outline[CREST + 2][1] = -1.0;
  region[0] = (Region){.shape = REGION_BOX, .phase = 1, .a = {-1, -1}, .b = {2, 2}};
  region[1] = (Region){.shape = REGION_POLYGON, .phase = 0, .n = CREST + 3, .x = (const double(*)[2])outline};
}

/* The coefficient of cos(pi x) in the surface: from the first moment of the water's volume.  Collective. */
static inline double WaveAmplitude(Phases phases, const Mesh *mesh)
{
  double sum = 0.0;
  for (int e = 0; e < mesh->ne; e++) {
    Polygon part;
    (void)PhasesGetPolygon(phases, e, 0, &part);
    for (int k = 1; k + 1 < part.n; k++) {
      const double area = 0.5 * GeometryTurn(part.x[0], part.x[k], part.x[k + 1]);
      sum +=
          area / 3.0 * (cos(M_PI * part.x[0][0]) + cos(M_PI * part.x[k][0]) + cos(M_PI * part.x[k + 1][0]));
    }
  }
  MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, mesh->comm);
  return 2.0 * sum;
}

/* w^2 = g k (rho_0 - rho_1)/(rho_0 coth k h_0 + rho_1 coth k h_1), inviscid. */
static inline double WavePeriod(double depth, double rho0, double rho1)
{
  const double k = M_PI, below = rho0 / tanh(k * depth), above = rho1 / tanh(k * (1.0 - depth));
  return 2.0 * M_PI / sqrt(9.81 * k * (rho0 - rho1) / (below + above));
}
#endif
