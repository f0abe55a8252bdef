/* Adaptation of a distributed mesh; no rank ever has all of it.
 *
 *   |  rank 0  |  rank 1  |       Each rank adapts its triangles; faces to other ranks stay as they are. Then
 *   |..........#..........|       METIS cuts again, but not near the old cuts (heavy faces), the triangles
 * move, |     #....:....#     |       and what was frozen is adapted: it lies within a part now.  Twice is
 * usual,
 *   |..........#..........|       more often only if an edge near a cut is still far from unit. */
#ifndef CORACLE_ADAPT_PARALLEL_H
#define CORACLE_ADAPT_PARALLEL_H
#include "adapt.h"

/* Collective.  metric[mesh->nv][3] as in metric.h, on the vertices of owned elements, the same on all ranks
 * that have a vertex.  options may be NULL; its `frozen`, `frozen_tag` and `idle` must be.  *adapted has
 * parts of equal size, at most 3 % larger than the mean where that is possible; its elements are those of
 * MeshAdapt on one rank, and nearly as many on several.  *report, NULL or the same on all ranks, is of the
 * whole mesh: operations of all ranks, the most rounds that one of them made.  The same input on as many
 * ranks gives the same bits.  Errors are those of MeshAdapt, returned on all ranks. */
PetscErrorCode MeshAdaptParallel(const Mesh *mesh, const double metric[], const AdaptOptions *options,
                                 Mesh **adapted, AdaptReport *report);
#endif
