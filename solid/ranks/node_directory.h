/* One partition of the nodes that stays: that which the coupler knows (exchange.h).  When elements change ranks the
 * solid's own partition becomes another one, and the directory brings what is exchanged from where a node is
 * registered to where it is present, and back:
 *
 *     registered                                    present
 *     rank 0: gid 3 5 8     --NodeDirectoryLoad-->      rank 0: 3 5 7 9
 *     rank 1: gid 5 7 9     <--NodeDirectoryMotion--    rank 1: 5 8 9
 *
 * Gids stay; a crack makes new ones, and then a new directory is due. */
#ifndef SOLID_NODE_DIRECTORY_H
#define SOLID_NODE_DIRECTORY_H
#include "solid/solid.h"

typedef struct NodeDirectory_s *NodeDirectory;

typedef struct {
  double x[2], mean[2];                                    /* m; over the step, m/s */
  double interface_velocity[2], mobility, acceleration[2]; /* what SolidUpdateInterfaceMotion has left */
} NodeMotion;

/* Not collective: registers this rank's nodes as they are now, in their order.  The solid is borrowed. */
PetscErrorCode NodeDirectoryCreate(Solid s, NodeDirectory *directory);
PetscErrorCode NodeDirectoryDestroy(NodeDirectory *directory);
/* Not collective: the number of nodes registered on this rank; whether nodes are present where they are registered, and
 * whether all that are present are registered, on all ranks. */
int NodeDirectorySize(NodeDirectory directory);
PetscBool NodeDirectoryIsPresent(NodeDirectory directory);
PetscBool NodeDirectoryIsComplete(NodeDirectory directory);

/* Collective: motion[size] of the registered nodes, from where they are present. */
PetscErrorCode NodeDirectoryMotion(NodeDirectory directory, NodeMotion motion[]);
/* Collective: load[size][2] on the registered nodes, this rank's part, to present[nnodes][2] for SolidStart. */
PetscErrorCode NodeDirectoryLoad(NodeDirectory directory, const double load[], double present[]);
#endif
