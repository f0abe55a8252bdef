/* Where waves are absorbed: towards `to` the fluid is more and more drawn to a velocity,
 *
 *     force = rho k (U - u),    k = rate s^2,    s = (x - from).(to - from)/|to - from|^2, between 0 and 1      N/m3
 *
 * 0 before `from`, `rate` beyond `to`.  Zones add up.  One of a single phase draws its part of an element's mass alone: k times that. */
#ifndef FLUID_ABSORPTION_H
#define FLUID_ABSORPTION_H
#include "fluid/discretization/domain.h"

enum { ABSORPTION_MAX = 8 };

typedef struct {
  double from[2], to[2], velocity[2], rate; /* m, m, m/s, 1/s */
  int phase;                                /* -1: all of the fluid */
} AbsorptionZone;

typedef struct {
  int n;
  AbsorptionZone zone[ABSORPTION_MAX];
} Absorption;

typedef struct {
  double rate, push[2]; /* sums of k, 1/s, and of k U, m/s2 */
} AbsorptionAt;

/* share: each phase's of the mass; NULL: one fluid. */
static inline AbsorptionAt AbsorptionOf(const Absorption *a, const double x[2], const double share[])
{
  AbsorptionAt sum = {0.0, {0.0, 0.0}};
  for (int z = 0; z < a->n; z++) {
    const AbsorptionZone *zone = &a->zone[z];
    const double d[2] = {zone->to[0] - zone->from[0], zone->to[1] - zone->from[1]};
    const double s =
        ((x[0] - zone->from[0]) * d[0] + (x[1] - zone->from[1]) * d[1]) / (d[0] * d[0] + d[1] * d[1]);
    const double part = share && zone->phase >= 0 ? share[zone->phase] : 1.0;
    const double k = s <= 0.0 ? 0.0 : part * (s >= 1.0 ? zone->rate : zone->rate * s * s);
    sum.rate += k;
    for (int c = 0; c < 2; c++) sum.push[c] += k * zone->velocity[c];
  }
  return sum;
}

/* At the centre of element e. */
static inline AbsorptionAt AbsorptionOfElement(const Absorption *a, const Mesh *mesh, int e,
                                               const double share[])
{
  double x[2] = {0.0, 0.0};
  for (int i = 0; i < 3; i++)
    for (int c = 0; c < 2; c++) x[c] += ElementVertex(mesh, e, i)[c] / 3.0;
  return AbsorptionOf(a, x, share);
}
#endif
