#include "solid/alone.h"
#include "common/link/participant.h"
#include "common/output/claim.h"
#include "solid/solid_case.h"
#include "solid/writer.h"
#include <stdio.h>
#include <unistd.h>

static void Fail(void *context, const char *message)
{
  PetscMPIInt rank;
  (void)context;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  fflush(stdout);
  fprintf(stderr, "coracle solid[%d]: error: %s\n", rank, message);
  ParticipantAbort();
}

/* What concerns every rank is said by the first; the others wait for their end. */
static void Refuse(void *context, const char *message)
{
  PetscMPIInt rank;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (rank) sleep(5);
  Fail(context, message);
}

/* About once a second, and at the end. */
static void Say(const Solid s, int step, int steps, double dt, double start, double *said)
{
  const double now = MPI_Wtime(), spent = now - start;
  const SolidStats *stats = SolidGetStats(s);
  PetscMPIInt rank;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (rank || (now - *said < 1.0 && step < steps)) return;
  *said = now;
  printf("coracle: t %.5g s of %g, step %d, dt %.3g s, %d substeps, %.0f s done, about %.0f s to go\n",
         stats->t, steps * dt, step, dt, stats->substeps, spent, spent * (steps - step) / step);
  fflush(stdout);
}

static PetscErrorCode Run(Solid solid, Writer record, double end, double longest)
{
  const int steps = PetscMax(1, (int)ceil(end / longest * (1.0 - 1e-12)));
  const double start = MPI_Wtime(), dt = end / steps;
  double said = start, h;
  PetscFunctionBeginUser;
  for (int step = 1; step <= steps; step++) {
    PetscCall(SolidStart(solid, dt, NULL));
    while (SolidRemaining(solid)) PetscCall(SolidSubstep(solid, &h));
    PetscCall(SolidRebalance(solid));
    PetscCall(WriterStep(record, solid, 0.0));
    Say(solid, step, steps, dt, start, &said);
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

int Alone(int argc, char **argv)
{
  CoracleCase c;
  Solid solid;
  Writer record;
  Claim claim;
  PetscCall(PetscInitialize(NULL, NULL, NULL, NULL));
  PetscCall(CoracleCaseOpen(argc, argv, Refuse, NULL, &c));
  if (CoracleCaseHas(c, "resume")) CoracleCaseRefuse(c, "resume", "the solid alone makes no checkpoints");
  const double end = CoracleCasePositive(c, "time.end"), longest = CoracleCasePositive(c, "time.dt_max");
  PetscCall(SolidFromCase(c, PETSC_COMM_WORLD, Fail, NULL, &solid));
  PetscCall(ClaimFolder(PETSC_COMM_WORLD, CoracleCaseString(c, "output.folder"), PETSC_FALSE, &claim));
  PetscCall(WriterCreate(c, PETSC_COMM_WORLD, solid, NULL, &record));
  PetscCall(CoracleCaseClose(&c));
  PetscCall(Run(solid, record, end, longest));
  PetscCall(WriterDestroy(&record));
  PetscCall(ClaimRelease(&claim));
  PetscCall(SolidDestroy(&solid));
  return PetscFinalize();
}
