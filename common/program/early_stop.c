#include "common/program/early_stop.h"
#include <stdio.h>

PetscErrorCode EarlyStopBegin(const char *folder, double walltime, PetscBool saves, double elapsed,
                              EarlyStop *s)
{
  PetscMPIInt rank;

  PetscFunctionBeginUser;
  *s = (EarlyStop){
      .walltime = walltime, .saves = saves, .begun = MPI_Wtime() - elapsed, .looked = MPI_Wtime()};
  snprintf(s->path, sizeof s->path, "%s/stop", folder);
  PetscCallMPI(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  if (!rank) remove(s->path);
  PetscFunctionReturn(0);
}

/* Whether somebody has made the file, which is gone then: about once a second, for a cluster's file system is slow. */
static PetscBool IsAsked(EarlyStop *s, double now)
{
  if (now - s->looked < 1.0) return PETSC_FALSE;
  s->looked = now;
  return (PetscBool)(remove(s->path) == 0);
}

static void Say(double t, const char *reason, PetscBool saves)
{
  printf("coracle: ends at t = %g s, before time.end: %s%s\n", t, reason,
         saves ? "" : "; without a checkpoint, as output.checkpoint is 0");
  fflush(stdout);
}

PetscErrorCode EarlyStopDue(EarlyStop *s, double t, PetscBool *due)
{
  PetscMPIInt rank;
  int stop = 0;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  if (!rank) {
    const double now = MPI_Wtime();
    const PetscBool late = (PetscBool)(s->walltime > 0.0 && now - s->begun >= s->walltime);
    stop = late || IsAsked(s, now);
    if (stop) Say(t, late ? "time.walltime has passed" : "asked to by a file stop", s->saves);
  }
  PetscCallMPI(MPI_Bcast(&stop, 1, MPI_INT, 0, PETSC_COMM_WORLD));
  *due = stop ? PETSC_TRUE : PETSC_FALSE;
  PetscFunctionReturn(0);
}
