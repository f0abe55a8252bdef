/* What this process has used so far. */
#ifndef CORACLE_RESOURCES_H
#define CORACLE_RESOURCES_H
#include <sys/resource.h>

/* Seconds of processors, of the program and of the system for it. */
static inline double ProcessorSeconds(void)
{
  struct rusage use;
  (void)getrusage(RUSAGE_SELF, &use);
  return (double)(use.ru_utime.tv_sec + use.ru_stime.tv_sec) +
         1e-6 * (double)(use.ru_utime.tv_usec + use.ru_stime.tv_usec);
}

/* MB, the most at any time. */
static inline double PeakMemory(void)
{
  struct rusage use;
  (void)getrusage(RUSAGE_SELF, &use);
  return (double)use.ru_maxrss / 1024.0;
}
#endif
