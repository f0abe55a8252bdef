#include "solid/prescribed_motion.h"
#include <math.h>

static double Row(const PrescribedMotion *d, int k, int column)
{
  return d->row[3 * k + column];
}

/* The first row after t, nrows if there is none: tables may be records of thousands of rows. */
static int NextRow(const PrescribedMotion *d, double t)
{
  int below = 0, above = d->nrows;
  while (below < above) {
    const int middle = (below + above) / 2;
    if (Row(d, middle, 0) <= t)
      below = middle + 1;
    else
      above = middle;
  }
  return below;
}

/* The velocity at t, which lies between row next - 1 and row next. */
static double Velocity(const PrescribedMotion *d, int next, int c, double t)
{
  if (next == 0) return Row(d, 0, 1 + c);
  if (next == d->nrows) return Row(d, next - 1, 1 + c);
  const double t0 = Row(d, next - 1, 0), v0 = Row(d, next - 1, 1 + c);
  return v0 + (t - t0) / (Row(d, next, 0) - t0) * (Row(d, next, 1 + c) - v0);
}

double PrescribedVelocity(const PrescribedMotion *d, int c, double from, double h)
{
  const double to = from + h;
  double sum = 0.0;
  int next = NextRow(d, from);
  for (double start = from, end; start < to; start = end, next++) {
    end = next < d->nrows ? fmin(Row(d, next, 0), to) : to;
    sum += 0.5 * (end - start) * (Velocity(d, next, c, start) + Velocity(d, next, c, end));
  }
  return sum / (to - from);
}
