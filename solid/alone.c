#include "solid/alone.h"
#include "common/link/affinity.h"
#include "common/link/participant.h"
#include "common/output/checkpoint_folder.h"
#include "common/output/claim.h"
#include "common/output/folder.h"
#include "common/output/time_reached.h"
#include "common/program/case_copy.h"
#include "common/program/early_stop.h"
#include "common/program/program.h"
#include "common/program/run_case.h"
#include "solid/alone_summary.h"
#include "solid/solid_case.h"
#include "solid/writer.h"
#include <stdio.h>
#include <unistd.h>

/* What concerns every rank is said by the first; the others wait for their end. */
static void Refuse(void *context, const char *message)
{
  PetscMPIInt rank;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (rank) sleep(5);
  fflush(stdout);
  fprintf(stderr, "coracle solid[%d]: error: %s\n", rank, message);
  ParticipantAbort();
}

typedef struct {
  RunCase keys;
  char run[CHECKPOINT_RUN];
  double longest; /* s, the largest step */
  AloneTotals totals;
  Solid solid;
  Writer writer;
} Run;

/* About once a second, and at the end. */
static void Say(const Run *m, double dt, double begun, double start, double *said)
{
  const double now = MPI_Wtime(), spent = now - start;
  const SolidStats *stats = SolidGetStats(m->solid);
  PetscMPIInt rank;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  const double left = m->keys.end - stats->t;
  if (rank || (now - *said < 1.0 && left > 0.5 * dt)) return;
  *said = now;
  printf("coracle: t %.5g s of %g, step %lld, dt %.3g s, %d substeps, %.0f s done, about %.0f s to go\n",
         stats->t, m->keys.end, m->totals.steps, dt, stats->substeps, spent,
         spent * left / (stats->t - begun));
  fflush(stdout);
}

/* --- checkpoints (common/output/checkpoint_folder.h) ---------------------------------------------------- */

static PetscErrorCode Load(Run *m, Checkpoint from)
{
  PetscBool alone;
  PetscFunctionBeginUser;
  PetscCall(AloneTotalsLoad(&m->totals, from, &alone));
  if (!alone) Refuse(NULL, "key 'resume': that is a checkpoint of a run with a fluid");
  PetscCall(SolidLoad(m->solid, from));
  m->totals.resumed = SolidGetStats(m->solid)->t;
  PetscFunctionReturn(0);
}

static PetscErrorCode Save(const Run *m)
{
  char path[PETSC_MAX_PATH_LEN];
  Checkpoint to;
  PetscMPIInt rank;
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  snprintf(path, sizeof path, "%s/" CORACLE_CHECKPOINT ".%lld", m->keys.folder, m->totals.steps);
  if (!rank) PetscCall(CheckpointFolderMake(path, m->run, m->totals.steps, SolidGetStats(m->solid)->t));
  PetscCallMPI(MPI_Barrier(PETSC_COMM_WORLD));
  PetscCall(CheckpointCreate(PETSC_COMM_WORLD, path, "solid", &to));
  PetscCall(AloneTotalsSave(&m->totals, to));
  PetscCall(SolidSave(m->solid, to));
  PetscCall(WriterSave(m->writer, 0.0, to));
  PetscCall(CheckpointClose(&to));
  if (!rank) PetscCall(CheckpointFolderPublish(path));
  PetscFunctionReturn(0);
}

static PetscErrorCode SaveIfDue(const Run *m, PetscBool ends, double *last)
{
  PetscFunctionBeginUser;
  if (m->keys.checkpoint <= 0.0) PetscFunctionReturn(0);
  int due = ends || MPI_Wtime() - *last >= m->keys.checkpoint;
  PetscCallMPI(MPI_Bcast(&due, 1, MPI_INT, 0, PETSC_COMM_WORLD));
  if (!due) PetscFunctionReturn(0);
  PetscCall(Save(m));
  *last = MPI_Wtime();
  PetscFunctionReturn(0);
}

static PetscErrorCode Advance(Run *m)
{
  const double start = MPI_Wtime(), begun = SolidGetStats(m->solid)->t, length = m->keys.end - begun;
  const double steps = TimeSteps(length, m->longest), dt = length / steps;
  double said = start, saved = start, h;
  EarlyStop early_stop;
  const char *why;
  PetscBool ends = PETSC_FALSE;
  PetscFunctionBeginUser;
  PetscCall(EarlyStopBegin(m->keys.folder, m->keys.walltime, (PetscBool)(m->keys.checkpoint > 0.0),
                           start - m->totals.start, &early_stop));
  for (double step = 1.0; !ends; step += 1.0) {
    PetscCall(SolidStart(m->solid, dt, NULL));
    while (SolidRemaining(m->solid)) PetscCall(SolidSubstep(m->solid, &h));
    PetscCall(SolidStepFailure(m->solid, &why));
    if (why) Refuse(NULL, why);
    PetscCall(SolidRebalance(m->solid));
    PetscCall(WriterStep(m->writer, m->solid, 0.0));
    m->totals.steps++;
    Say(m, dt, begun, start, &said);
    ends = (PetscBool)(step >= steps);
    if (!ends) PetscCall(EarlyStopDue(&early_stop, SolidGetStats(m->solid)->t, &ends));
    PetscCall(SaveIfDue(m, ends, &saved));
  }
  PetscFunctionReturn(0);
}

int AloneTake(int *argc, char **argv)
{
  int kept = 0, found = 0;
  for (int k = 0; k < *argc; k++) {
    found |= !strcmp(argv[k], "--alone");
    if (strcmp(argv[k], "--alone")) argv[kept++] = argv[k];
  }
  *argc = kept;
  return found;
}

static PetscErrorCode ReadRun(CoracleCase c, Run *m, char resume[PETSC_MAX_PATH_LEN])
{
  PetscFunctionBeginUser;
  RunCaseRead(c, &m->keys);
  m->longest = CoracleCasePositive(c, "time.dt_max");
  if (ParticipantFindResume(c, PETSC_MAX_PATH_LEN, resume))
    PetscCall(PetscPrintf(PETSC_COMM_WORLD,
                          "coracle: there is no %s/" CORACLE_CHECKPOINT ": begins at the start\n",
                          m->keys.folder));
  CheckpointFolderRun(m->run);
  m->totals.folder = m->keys.folder;
  m->totals.name = CoracleCaseStringOr(c, "case", "");
  m->totals.note = CoracleCaseStringOr(c, "note", "");
  PetscFunctionReturn(0);
}

static PetscErrorCode WriteCase(const char *folder, int argc, char **argv, CaseCopy *copy)
{
  char ranks[64];
  PetscMPIInt size;
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_size(PETSC_COMM_WORLD, &size));
  snprintf(ranks, sizeof ranks, "the solid alone, ranks %d", size);
  PetscCall(CaseCopyWrite(folder, ranks, argc, argv, copy));
  PetscFunctionReturn(0);
}

/* argc, argv: the command line, for case.yaml. */
static PetscErrorCode Begin(CoracleCase c, int argc, char **argv, Run *m, Claim *claim)
{
  Checkpoint from = NULL;
  CaseCopy copy;
  char resume[PETSC_MAX_PATH_LEN];
  PetscFunctionBeginUser;
  PetscCall(ReadRun(c, m, resume));
  PetscCall(SolidFromCase(c, PETSC_COMM_WORLD, &m->solid));
  if (resume[0]) {
    PetscCall(CheckpointOpen(PETSC_COMM_WORLD, resume, "solid", &from));
    PetscCall(Load(m, from));
  }
  const double t = SolidGetStats(m->solid)->t;
  if (TimeReached(t, m->keys.end))
    CoracleCaseRefuse(c, "time.end", "the checkpoint to resume from is at t = %g s already", t);
  const PetscBool resumes = (PetscBool)(from && FolderHolds(PETSC_COMM_WORLD, m->keys.folder, resume));
  PetscCall(CaseCopyTake(CoracleCasePath(c), &copy));
  PetscCall(ClaimFolder(PETSC_COMM_WORLD, m->keys.folder, resumes, claim));
  PetscCall(WriteCase(m->keys.folder, argc, argv, &copy));
  PetscCall(WriterCreate(c, PETSC_COMM_WORLD, m->solid, from, &m->writer));
  PetscCall(CheckpointClose(&from));
  PetscFunctionReturn(0);
}

int Alone(int argc, char **argv)
{
  CoracleCase c;
  Run m = {0};
  Claim claim;
  ProgramErrors errors = {Refuse, NULL};
  AffinityAlone();
  PetscCall(PetscInitialize(NULL, NULL, NULL, NULL));
  PetscCall(ProgramTellErrors(&errors));
  PetscCall(CoracleCaseOpen(argc, argv, Refuse, NULL, &c));
  m.totals.start = MPI_Wtime();
  PetscCall(Begin(c, argc, argv, &m, &claim));
  PetscCall(Advance(&m));
  PetscCall(AloneSummaryWrite(m.solid, &m.totals));
  PetscCall(WriterDestroy(&m.writer));
  PetscCall(ClaimRelease(&claim));
  PetscCall(SolidDestroy(&m.solid));
  PetscCall(PetscPopErrorHandler());
  PetscCall(CoracleCaseClose(&c)); /* the folder's name and gravity's rows are in it */
  return PetscFinalize();
}
