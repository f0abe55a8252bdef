#include "common/program/summary_file.h"
#include "common/link/coracle.h"
#include "common/link/json.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

void SummaryReport(void *reports, const char *role, const char *key, double value)
{
  SummaryReports *r = reports;
  if (r->n == r->capacity) {
    r->capacity = r->capacity ? 2 * r->capacity : 64;
    r->report = realloc(r->report, (size_t)r->capacity * sizeof *r->report);
  }
  snprintf(r->report[r->n].role, sizeof r->report->role, "%s", role);
  snprintf(r->report[r->n].key, sizeof r->report->key, "%s", key);
  r->report[r->n++].value = value;
}

void SummaryReportsFree(SummaryReports *reports)
{
  free(reports->report);
  *reports = (SummaryReports){0};
}

/* null for NaN and infinity, which JSON does not have. */
static void WriteNumber(FILE *f, double value)
{
  if (isfinite(value)) {
    fprintf(f, "%.17g", value);
  } else {
    fprintf(f, "null");
  }
}

static void WriteString(FILE *f, const char *s)
{
  fputc('"', f);
  JsonCharacters(f, s);
  fputc('"', f);
}

void SummaryFileHead(FILE *f, const char *name, const char *note, const char *mode)
{
  fprintf(f, "{\n  \"case\": ");
  WriteString(f, name);
  fprintf(f, ",\n  \"note\": ");
  WriteString(f, note);
  fprintf(f, ",\n  \"version\": \"%s\",\n  \"revision\": \"%s\",\n  \"mode\": \"%s\",\n", CORACLE_VERSION,
          CORACLE_REVISION, mode);
}

void SummaryFileField(FILE *f, const char *key, double value)
{
  fprintf(f, "  \"%s\": ", key);
  WriteNumber(f, value);
  fprintf(f, ",\n");
}

static void WriteParticipant(FILE *f, const SummaryReports *r, const char *role)
{
  int n = 0;
  fprintf(f, "    \"%s\": {", role);
  for (int i = 0; i < r->n; i++) {
    if (strcmp(r->report[i].role, role)) continue;
    fprintf(f, "%s", n++ ? ", " : "");
    WriteString(f, r->report[i].key);
    fprintf(f, ": ");
    WriteNumber(f, r->report[i].value);
  }
  fprintf(f, "}");
}

void SummaryFileParticipants(FILE *f, const SummaryReports *reports, int n, const char *const roles[])
{
  fprintf(f, "  \"participants\": {\n");
  for (int i = 0; i < n; i++) {
    WriteParticipant(f, reports, roles[i]);
    fprintf(f, i < n - 1 ? ",\n" : "\n");
  }
  fprintf(f, "  }\n}\n");
}
