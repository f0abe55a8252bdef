/* What has happened to the solid since the start: of its nodes, its joints and its springs of friction, by
 * numbers that are the same on any ranks.  A subdomain that is taken from the model is intact and at rest; it
 * becomes the solid's when it receives the state, from the ranks that had the elements before (migrate.c) or from a
 * file (checkpoint.c). */
#ifndef SOLID_STATE_H
#define SOLID_STATE_H
#include "solid/contact/contact_impl.h"
#include "solid/cracks/joints_impl.h"

/* Of one node; numbers alone, a row of a file. */
typedef struct {
  double x[2], v[2], start[2], load[2];
  double interface_velocity[2], mobility, acceleration[2]; /* what SolidUpdateInterfaceMotion has left */
} NodeState;

/* Not collective: fills a NodeState; a NodeAnswer of node_names.h. */
void StateOfNode(const Solid s, int node, void *record);
/* Not collective: this rank's slips, allocated, with edges numbered 3 (element in the model) + side. */
PetscErrorCode StateOfSlips(Solid s, int *n, Slip **slip);
/* Not collective: this rank's element of that number in the model, or -1. */
int StateElement(const Solid s, long long number);

/* Where the state comes from; all are collective. */
typedef struct {
  void *context;
  PetscErrorCode (*joints)(void *context, Joints j); /* memory of those that are not intact */
  PetscErrorCode (*nodes)(void *context, Solid to, NodeState node[]);    /* [to->nnodes] by gid */
  PetscErrorCode (*slips)(void *context, Solid to, int *n, Slip **slip); /* as above, of to's elements */
} StateSource;

/* Collective: s is a subdomain as the model has it. */
PetscErrorCode SolidTakeState(Solid s, const StateSource *from);

/* state_file.c, collective: the state into a checkpoint, and out of it; the elements to the ranks that had them. */
PetscErrorCode StateToFile(Solid s, Checkpoint to);
StateSource StateFromFile(Checkpoint from);
PetscErrorCode StateTakePartition(Solid s, Checkpoint from);
#endif
