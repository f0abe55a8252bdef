#include "common/program/gravity.h"
#include <math.h>

void GravityRead(CoracleCase c, double gravity[2], TimeTable *table)
{
  *table = (TimeTable){.width = 3};
  if (!CoracleCaseHas(c, "gravity[0][0]")) {
    CoracleCaseVector(c, "gravity", 2, gravity);
    return;
  }
  table->row = CoracleCaseTable(c, "gravity", table->width, &table->nrows);
  GravityOver(table, 0.0, 0.0, gravity);
}

double GravityLargest(const double gravity[2], const TimeTable *table)
{
  double largest = hypot(gravity[0], gravity[1]);
  for (int k = 0; k < table->nrows; k++)
    largest = fmax(largest, hypot(TimeTableAt(table, k, 1), TimeTableAt(table, k, 2)));
  return largest;
}
