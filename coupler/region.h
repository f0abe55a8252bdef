/* The region near the solid for which the fluid is asked: at most REGION_BOXES boxes around clusters of the
 * solid's triangles and facets, widened by a margin so that the solid can move that far before the fluid is
 * asked again. */
#ifndef CORACLE_REGION_H
#define CORACLE_REGION_H
#include "common/link/server.h"
#include <petscsys.h>

enum { REGION_SIDE = 16, REGION_BOXES = REGION_SIDE * REGION_SIDE, REGION_STEPS = 20 };

typedef struct {
  MPI_Comm comm;
  double thickness; /* of the shell, m */
  double margin;    /* m */
  int nbox;
  double box[REGION_BOXES][2][2]; /* lower and upper corners: the same on all ranks */
  int n;
  double *x; /* [n][2] where this rank's nodes were */
} * Region;

PetscErrorCode RegionCreate(MPI_Comm comm, double thickness, Region *region);
/* Collective: boxes around the solid as it is now.  The margin is what the fastest node travels in REGION_STEPS steps of
 * dt, but at most a fifth of the body's size (the root of the clusters' area) and at least 8 shell thicknesses. */
PetscErrorCode RegionUpdate(Region region, const ServerSolid *solid, double dt);
/* Collective: has some node moved farther than the margin since, or is the solid another one? */
PetscErrorCode RegionStale(Region region, const ServerSolid *solid, PetscBool *stale);
/* Collective: the smallest global id of the nodes outside of the domain and, on the one rank that gets *local
 * >= 0, its local index; *gid < 0: none. */
PetscErrorCode RegionOutside(Region region, const ServerSolid *solid, const ServerElements *elements,
                             long long *gid, int *local);
PetscErrorCode RegionDestroy(Region *region);
#endif
