/* How the solid as a whole moves. */
#ifndef CORACLE_MOTION_H
#define CORACLE_MOTION_H
#include "common/link/server.h"
#include <petscsys.h>

typedef struct {
  double velocity[2]; /* m/s, the mean over the volume, or over the surface of a solid without volume */
  long long nelements, nfacets; /* on all ranks */
} BulkMotion;

/* Collective.  Every element is given by one rank, so nodes shared by ranks count once. */
PetscErrorCode BulkMotionOf(MPI_Comm comm, const ServerSolid *solid, BulkMotion *motion);
/* Not collective: what the solid's nodes have, value[nnodes][2], on the nodes that the step began with,
 * start[n][2]: where cracks have split one, the mean over the corners of its elements.  Nodes without
 * elements keep what is there in start. */
PetscErrorCode BulkMotionOnStart(const ServerSolid *solid, const double value[], int n, double start[]);
#endif
