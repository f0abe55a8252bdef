/* The metric of a distributed mesh: the same on all ranks that share a vertex. */
#ifndef CORACLE_METRIC_SHARE_H
#define CORACLE_METRIC_SHARE_H
#include "common/exchange/copies.h"
#include "fluid/adapt/metric.h"

/* The vertices of faces to other ranks, each once. */
typedef struct {
  int n, *vertex; /* [n] local */
  Copies copies;  /* of them on all ranks */
} SharedVertices;

/* Collective. */
PetscErrorCode SharedVerticesCreate(const Mesh *mesh, SharedVertices *shared);
PetscErrorCode SharedVerticesDestroy(SharedVertices *shared);
/* Collective: MetricGrade over the parts of all ranks; at shared vertices the ranks' metrics are intersected,
 * in the same order on all, so that they get the same bits. */
PetscErrorCode MetricGradeParallel(MPI_Comm comm, const MeshSerial *part, const SharedVertices *shared,
                                   double growth, double metric[]);
#endif
