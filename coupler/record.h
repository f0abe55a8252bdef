/* What the coupler leaves behind and says on the way: coupler.csv (a row a step), coupler.h5/.xdmf (the
 * shell), a line of progress about once a second, and the numbers that summary.json needs. */
#ifndef CORACLE_RECORD_H
#define CORACLE_RECORD_H
#include "coupler_case.h"
#include "motion.h"
#include "output.h"

/* One step, the same on all ranks. */
typedef struct {
  double t, dt; /* s; t: the step's end */
  Motion motion;
  ForceTotals totals;
  double overlap, force, waiting; /* seconds spent in this step */
  int tries;
} RecordedStep;

typedef struct {
  long long steps, tries;
  double resumed;        /* s, where the run has gone on from a checkpoint; 0: from the start */
  double imbalance;      /* the largest */
  double end;            /* s, time reached */
  double terminal;       /* m/s, mean downward velocity over the last 5 % of the time */
  double overlap, force; /* seconds, largest of all ranks */
  long long nelements, nfacets, nfluid; /* solid elements, facets, fluid elements near the solid at the end */
} RecordTotals;

typedef struct Record_s *Record;

/* Collective, as all of these. */
PetscErrorCode RecordCreate(MPI_Comm comm, const CouplerCase *c, Checkpoint from, Record *record);
/* With what RecordCreate then goes on from. */
PetscErrorCode RecordSave(Record record, Checkpoint to);
long long RecordSteps(Record record); /* not collective */
/* The shell at time t if a snapshot is due. */
PetscErrorCode RecordShell(Record record, double t, const Coupler coupler, const ServerSolid *solid);
PetscErrorCode RecordStep(Record record, const RecordedStep *step);
/* nfluid: fluid elements near the solid on this rank. */
PetscErrorCode RecordTotalsOf(Record record, int nfluid, RecordTotals *totals);
PetscErrorCode RecordDestroy(Record *record);
#endif
