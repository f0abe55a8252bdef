/* The bulk motion of the solid: mean velocity and size over all ranks. */
#ifndef CORACLE_BULK_MOTION_H
#define CORACLE_BULK_MOTION_H
#include "coupler/geometry/solid_state.h"
#include <petscsys.h>

typedef struct {
  double velocity[2]; /* m/s, the mean over the volume, or over the surface of a solid without volume */
  long long nelements, nfacets; /* on all ranks */
  int held;                     /* a node has no mobility: it is fixed, or moves as prescribed */
} BulkMotion;

/* Collective.  Integrals over elements (or facets), each of which is on one rank: shared nodes count once. */
PetscErrorCode BulkMotionOf(MPI_Comm comm, const SolidState *solid, BulkMotion *motion);
#endif
