/* Whether a run ends, with a checkpoint if it makes any, before time.end: time.walltime has passed, or its output folder has a file `stop`.  A batch
 * job has a limit of its own, and a run that is killed there loses what it has done since the last checkpoint. */
#ifndef CORACLE_EARLY_STOP_H
#define CORACLE_EARLY_STOP_H
#include <petscsys.h>

typedef struct {
  char path[PETSC_MAX_PATH_LEN]; /* of the file */
  double walltime, begun,
      looked; /* by the clock, s: time.walltime (0: none); MPI_Wtime of the run's start, of the last look */
  PetscBool saves; /* with a checkpoint */
} EarlyStop;

/* Removes a file that an earlier run has left.  folder: output.folder, which has been claimed; saves: the run makes checkpoints; elapsed: what of walltime has
 * passed, s.
 * Collective over PETSC_COMM_WORLD. */
PetscErrorCode EarlyStopBegin(const char *folder, double walltime, PetscBool saves, double elapsed,
                              EarlyStop *s);
/* After each step.  Rank 0 looks at the file about once a second; it removes it, and says at which time t, s, the run ends.  Collective over
 * PETSC_COMM_WORLD. */
PetscErrorCode EarlyStopDue(EarlyStop *s, double t, PetscBool *due);
#endif
