/* The edges between two elements of a model, and which of them are joints: those between two elements
 * that may part.  Not collective, the same on all ranks. */
#ifndef SOLID_INTERIOR_EDGES_H
#define SOLID_INTERIOR_EDGES_H
#include "solid/bodies/model.h"

typedef struct {
  int node[2];             /* as element[0] has them, counter-clockwise */
  int element[2], side[2]; /* element[0] < element[1]; from corner side to corner side + 1 */
  int joint;               /* its number, or -1: never parts */
} InteriorEdge;

typedef struct {
  int n, njoints; /* n = 0 when there are no joints */
  InteriorEdge *edge;
} InteriorEdges;

/* Rank `rank` needs another rank's element as a ghost: it has one that shares a node with joints with it. */
typedef struct {
  int rank, element;
} GhostElement;

PetscErrorCode InteriorEdgesFind(const Model *a, InteriorEdges *edges);
/* *ghost is allocated, [*n], sorted by rank and element. */
PetscErrorCode InteriorEdgesGhosts(const InteriorEdges *edges, const Model *a, const int part[], int *n,
                                   GhostElement **ghost);
PetscErrorCode InteriorEdgesDestroy(InteriorEdges *edges);
#endif
