/* The region near the solid from which the fluid sends its elements: at most REGION_BOXES boxes around
 * clusters of the solid's triangles and facets, widened by a margin that the solid may move before they are
 * renewed.  The more facets there are, the more clusters, so that those of many bodies do not hold what is between them.
 *
 *      +-------------+
 *      |  .-------.  |         a cluster: the simplices whose centres are in one cell of a
 *      |  |cluster|  | margin  side x side grid on the solid's bounding box
 *      |  '-------'  |         side^2: a REGION_FACETS-th of the facets, within bounds
 *      +-------------+ */
#ifndef CORACLE_REGION_H
#define CORACLE_REGION_H
#include "coupler/geometry/fluid_state.h"
#include "coupler/geometry/solid_state.h"

enum {
  REGION_SIDE_MIN = 16,
  REGION_SIDE_MAX = 64,
  REGION_BOXES = REGION_SIDE_MAX * REGION_SIDE_MAX,
  REGION_FACETS = 4,
  REGION_STEPS = 20
};

typedef struct {
  MPI_Comm comm;
  double thickness; /* of the shell, m */
  double margin;    /* m */
  int nbox;
  double box[REGION_BOXES][2][2]; /* lower and upper corners: the same on all ranks */
  int n;
  double *x; /* [n][2] positions of this rank's nodes at the last update, m */
} * Region;

PetscErrorCode RegionCreate(MPI_Comm comm, double thickness, Region *region);
/* Collective: boxes around the solid as it is now.  The margin is the way of the fastest node in REGION_STEPS
 * steps of dt, but at most a fifth of the body's size (the root of the clusters' area) and at least that of one
 * step, and 8 shell thicknesses. */
PetscErrorCode RegionUpdate(Region region, const SolidState *solid, double dt);
/* Collective: has a node moved farther than the margin since, or will it by the middle of a step of dt seconds, or
 * has the solid changed its mesh? */
PetscErrorCode RegionStale(Region region, const SolidState *solid, double dt, PetscBool *stale);
/* Collective: the smallest global id of the nodes that are farther than margin, m, outside of the domain and, on the one rank that gets *local
 * >= 0, its local index; *gid < 0: none. */
PetscErrorCode RegionOutside(Region region, const SolidState *solid, const FluidElements *elements,
                             double margin, long long *gid, int *local);
PetscErrorCode RegionDestroy(Region *region);
#endif
