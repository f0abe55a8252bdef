#include "solid/alone_summary.h"
#include "common/link/resources.h"
#include "common/program/summary_file.h"
#include "solid/run.h"
#include <errno.h>
#include <stdio.h>
#include <string.h>

static const char *const ROLES[] = {"solid"};
static const char STEPS[] = "steps alone", *const USED[ALONE_NUSED] = {"cpu seconds alone", "seconds alone"};

/* The same on all ranks. */
static PetscErrorCode UsedSoFar(const AloneTotals *t, double used[ALONE_NUSED])
{
  PetscFunctionBeginUser;
  used[ALONE_CPU] = ProcessorSeconds();
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, used, 1, MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD));
  used[ALONE_WALL] = MPI_Wtime() - t->start;
  PetscCallMPI(MPI_Bcast(used + ALONE_WALL, 1, MPI_DOUBLE, 0, PETSC_COMM_WORLD));
  for (int k = 0; k < ALONE_NUSED; k++) used[k] += t->used[k];
  PetscFunctionReturn(0);
}

PetscErrorCode AloneTotalsSave(const AloneTotals *t, Checkpoint to)
{
  double used[ALONE_NUSED];
  PetscFunctionBeginUser;
  PetscCall(UsedSoFar(t, used));
  PetscCall(CheckpointPutNumber(to, STEPS, (double)t->steps));
  for (int k = 0; k < ALONE_NUSED; k++) PetscCall(CheckpointPutNumber(to, USED[k], used[k]));
  PetscFunctionReturn(0);
}

PetscErrorCode AloneTotalsLoad(AloneTotals *t, Checkpoint from, PetscBool *has)
{
  double steps;
  PetscFunctionBeginUser;
  *has = CheckpointHasNumber(from, STEPS);
  if (!*has) PetscFunctionReturn(0);
  PetscCall(CheckpointGetNumber(from, STEPS, &steps));
  t->steps = (long long)steps;
  for (int k = 0; k < ALONE_NUSED && CheckpointHasNumber(from, USED[k]); k++) /* not in those of 0.1.0 */
    PetscCall(CheckpointGetNumber(from, USED[k], &t->used[k]));
  PetscFunctionReturn(0);
}

static int Tell(void *reports, const char *key, double value, int sum)
{
  if (MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_DOUBLE, sum ? MPI_SUM : MPI_MAX, PETSC_COMM_WORLD)) return 1;
  SummaryReport(reports, ROLES[0], key, value);
  return 0;
}

static PetscErrorCode TellResources(SummaryReports *reports, const AloneTotals *t)
{
  double used[ALONE_NUSED];
  PetscFunctionBeginUser;
  PetscCall(UsedSoFar(t, used));
  PetscCall(Tell(reports, "ranks", 1.0, 1));
  PetscCall(Tell(reports, "seconds_cpu", used[ALONE_CPU], 0));
  PetscCall(Tell(reports, "seconds_wall", used[ALONE_WALL], 0));
  PetscCall(Tell(reports, "peak_memory_mb", PeakMemory(), 1));
  PetscFunctionReturn(0);
}

static void WriteAll(FILE *f, double end, const AloneTotals *t, const long long count[2],
                     const SummaryReports *reports)
{
  SummaryFileHead(f, t->name, t->note, "alone");
  SummaryFileField(f, "resumed_at", t->resumed);
  SummaryFileField(f, "end_time", end);
  SummaryFileField(f, "steps", (double)t->steps);
  fprintf(f, "  \"elements\": {\"solid\": %lld, \"surface\": %lld},\n", count[0], count[1]);
  SummaryFileParticipants(f, reports, 1, ROLES);
}

PetscErrorCode AloneSummaryWrite(Solid solid, const AloneTotals *t)
{
  SummaryReports reports = {0};
  char path[PETSC_MAX_PATH_LEN];
  SolidView v;
  PetscMPIInt rank;
  PetscFunctionBeginUser;
  SolidGetView(solid, &v);
  long long count[2] = {v.nelements, v.nfacets};
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, count, 2, MPI_LONG_LONG, MPI_SUM, PETSC_COMM_WORLD));
  PetscCall(SolidReport(solid, Tell, &reports));
  PetscCall(TellResources(&reports, t));
  PetscCallMPI(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  if (rank) {
    SummaryReportsFree(&reports);
    PetscFunctionReturn(0);
  }
  snprintf(path, sizeof path, "%s/summary.json", t->folder);
  FILE *f = fopen(path, "w");
  PetscCheck(f, PETSC_COMM_SELF, PETSC_ERR_FILE_OPEN, "%s: %s", path, strerror(errno));
  WriteAll(f, SolidGetStats(solid)->t, t, count, &reports);
  SummaryReportsFree(&reports);
  const int bad = ferror(f);
  PetscCheck(!fclose(f) && !bad, PETSC_COMM_SELF, PETSC_ERR_FILE_WRITE, "%s: %s", path, strerror(errno));
  PetscFunctionReturn(0);
}
