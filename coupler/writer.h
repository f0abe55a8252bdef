/* What the coupler leaves behind and says on the way: coupler.csv (a row a step), coupler.h5/.xdmf (the
 * shell), a line of progress about once a second, and the numbers that summary.json needs. */
#ifndef CORACLE_RECORD_H
#define CORACLE_RECORD_H
#include "common/output/output.h"
#include "coupler/bulk_motion.h"
#include "coupler/coupler_case.h"

/* One step, the same on all ranks. */
typedef struct {
  double t, dt; /* s; t: the step's end */
  BulkMotion motion;
  ForceTotals totals;
  double overlap, force, waiting; /* seconds spent in this step */
  int tries;
} StepRecord;

typedef struct {
  long long steps, tries;
  double resumed;        /* s, where the run has gone on from a checkpoint; 0: from the start */
  double imbalance;      /* the largest */
  double end;            /* s, time reached */
  double terminal;       /* m/s, mean downward velocity over the last 5 % of the time */
  double overlap, force; /* seconds, largest of all ranks */
  long long nelements, nfacets, nfluid; /* solid elements, facets, fluid elements near the solid at the end */
} WriterTotals;

typedef struct Writer_s *Writer;

/* Collective, as all of these. */
PetscErrorCode WriterCreate(MPI_Comm comm, const CouplerCase *c, Checkpoint from, Writer *record);
/* With what WriterCreate then goes on from. */
PetscErrorCode WriterSave(Writer record, Checkpoint to);
long long WriterSteps(Writer record); /* not collective */
/* The shell at time t if a snapshot is due. */
PetscErrorCode WriterShell(Writer record, double t, const Coupler coupler, const ServerSolid *solid);
PetscErrorCode WriterStep(Writer record, const StepRecord *step);
/* nfluid: fluid elements near the solid on this rank. */
PetscErrorCode WriterTotalsOf(Writer record, int nfluid, WriterTotals *totals);
PetscErrorCode WriterDestroy(Writer *record);
#endif
