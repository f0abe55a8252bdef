/* Times are sums of steps and may miss what they should be by round-off.  Kernel: no memory, no errors. */
#ifndef CORACLE_TIME_REACHED_H
#define CORACLE_TIME_REACHED_H
#include <math.h>

#define TIME_NEARLY (1.0 - 1e-9)

/* Whether t has come to `time`, both >= 0. */
static inline int TimeReached(double t, double time)
{
  return t >= time * TIME_NEARLY;
}

/* The first multiple of `every`, >= 0, after t. */
static inline double TimeNext(double t, double every)
{
  return every > 0.0 ? every * (floor(t / (every * TIME_NEARLY)) + 1.0) : 0.0;
}

/* The fewest steps of at most `longest` that make up `length`: 1 or more. */
static inline double TimeSteps(double length, double longest)
{
  return fmax(1.0, ceil(length / longest * TIME_NEARLY));
}
#endif
