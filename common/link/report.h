/* Numbers that a participant reports for the run's summary: kept by each rank, merged over the ranks. */
#ifndef CORACLE_REPORT_H
#define CORACLE_REPORT_H
#include "common/link/message.h"

typedef struct {
  char key[56];
  double value;
  int64_t sum; /* how ranks merge: their sum, else their maximum */
} Report;

/* A Buffer of Report, in order of first mention. */
static inline size_t ReportCount(const Buffer *list)
{
  return list->size / sizeof(Report);
}

/* Sets the value of this rank; false when the key is too long. */
bool ReportSet(Buffer *list, const char *key, double value, bool sum);
/* Takes in what other ranks have. */
void ReportMerge(Buffer *list, size_t n, const Report other[]);
/* ranks, seconds_cpu, seconds_wall, seconds_waiting, peak_memory_mb of this rank. */
void ReportResources(Buffer *list, const Participant *p);
#endif
