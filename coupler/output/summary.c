#include "coupler/output/summary.h"
#include "common/program/summary_file.h"
#include "coupler/output/advice.h"
#include <errno.h>
#include <string.h>

static const char *const ROLES[] = {"fluid", "coupler", "solid"};

static void WriteAll(FILE *f, const CouplerCase *c, const WriterTotals *t, const SummaryReports *reports)
{
  SummaryFileHead(f, c->name, c->note, COUPLER_MODES[c->options.mode]);
  SummaryFileField(f, "resumed_at", t->resumed);
  SummaryFileField(f, "end_time", t->end);
  SummaryFileField(f, "steps", (double)t->steps);
  SummaryFileField(f, "iterations", (double)t->iterations);
  SummaryFileField(f, "terminal_velocity", t->terminal);
  SummaryFileField(f, "largest_momentum_imbalance", t->imbalance);
  fprintf(f, "  \"elements\": {\"solid\": %lld, \"surface\": %lld, \"fluid_near_solid\": %lld},\n",
          t->nelements, t->nfacets, t->nfluid);
  SummaryFileParticipants(f, reports, 3, ROLES);
}

/* Which participant the run has waited for, seconds of this run; said, and kept in the reports. */
static void Advise(Server server, SummaryReports *reports, double wall)
{
  AdviceInput in = {.shared = ServerSharesProcessors(server)};
  char line[256];
  for (int k = 0; k < 3; k++) in.ranks[k] = ServerRanks(server, ROLES[k]);
  in.seconds[0] = ServerWaitedFor(server, "fluid");
  in.seconds[2] = ServerWaitedFor(server, "solid");
  in.seconds[1] = fmax(wall - in.seconds[0] - in.seconds[2], 0.0);
  SummaryReport(reports, "coupler", "seconds_waiting_for_fluid", in.seconds[0]);
  SummaryReport(reports, "coupler", "seconds_waiting_for_solid", in.seconds[2]);
  AdviceWrite(&in, sizeof line, line);
  printf("coracle: %s\n", line);
  fflush(stdout);
}

PetscErrorCode SummaryWrite(Server server, const CouplerCase *c, const WriterTotals *t)
{
  SummaryReports reports = {0};
  char path[600];
  PetscMPIInt rank;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  SummaryReport(&reports, "coupler", "seconds_overlap", t->overlap);
  SummaryReport(&reports, "coupler", "seconds_force", t->force);
  PetscCall(ServerReports(server, SummaryReport, &reports));
  if (rank) {
    SummaryReportsFree(&reports);
    PetscFunctionReturn(0);
  }
  snprintf(path, sizeof path, "%s/trace.json", c->run.folder);
  PetscCall(ServerWriteTrace(server, path));
  Advise(server, &reports, ServerWall(server));
  snprintf(path, sizeof path, "%s/summary.json", c->run.folder);
  FILE *f = fopen(path, "w");
  if (!f) ServerFail(server, "%s: %s", path, strerror(errno));
  WriteAll(f, c, t, &reports);
  SummaryReportsFree(&reports);
  if (fclose(f)) ServerFail(server, "%s: %s", path, strerror(errno));
  PetscFunctionReturn(0);
}
