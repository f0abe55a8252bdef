#include "solid/prescribed_motion.h"
#include <math.h>

static double Row(const PrescribedMotion *d, int k, int column)
{
  return d->row[3 * k + column];
}

/* The integral of the velocity from the first row's time to t, m. */
static double Displacement(const PrescribedMotion *d, int c, double t)
{
  double sum = Row(d, 0, 1 + c) * fmin(t - Row(d, 0, 0), 0.0);
  for (int k = 0; k + 1 < d->nrows; k++) {
    const double t0 = Row(d, k, 0), t1 = Row(d, k + 1, 0), v0 = Row(d, k, 1 + c), v1 = Row(d, k + 1, 1 + c);
    const double span = fmin(t, t1) - t0;
    if (span > 0.0) sum += span * (v0 + 0.5 * span * (v1 - v0) / (t1 - t0));
  }
  return sum + Row(d, d->nrows - 1, 1 + c) * fmax(t - Row(d, d->nrows - 1, 0), 0.0);
}

double PrescribedVelocity(const PrescribedMotion *d, int component, double from, double h)
{
  if (d->nrows == 1) return Row(d, 0, 1 + component);
  return (Displacement(d, component, from + h) - Displacement(d, component, from)) / h;
}
