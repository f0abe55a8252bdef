/* Sums over the copies of a node.  A node is known by its global id; several ranks, or several clients of one
 * rank, may each hold a copy.  Collective. */
#ifndef CORACLE_NODE_SUM_H
#define CORACLE_NODE_SUM_H
#include <petscsys.h>

typedef struct NodeSum_s *NodeSum;

PetscErrorCode NodeSumCreate(MPI_Comm comm, int n, const long long gid[], NodeSum *sum);
/* value[n][ncomp]: every copy's contribution in, the sum over all copies out. */
PetscErrorCode NodeSumApply(NodeSum sum, int ncomp, double value[]);
PetscErrorCode NodeSumDestroy(NodeSum *sum);
#endif
