/* summary.json of a solid alone, that of a coupled run without what fluid and coupler have in it, and what it counts. */
#ifndef SOLID_ALONE_SUMMARY_H
#define SOLID_ALONE_SUMMARY_H
#include "solid/solid.h"

enum { ALONE_CPU, ALONE_WALL, ALONE_NUSED };

typedef struct {
  const char *folder, *name, *note; /* borrowed */
  double start;                     /* s by the clock (MPI_Wtime), when this run began */
  double resumed;                   /* s, time of the checkpoint that it resumes from; 0: from the start */
  long long steps;                  /* also those of the runs before */
  double used[ALONE_NUSED];         /* seconds of all processors and by the clock, by the runs before */
} AloneTotals;

/* Collective over PETSC_COMM_WORLD, all.  Errors: a file that cannot be read or written. */
PetscErrorCode AloneTotalsSave(const AloneTotals *totals, Checkpoint to);
/* has: 0 where the checkpoint is not of a solid alone, and nothing is read. */
PetscErrorCode AloneTotalsLoad(AloneTotals *totals, Checkpoint from, PetscBool *has);
PetscErrorCode AloneSummaryWrite(Solid solid, const AloneTotals *totals);
#endif
