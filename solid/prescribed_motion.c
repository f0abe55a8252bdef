#include "solid/prescribed_motion.h"
#include <math.h>

/* The integral from 0 to t > 0 of min(t/rise, 1), or of that times sin(2 pi t/period). */
static double IntegralOfOneRow(const PrescribedMotion *d, double t)
{
  const double omega = d->period > 0.0 ? 2.0 * acos(-1.0) / d->period : 0.0, rising = fmin(t, d->rise);
  if (omega == 0.0) return (d->rise > 0.0 ? 0.5 * rising * rising / d->rise : 0.0) + (t - rising);
  const double before =
      d->rise > 0.0 ? (sin(omega * rising) / omega - rising * cos(omega * rising)) / (omega * d->rise) : 0.0;
  return before + (cos(omega * rising) - cos(omega * t)) / omega;
}

double PrescribedVelocity(const PrescribedMotion *d, int c, double from, double h)
{
  const double to = from + h;
  const TimeTable table = {d->nrows, 3, d->row};
  return d->nrows > 1 ? TimeTableMean(&table, 1 + c, from, h)
                      : d->row[1 + c] * (IntegralOfOneRow(d, to) - IntegralOfOneRow(d, from)) / (to - from);
}

double PrescribedRotation(const PrescribedMotion *d, double from, double h)
{
  const double to = from + h;
  if (d->spin.nrows) return TimeTableMean(&d->spin, 1, from, h);
  return d->angular_velocity == 0.0
             ? 0.0
             : d->angular_velocity * (IntegralOfOneRow(d, to) - IntegralOfOneRow(d, from)) / (to - from);
}

void PrescribedPivot(const PrescribedMotion *d, double t, double pivot[2])
{
  for (int c = 0; c < 2; c++) pivot[c] = d->pivot[c] + (t > 0.0 ? t * PrescribedVelocity(d, c, 0.0, t) : 0.0);
}

/* Of a column's absolute values. */
static double LargestOf(const TimeTable *t, int column, double from, double length)
{
  double largest =
      fmax(fabs(TimeTableValue(t, column, from)), fabs(TimeTableValue(t, column, from + length)));
  for (int k = TimeTableNext(t, from); k < t->nrows && TimeTableAt(t, k, 0) < from + length; k++)
    largest = fmax(largest, fabs(TimeTableAt(t, k, column)));
  return largest;
}

void PrescribedLargest(const PrescribedMotion *d, double from, double length, double *velocity,
                       double *angular_velocity)
{
  const TimeTable table = {d->nrows, 3, d->row};
  *velocity = hypot(LargestOf(&table, 1, from, length), LargestOf(&table, 2, from, length));
  *angular_velocity = d->spin.nrows ? LargestOf(&d->spin, 1, from, length) : fabs(d->angular_velocity);
}

PrescribedSubstep PrescribedSubstepOf(const PrescribedMotion *d, double from, double h)
{
  PrescribedSubstep s = {
      {PrescribedVelocity(d, 0, from, h), PrescribedVelocity(d, 1, from, h)}, {0.0, 0.0}, 0.0, 0.0};
  if (!PrescribedTurns(d)) return s;
  const double turn = h * PrescribedRotation(d, from, h);
  PrescribedPivot(d, from, s.pivot);
  s.parallel = -2.0 * sin(0.5 * turn) * sin(0.5 * turn) / h;
  s.normal = sin(turn) / h;
  return s;
}
