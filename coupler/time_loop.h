/* How the coupled steps follow each other. */
#ifndef CORACLE_SCHEME_H
#define CORACLE_SCHEME_H
#include "common/output/claim.h"
#include "coupler/region.h"
#include "coupler/writer.h"

typedef struct {
  Server server; /* borrowed, as all of these */
  const CouplerCase *c;
  Coupler coupler;
  Region region;
  Writer record;   /* made when all have accepted the case */
  Claim claim;     /* on the output folder, from then on */
  Checkpoint from; /* that the run goes on from; NULL: from the start */
} TimeLoop;

/* Collective: runs to the end, until all clients have closed.  A try of a step: the fluid implicit, the
 * solid with the force of the same step (method.md sections 6 and 9); tries.h says how many. */
PetscErrorCode TimeLoopRun(TimeLoop *scheme);
#endif
