/* The line that cuts a part of given area and mean off a convex polygon: of a part that a straight line has made, that line; else the one whose
 * part of that area has the nearest mean (moment of fluid: Dyadechko and Shashkov, J. Comput. Phys. 227 (2008) 5361-5384). */
#ifndef CORACLE_PHASES_CUT_OF_MOMENT_H
#define CORACLE_PHASES_CUT_OF_MOMENT_H
#include "fluid/phases/polygon.h"

/* Directions that are tried before the best one is improved, and how often that halves what is left of the angle at least. */
enum { CUT_DIRECTIONS = 64, CUT_REFINEMENTS = 60 };

/* The part n.x <= d of that area, n at an angle. */
static inline HalfPlane CutAtAngle(const Polygon *p, double area, double angle)
{
  HalfPlane h = {{cos(angle), sin(angle)}, 0.0};
  h.d = PolygonFindOffset(p, h.n, area);
  return h;
}

/* The square of the distance of that part's mean from `mean`, m2. */
static inline double CutMiss(const Polygon *p, double area, const double mean[2], double angle)
{
  const HalfPlane h = CutAtAngle(p, area, angle);
  Polygon part;
  double moment[2];
  PolygonClip(p, &h, &part);
  const double whole = PolygonArea(&part);
  if (!(whole > 0.0)) return HUGE_VAL;
  PolygonMoment(&part, moment);
  const double d[2] = {moment[0] / whole - mean[0], moment[1] / whole - mean[1]};
  return d[0] * d[0] + d[1] * d[1];
}

/* The half plane of the part; area in m2, less than that of p, mean in m. */
static inline HalfPlane CutOfMoment(const Polygon *p, double area, const double mean[2])
{
  const double step = 2.0 * acos(-1.0) / CUT_DIRECTIONS, golden = 0.5 * (sqrt(5.0) - 1.0);
  double best = 0.0, least = HUGE_VAL;
  for (int k = 0; k < CUT_DIRECTIONS; k++) {
    const double miss = CutMiss(p, area, mean, k * step);
    if (miss < least) least = miss, best = k * step;
  }
  double low = best - step, high = best + step;
  for (int k = 0; k < CUT_REFINEMENTS; k++) { /* golden section */
    const double a = high - golden * (high - low), b = low + golden * (high - low);
    if (CutMiss(p, area, mean, a) < CutMiss(p, area, mean, b))
      high = b;
    else
      low = a;
  }
  return CutAtAngle(p, area, 0.5 * (low + high));
}
#endif
