#include "common/link/report.h"
#include "common/link/resources.h"
#include <stdio.h>
#include <string.h>

static Report *Find(Buffer *list, const char *key)
{
  Report *report = (Report *)(void *)list->data;
  for (size_t i = 0; i < ReportCount(list); i++)
    if (!strcmp(report[i].key, key)) return &report[i];
  return NULL;
}

static Report *FindOrAdd(Buffer *list, const char *key, bool *fresh)
{
  Report *report = Find(list, key);
  *fresh = !report;
  if (report) return report;
  report = BufferExtend(list, sizeof *report);
  memset(report, 0, sizeof *report);
  snprintf(report->key, sizeof report->key, "%s", key);
  return report;
}

bool ReportSet(Buffer *list, const char *key, double value, bool sum)
{
  bool fresh;
  if (strlen(key) >= sizeof((Report *)0)->key) return false;
  Report *report = FindOrAdd(list, key, &fresh);
  report->value = value;
  report->sum = sum;
  return true;
}

void ReportMerge(Buffer *list, size_t n, const Report other[])
{
  for (size_t i = 0; i < n; i++) {
    bool fresh;
    Report *report = FindOrAdd(list, other[i].key, &fresh);
    if (fresh)
      *report = other[i];
    else if (other[i].sum)
      report->value += other[i].value;
    else if (other[i].value > report->value)
      report->value = other[i].value;
  }
}

void ReportResources(Buffer *list, const Participant *p)
{
  double used[NUSED];
  ParticipantUsed(p, used);
  ReportSet(list, "ranks", 1.0, true);
  ReportSet(list, "seconds_cpu", used[USED_CPU], true);
  ReportSet(list, "seconds_wall", used[USED_WALL], false);
  ReportSet(list, "seconds_waiting", used[USED_WAITING], false);
  ReportSet(list, "peak_memory_mb", PeakMemory(), true);
}
