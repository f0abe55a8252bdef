/* The time loop: the coupled steps from the start, or from a checkpoint, to time.end. */
#ifndef CORACLE_TIME_LOOP_H
#define CORACLE_TIME_LOOP_H
#include "common/link/server.h"
#include "common/output/claim.h"
#include "coupler/output/writer.h"
#include "coupler/region.h"

typedef struct {
  Server server; /* borrowed, as all of these */
  const CouplerCase *c;
  Coupler coupler;
  Region region;
  Writer writer;   /* created when all participants have accepted the case */
  Claim claim;     /* on output.folder, from then on */
  Checkpoint from; /* that the run resumes from; NULL: from the start */
} TimeLoop;

/* Collective.  Creates writer and claim; returns when the end is reached and all clients have closed. */
PetscErrorCode TimeLoopRun(TimeLoop *loop);
#endif
