/* The case file's gravity: constant, or in time, as of a frame that is accelerated itself (a shaken tank, the ground in an earthquake), in
 * which everything has the weight rho (g - a).  A step has its mean over the step, exactly. */
#ifndef CORACLE_GRAVITY_H
#define CORACLE_GRAVITY_H
#include "common/link/case_file.h"
#include "common/program/time_table.h"

/* The key `gravity`, m/s2: two numbers, or rows of time and both, borrowed until CoracleCaseClose.  gravity: that at 0 s; table: with
 * nrows 0 where it is constant. */
void GravityRead(CoracleCase c, double gravity[2], TimeTable *table);
/* Its largest magnitude at any time, m/s2. */
double GravityLargest(const double gravity[2], const TimeTable *table);
/* gravity becomes the mean from t to t + dt, s, that at t for dt = 0; it stays as it is where it is constant. */
static inline void GravityOver(const TimeTable *table, double t, double dt, double gravity[2])
{
  for (int c = 0; c < 2 && table->nrows; c++) gravity[c] = TimeTableMean(table, 1 + c, t, dt);
}
#endif
