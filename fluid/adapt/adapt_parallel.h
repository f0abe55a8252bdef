/* Adaptation of a distributed mesh; no rank ever has all of it.
 *
 *   |  rank 0  |  rank 1  |     Each rank adapts its triangles; faces to other ranks stay as they are.
 *   |          #          |     Then METIS cuts again, but not near the last cuts (heavy faces), triangles
 *   |     #    :    #     |     move, and what was frozen (:) is adapted: it lies within a part now.
 *   |          #          |
 *
 * Another pass is made only if what is near the last cut does not fit yet: one is enough for most small
 * changes, a refinement takes two to five. */
#ifndef CORACLE_ADAPT_PARALLEL_H
#define CORACLE_ADAPT_PARALLEL_H
#include "fluid/adapt/adapt.h"

/* Collective.  metric[mesh->nv][3] as in metric.h, on the vertices of owned elements (those of ghosts alone
 * are not read), the same on all ranks that have a vertex.  Parts of *adapted have at most 3 % more
 * triangles than the mean, as far as METIS can.  On one rank it is the mesh of MeshAdapt, on several
 * another one that fits as well.  *report, or NULL, is of the whole mesh and the same everywhere: sums of
 * operations, and for each pass the most rounds that a rank made.  The same input on as many ranks gives
 * the same bits.  Errors are those of MeshAdapt, returned on all ranks. */
PetscErrorCode MeshAdaptParallel(const Mesh *mesh, const double metric[], Mesh **adapted,
                                 AdaptReport *report);
#endif
