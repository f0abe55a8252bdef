/* The mean of a table over an interval is exact: of its parts, of what is linear, across rows, before the first and after the last. */
#include "common/program/time_table.h"
#include "tests/check.h"
#include <math.h>

int main(void)
{
  static const double ROWS[4][2] = {{1.0, 2.0}, {1.5, -1.0}, {1.6, 3.0}, {4.0, 0.0}};
  /* the integral from 0 to each row, and to 6 */
  static const double WHOLE[5] = {2.0, 2.25, 2.35, 5.95, 5.95}, END[5] = {1.0, 1.5, 1.6, 4.0, 6.0};
  const TimeTable t = {4, 2, &ROWS[0][0]}, one = {1, 2, &ROWS[0][0]};
  for (int k = 0; k < 5; k++) {
    const double mean = TimeTableMean(&t, 1, 0.0, END[k]);
    CHECK(fabs(mean * END[k] - WHOLE[k]) < 1e-14, "to %g: %.17g", END[k], mean * END[k]);
    for (int parts = 2; parts < 40; parts += 3) {
      double sum = 0.0;
      for (int i = 0; i < parts; i++) sum += TimeTableMean(&t, 1, END[k] * i / parts, END[k] / parts) / parts;
      CHECK(fabs(sum - mean) < 1e-14, "%d parts to %g: %.17g, %.17g", parts, END[k], sum, mean);
    }
  }
  CHECK(fabs(TimeTableMean(&t, 1, 2.0, 0.5) -
             0.5 * (TimeTableValue(&t, 1, 2.0) + TimeTableValue(&t, 1, 2.5))) < 1e-15,
        "between two rows");
  CHECK(TimeTableMean(&t, 1, 1.55, 0.0) == TimeTableValue(&t, 1, 1.55), "no length");
  CHECK(TimeTableMean(&one, 1, 0.0, 9.0) == 2.0, "one row");
  return 0;
}
