/* Sums over the copies of a node.  A node is identified by its global id; several ranks, or several clients of
 * one rank, may each hold a copy.  Collective. */
#ifndef CORACLE_NODE_SUM_H
#define CORACLE_NODE_SUM_H
#include <petscsys.h>

typedef struct NodeSum_s *NodeSum;

PetscErrorCode NodeSumCreate(MPI_Comm comm, int n, const long long gid[], NodeSum *sum);
/* value[n][ncomp]: on entry each copy's contribution, on return the sum over all copies. */
PetscErrorCode NodeSumApply(NodeSum sum, int ncomp, double value[]);
PetscErrorCode NodeSumDestroy(NodeSum *sum);
#endif
