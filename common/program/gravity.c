#include "common/program/gravity.h"

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

int GravityActs(const double gravity[2], const TimeTable *table)
{
  int acts = gravity[0] != 0.0 || gravity[1] != 0.0;
  for (int k = 0; k < table->nrows; k++)
    acts |= TimeTableAt(table, k, 1) != 0.0 || TimeTableAt(table, k, 2) != 0.0;
  return acts;
}
