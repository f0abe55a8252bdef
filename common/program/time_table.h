/* A table in time, or along a boundary: rows of a time (a place) and values, the times rising; linear between rows, constant before the first and after the last.
 * Tables may be records of thousands of rows: the row is found by bisection.  Kernel: no memory, no errors. */
#ifndef CORACLE_TIME_TABLE_H
#define CORACLE_TIME_TABLE_H

typedef struct {
  int nrows, width;  /* width: of a row, its time included */
  const double *row; /* [nrows][width] borrowed */
} TimeTable;

static inline double TimeTableAt(const TimeTable *t, int row, int column)
{
  return t->row[row * t->width + column];
}

/* The first row after `time`, nrows if there is none. */
static inline int TimeTableNext(const TimeTable *t, double time)
{
  int below = 0, above = t->nrows;
  while (below < above) {
    const int middle = (below + above) / 2;
    if (TimeTableAt(t, middle, 0) <= time)
      below = middle + 1;
    else
      above = middle;
  }
  return below;
}

/* The value of a column, 1 .. width - 1, at `time`, which lies between row next - 1 and row next. */
static inline double TimeTableBetween(const TimeTable *t, int next, int column, double time)
{
  if (next == 0) return TimeTableAt(t, 0, column);
  if (next == t->nrows) return TimeTableAt(t, next - 1, column);
  const double from = TimeTableAt(t, next - 1, 0), value = TimeTableAt(t, next - 1, column);
  return value + (time - from) / (TimeTableAt(t, next, 0) - from) * (TimeTableAt(t, next, column) - value);
}

static inline double TimeTableValue(const TimeTable *t, int column, double time)
{
  return TimeTableBetween(t, TimeTableNext(t, time), column, time);
}

/* The mean of a column from `time` to time + length, by the trapezoids between rows, which is exact, of a constant
 * to the last bit; length 0: the value. */
static inline double TimeTableMean(const TimeTable *t, int column, double time, double length)
{
  const double end = time + length;
  int next = TimeTableNext(t, time);
  const double first = TimeTableBetween(t, next, column, time);
  double at = time, value = first, sum = 0.0;
  if (!(length > 0.0)) return first;
  while (at < end) {
    const double to = next < t->nrows && TimeTableAt(t, next, 0) < end ? TimeTableAt(t, next, 0) : end;
    const double reached = TimeTableBetween(t, next, column, to);
    sum += 0.5 * (value - first + (reached - first)) * (to - at);
    at = to;
    value = reached;
    if (next < t->nrows) next++;
  }
  return first + sum / length;
}
#endif
