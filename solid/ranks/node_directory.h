/* Nodes by their gid, for callers that do not know on which rank they are now: elements that have changed ranks
 * (migrate.c), and the mesh that is registered with the coupler (exchange.h).  The rank of a node follows from its gid
 * and the partition, which every rank knows; so a request goes straight to that rank. */
#ifndef SOLID_NODE_DIRECTORY_H
#define SOLID_NODE_DIRECTORY_H
#include "solid/solid.h"

/* This rank's nodes by gid.  Not collective. */
typedef struct {
  long long gid;
  int node;
} NodeName;

typedef struct {
  Solid s;        /* borrowed */
  NodeName *name; /* [nnodes] */
} NodeNames;

PetscErrorCode NodeNamesCreate(Solid s, NodeNames *names);
int NodeNamesFind(const NodeNames *names, long long gid); /* -1: not here */
PetscErrorCode NodeNamesDestroy(NodeNames *names);

typedef struct {
  double x[2], mean[2];                                    /* m; over the step, m/s */
  double interface_velocity[2], mobility, acceleration[2]; /* what SolidUpdateInterfaceMotion has left */
} NodeMotion;

/* Collective: motion[n] of the nodes gid[n], which may be on any rank.  The solid has `rebalance`. */
PetscErrorCode NodeDirectoryMotion(Solid s, int n, const long long gid[], NodeMotion motion[]);
/* Collective: forces load[n][2] on nodes gid[n], this rank's part, to home[nnodes][2] for SolidStart. */
PetscErrorCode NodeDirectoryLoad(Solid s, int n, const long long gid[], const double load[], double owned[]);

/* Fills the record of this rank's node. */
typedef void (*NodeAnswer)(const Solid s, int node, void *record);
/* Collective: record[n], `bytes` long each, is what a rank that has node gid[k] for certain answers. */
PetscErrorCode NodesRequest(Solid s, int n, const long long gid[], size_t bytes, NodeAnswer answer,
                            void *record);
#endif
