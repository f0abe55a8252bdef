/* The time loop: the coupled steps from the start, or from a checkpoint, to time.end. */
#ifndef CORACLE_TIME_LOOP_H
#define CORACLE_TIME_LOOP_H
#include "common/link/server.h"
#include "coupler/region.h"
#include "coupler/writer.h"

typedef struct {
  Server server; /* borrowed, as all of these */
  const CouplerCase *c;
  Coupler coupler;
  Region region;
  Writer writer;
  Checkpoint from; /* that the run resumes from; NULL: from the start */
} TimeLoop;

/* Collective.  Returns when the end is reached and all clients have closed. */
PetscErrorCode TimeLoopRun(const TimeLoop *loop);
#endif
