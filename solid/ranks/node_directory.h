/* One partition of the nodes that stays: that which the coupler knows (exchange.h).  When elements change ranks the
 * solid's own partition becomes another one, and the directory brings what is exchanged from where a node is
 * registered to where it is present, and back:
 *
 *     registered                                    present
 *     rank 0: gid 3 5 8     --NodeDirectoryLoad-->      rank 0: 3 5 7 9
 *     rank 1: gid 5 7 9     <--NodeDirectoryMotion--    rank 1: 5 8 9
 *
 * Gids stay.  A crack makes new ones: the directory is renewed then, with the same elements on the same ranks. */
#ifndef SOLID_NODE_DIRECTORY_H
#define SOLID_NODE_DIRECTORY_H
#include "solid/solid.h"

typedef struct NodeDirectory_s *NodeDirectory;

typedef struct {
  double x[2], mean[2];                                    /* m; over the step, m/s */
  double interface_velocity[2], mobility, acceleration[2]; /* what SolidUpdateInterfaceMotion has left */
} NodeMotion;

/* What is registered on this rank; borrowed until the directory is destroyed. */
typedef struct {
  int nnodes, nelements, nfacets;
  const long long *gid; /* [nnodes] */
  const int *element,
      *facet; /* [nelements][3], [nfacets][2] of the nodes; facets have the solid on their left */
} RegisteredMesh;

/* Not collective: registers this rank's nodes and elements as they are now, in their order.  The solid is borrowed. */
PetscErrorCode NodeDirectoryCreate(Solid s, NodeDirectory *directory);
/* Collective: *renewed has the directory's elements on its ranks and in its order, as cracks have made them since, on its
 * nodes and behind them those that are new. */
PetscErrorCode NodeDirectoryRenew(NodeDirectory directory, NodeDirectory *renewed);
PetscErrorCode NodeDirectoryDestroy(NodeDirectory *directory);
/* Not collective: whether nodes are present where they are registered, and whether all that are present are registered, on
 * all ranks. */
RegisteredMesh NodeDirectoryMesh(NodeDirectory directory);
PetscBool NodeDirectoryIsPresent(NodeDirectory directory);
PetscBool NodeDirectoryIsComplete(NodeDirectory directory);

/* Collective: motion[nnodes] of the registered nodes, from where they are present. */
PetscErrorCode NodeDirectoryMotion(NodeDirectory directory, NodeMotion motion[]);
/* Collective: load[nnodes][ncomp] on the registered nodes, this rank's part, to present[nnodes][ncomp] for SolidStart and SolidSetFilm; ncomp
 * is at most 4. */
PetscErrorCode NodeDirectoryLoad(NodeDirectory directory, int ncomp, const double load[], double present[]);
#endif
