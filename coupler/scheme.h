/* How the coupled steps follow each other.  A scheme runs from time 0 to the end; another one (strong
 * coupling) is another file with the same signature. */
#ifndef CORACLE_SCHEME_H
#define CORACLE_SCHEME_H
#include "record.h"
#include "region.h"

typedef struct {
  Server server; /* borrowed, as all of these */
  const CouplerCase *c;
  Coupler coupler;
  Region region;
  Record record;
  Checkpoint from; /* that the run goes on from; NULL: from the start */
} Scheme;

/* Collective.  Each step once: the fluid implicit, the solid with the force of the same step (method.md
 * sections 6 and 9). */
PetscErrorCode SchemeStaggered(const Scheme *scheme);
#endif
