#include "coupler/output/summary.h"
#include "coupler/output/advice.h"
#include <errno.h>
#include <string.h>

#ifndef CORACLE_REVISION
#define CORACLE_REVISION "unknown"
#endif

enum { REPORTS_MAX = 256 };

typedef struct {
  char role[32], key[64];
  double value;
} Report;

typedef struct {
  int n;
  Report report[REPORTS_MAX];
} Reports;

static void Collect(void *context, const char *role, const char *key, double value)
{
  Reports *r = context;
  if (r->n == REPORTS_MAX) return;
  Report *report = &r->report[r->n++];
  snprintf(report->role, sizeof report->role, "%s", role);
  snprintf(report->key, sizeof report->key, "%s", key);
  report->value = value;
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
  for (; *s; s++) {
    if (*s == '"' || *s == '\\') fputc('\\', f);
    if ((unsigned char)*s < 0x20) {
      fprintf(f, "\\u%04x", (unsigned)*s);
    } else {
      fputc(*s, f);
    }
  }
  fputc('"', f);
}

static void WriteParticipant(FILE *f, const Reports *r, const char *role)
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

static void WriteField(FILE *f, const char *key, double value)
{
  fprintf(f, "  \"%s\": ", key);
  WriteNumber(f, value);
  fprintf(f, ",\n");
}

static void WriteAll(FILE *f, const CouplerCase *c, const WriterTotals *t, const Reports *reports)
{
  static const char *const ROLES[] = {"fluid", "coupler", "solid"};
  fprintf(f, "{\n  \"case\": ");
  WriteString(f, c->name);
  fprintf(f, ",\n  \"note\": ");
  WriteString(f, c->note);
  fprintf(f, ",\n  \"version\": \"%s\",\n  \"revision\": \"%s\",\n  \"mode\": \"%s\",\n", CORACLE_VERSION,
          CORACLE_REVISION, COUPLER_MODES[c->options.mode]);
  WriteField(f, "resumed_at", t->resumed);
  WriteField(f, "end_time", t->end);
  WriteField(f, "steps", (double)t->steps);
  WriteField(f, "iterations", (double)t->iterations);
  WriteField(f, "terminal_velocity", t->terminal);
  WriteField(f, "largest_momentum_imbalance", t->imbalance);
  fprintf(f, "  \"elements\": {\"solid\": %lld, \"surface\": %lld, \"fluid_near_solid\": %lld},\n",
          t->nelements, t->nfacets, t->nfluid);
  fprintf(f, "  \"participants\": {\n");
  for (int i = 0; i < 3; i++) {
    WriteParticipant(f, reports, ROLES[i]);
    fprintf(f, i < 2 ? ",\n" : "\n");
  }
  fprintf(f, "  }\n}\n");
}

/* Which participant the run has waited for, seconds of this run; said, and kept in the reports. */
static void Advise(Server server, Reports *reports, double wall)
{
  AdviceInput in = {.shared = ServerSharesProcessors(server)};
  char line[256];
  static const char *const ROLES[] = {"fluid", "coupler", "solid"};
  for (int k = 0; k < 3; k++) in.ranks[k] = ServerRanks(server, ROLES[k]);
  in.seconds[0] = ServerWaitedFor(server, "fluid");
  in.seconds[2] = ServerWaitedFor(server, "solid");
  in.seconds[1] = fmax(wall - in.seconds[0] - in.seconds[2], 0.0);
  Collect(reports, "coupler", "seconds_waiting_for_fluid", in.seconds[0]);
  Collect(reports, "coupler", "seconds_waiting_for_solid", in.seconds[2]);
  AdviceWrite(&in, sizeof line, line);
  printf("coracle: %s\n", line);
  fflush(stdout);
}

PetscErrorCode SummaryWrite(Server server, const CouplerCase *c, const WriterTotals *t)
{
  static Reports reports;
  char path[600];
  PetscMPIInt rank;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  reports.n = 0;
  Collect(&reports, "coupler", "seconds_overlap", t->overlap);
  Collect(&reports, "coupler", "seconds_force", t->force);
  PetscCall(ServerReports(server, Collect, &reports));
  if (rank) PetscFunctionReturn(0);
  snprintf(path, sizeof path, "%s/trace.json", c->folder);
  PetscCall(ServerWriteTrace(server, path));
  Advise(server, &reports, ServerWall(server));
  snprintf(path, sizeof path, "%s/summary.json", c->folder);
  FILE *f = fopen(path, "w");
  if (!f) ServerFail(server, "%s: %s", path, strerror(errno));
  WriteAll(f, c, t, &reports);
  if (fclose(f)) ServerFail(server, "%s: %s", path, strerror(errno));
  PetscFunctionReturn(0);
}
