/* The keys of a run that every program reads, and what those mean that more than one reads. */
#ifndef CORACLE_RUN_CASE_H
#define CORACLE_RUN_CASE_H
#include "common/link/case_file.h"

typedef struct {
  const char *folder;  /* output.folder, borrowed until CoracleCaseClose */
  double every, end;   /* s: output.every, time.end */
  double series_every; /* s, 0: each step (output.series_every) */
  double checkpoint;   /* s by the clock: from one checkpoint to the next, 0: none (output.checkpoint) */
  double
      walltime; /* s by the clock: after which the run ends with a checkpoint, 0: at time.end (time.walltime) */
} RunCase;

void RunCaseRead(CoracleCase c, RunCase *r);
/* Prints a note if steps of at most `longest` are longer than a run to `end`, s. */
void RunCaseNoteSteps(double end, double longest);
/* A note where a run may end early, with all that it has made lost: walltime and checkpoint, s, 0: none. */
void RunCaseNoteUnsaved(double walltime, double checkpoint);
/* The program's own table and that of gravity, time and output (CoracleCaseDescribe). */
void RunCaseDescribe(CoracleCase c, const CoracleCaseKey own[]);
#endif
