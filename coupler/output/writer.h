/* The coupler's output: coupler.csv (one row per accepted step), coupler.h5 and .xdmf (the shell), a line of
 * progress about once a second, and the totals for summary.json.
 * A new column of coupler.csv: COLUMNS and WriterStep in writer.c, from a field of StepRecord.
 * All functions are collective unless said otherwise. */
#ifndef CORACLE_COUPLER_WRITER_H
#define CORACLE_COUPLER_WRITER_H
#include "common/output/output.h"
#include "coupler/geometry/bulk_motion.h"
#include "coupler/input/coupler_case.h"

/* One accepted step, the same on all ranks. */
typedef struct {
  double t, dt; /* s; t: the step's end */
  BulkMotion motion;
  ForceTotals totals;
  double overlap, force, waiting; /* seconds spent in this step */
  int iterations;                 /* coupling iterations */
} StepRecord;

typedef struct {
  long long steps, iterations;
  double resumed;        /* s, time of the checkpoint that the run resumes from; 0: from the start */
  double imbalance;      /* the largest */
  double end;            /* s, time reached */
  double terminal;       /* m/s, mean downward velocity over the last 5 % of the time */
  double overlap, force; /* seconds, largest of all ranks */
  long long nelements, nfacets, nfluid; /* solid elements, facets, fluid elements near the solid at the end */
} WriterTotals;

typedef struct Writer_s *Writer;

/* from: the checkpoint to resume from, or NULL. */
PetscErrorCode WriterCreate(MPI_Comm comm, const CouplerCase *c, Checkpoint from, Writer *writer);
/* Saves what WriterCreate resumes from. */
PetscErrorCode WriterSave(Writer writer, Checkpoint to);
long long WriterSteps(Writer writer); /* not collective */
/* The shell at time t if a snapshot is due. */
PetscErrorCode WriterShell(Writer writer, double t, const Coupler coupler, const SolidState *solid);
PetscErrorCode WriterStep(Writer writer, const StepRecord *step);
/* nfluid: fluid elements near the solid on this rank. */
PetscErrorCode WriterTotalsOf(Writer writer, int nfluid, WriterTotals *totals);
PetscErrorCode WriterDestroy(Writer *writer);
#endif
