/* Nodes by their gid, which is the same on all ranks and in all partitions.  The rank that has a node for certain follows
 * from its gid and the partition, which every rank knows; so a request goes straight to that rank. */
#ifndef SOLID_NODE_NAMES_H
#define SOLID_NODE_NAMES_H
#include "solid/solid.h"

typedef struct {
  long long gid;
  int node;
} NodeName;

/* Nodes gid[n] by gid, ascending.  Not collective. */
typedef struct {
  int n;
  NodeName *name; /* [n] */
} NodeNames;

PetscErrorCode NodeNamesCreate(int n, const long long gid[], NodeNames *names);
int NodeNamesFind(const NodeNames *names, long long gid); /* -1: not here */
PetscErrorCode NodeNamesDestroy(NodeNames *names);

/* Not collective: of[n], the ranks that have the nodes gid[n] for certain.  The solid has `rebalance`. */
PetscErrorCode NodeRanks(Solid s, int n, const long long gid[], int of[]);

/* Fills the record of this rank's node. */
typedef void (*NodeAnswer)(const Solid s, int node, void *record);
/* Collective: record[n], `bytes` long each, is what a rank that has node gid[k] for certain answers.  The solid has
 * `rebalance`. */
PetscErrorCode NodesRequest(Solid s, int n, const long long gid[], size_t bytes, NodeAnswer answer,
                            void *record);
#endif
