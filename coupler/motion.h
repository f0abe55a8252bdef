/* How the solid as a whole moves. */
#ifndef CORACLE_MOTION_H
#define CORACLE_MOTION_H
#include "server.h"
#include <petscsys.h>

typedef struct {
  double velocity[2]; /* m/s, the mean over the volume, or over the surface of a solid without volume */
  long long nelements, nfacets; /* on all ranks */
} Motion;

/* Collective.  Every element is given by one rank, so nodes shared by ranks count once. */
PetscErrorCode MotionOf(MPI_Comm comm, const ServerSolid *solid, Motion *motion);
#endif
