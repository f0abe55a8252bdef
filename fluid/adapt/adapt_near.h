/* Private to the adapt room: how good a mesh is near what was frozen, and where not to cut it next. */
#ifndef CORACLE_ADAPT_NEAR_H
#define CORACLE_ADAPT_NEAR_H
#include "common/mesh/part.h"
#include "fluid/adapt/adapt_impl.h"

/* Distances are counted in edges from the nearest frozen vertex; from NEAR_INACTIVE on, vertices look right. */
enum { NEAR_INACTIVE = 4, NEAR_FAR = 9 };

/* The distance[nv] of the new vertices, at most NEAR_FAR; frozen[] is of the vertices of MeshAdapt's input.
 */
void NearDistances(const AdaptResult *result, const char frozen[], int distance[]);

/* Weights of faces for MeshPartPartition: large near what was frozen, very large where that does not fit the
 * metric. */
PetscErrorCode NearWeights(const AdaptResult *result, const int distance[], int weight[]);

typedef struct {
  int triangles;
  int cut, cut_unit;                       /* edges on cuts: all, and those of unit length */
  int edges, unit;                         /* edges that end at frozen vertices, those within twice */
  double shortest, longest, quality_worst; /* of these edges and of the triangles at frozen vertices */
} Near;

/* Facets of tag `cut` lie between ranks. */
void NearMeasure(const AdaptResult *result, const int distance[], int cut, Near *near);

/* Collective: adds the reports of all ranks to that of the passes before; *fits if what was frozen is as good
 * as MeshAdapt would make it. */
PetscErrorCode NearReduce(MPI_Comm comm, const Near *near, const AdaptReport *own, AdaptReport *all,
                          bool *fits);
#endif
