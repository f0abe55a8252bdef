/* Anisotropic mesh adaptation: changes a mesh by splits, collapses, swaps and moves until its edges are about
 * 1 long in a metric (metric.h), in [1/sqrt 2, sqrt 2].
 *
 *     split a long edge      collapse a short one      swap for quality        move
 *         p                       .---.                   p                    .---.
 *        /|\                     / \ / \                 / \      p           /|\  |
 *       a-+-b                   .---v-u-.  ->  v is u    a---b -> a | b       . v-.  in its star
 *        \|/                     \ / \ /                 \ /      q           \|/ /
 *         q                       .---.                   q                    .-.
 *
 * No triangle is ever inverted or flat (height/longest edge at least 1e-10).  The boundary and the lines
 * between regions stay as they are: vertices come, go and slide along straight lines only; corners, ends of
 * tags, junctions and every bend stay.  A bent boundary keeps all of its vertices: it can be refined, not
 * coarsened. The metric is a function on the domain, fixed by the input: log-Euclidean means of the corners
 * of the input's triangles.  Not collective, deterministic. */
#ifndef CORACLE_ADAPT_H
#define CORACLE_ADAPT_H
#include "common/mesh/mesh.h"

typedef struct {
  const char *frozen;     /* [nv] or NULL, borrowed: nonzero vertices neither move nor go */
  const char *frozen_tag; /* [ntags] or NULL, borrowed: facets of these tags stay as they are, inside too */
  const char *inactive; /* [nv] or NULL, borrowed: nonzero vertices are not looked at unless something changes
                             there: they are well placed already; saves time */
} AdaptOptions;

typedef struct {
  int rounds, splits, collapses, swaps, moves;
  int edges, edges_unit; /* in the new mesh: all, and those with a length in [1/sqrt 2, sqrt 2] */
  double shortest, longest;
  double quality_worst, quality_mean; /* 4 sqrt 3 A sqrt(det M) / sum e^T M e: 1 is equilateral in M */
} AdaptReport;

typedef struct {
  MeshSerial
      mesh; /* same names; facets are oriented as faces of their triangles; frozen lines inside are facets */
  double *metric; /* [nv][3] */
  int *origin;    /* [nv] the vertex of the input in the same place, -1 for one that is new or has moved */
  AdaptReport report;
} AdaptResult;

/* metric[mesh->nv][3] as in metric.h.  options may be NULL.  The input is not changed.  Errors:
 * PETSC_ERR_ARG_WRONG for a mesh that does not conform, a triangle that is clockwise or flat;
 * PETSC_ERR_ARG_OUTOFRANGE for a metric that is not positive definite. */
PetscErrorCode MeshAdapt(const MeshSerial *mesh, const double metric[], const AdaptOptions *options,
                         AdaptResult *result);
PetscErrorCode AdaptResultDestroy(AdaptResult *result);

/* How well a mesh fits a metric: the second half of a report; operations are zero. */
PetscErrorCode AdaptMeasure(const MeshSerial *mesh, const double metric[], AdaptReport *report);
#endif
