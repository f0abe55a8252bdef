/* Private to part_partition.c, part_clusters.c and their test. */
#ifndef CORACLE_PART_PARTITION_H
#define CORACLE_PART_PARTITION_H
#include "common/mesh/mesh_impl.h"
#include <metis.h>

/* The graph of triangles on one rank. */
typedef struct {
  int n;
  const long long *across; /* [n][3] 3 element + face beyond a face, -1 on the boundary */
  const int *weight;       /* [n][3] or NULL */
} PartGraph;

/* Not collective: target[n] below nparts, for equal parts and few edges between them. */
PetscErrorCode PartGraphCut(const PartGraph *graph, int nparts, int target[]);
/* The same of a graph as METIS wants it: the neighbours of vertex v are list[first[v]] to list[first[v + 1] - 1], over edges of weight[];
 * size[n] of the vertices; both may be NULL. */
PetscErrorCode PartCut(int n, idx_t first[], idx_t list[], idx_t size[], idx_t weight[], int nparts,
                       int target[]);

/* Collective: MeshPartPartition, of the graph of triangles gathered on rank 0 or by clusters (part_clusters.c). */
PetscErrorCode PartPartition(MPI_Comm comm, const MeshPart *part, int nparts, const int weight[],
                             PetscBool clusters, int target[]);
/* Collective: with about `wanted` clusters on all ranks. */
PetscErrorCode PartPartitionClusters(MPI_Comm comm, const PartFaces *faces, int ne, int nparts,
                                     const int weight[], int wanted, int target[]);
#endif
