/* The edges of triangles, sorted so that those between the same two nodes lie side by side. */
#ifndef SOLID_ELEMENT_EDGES_H
#define SOLID_ELEMENT_EDGES_H
#include <petscsys.h>

typedef struct {
  int low, high, element, side; /* nodes; side i of the element, from its corner i to the next */
} ElementEdge;

/* The 3 (nelements - first) edges of elements first .. nelements - 1; element[nelements][3] nodes.  *edge is
 * PetscFree'd by the caller.  Not collective. */
PetscErrorCode ElementEdgesSorted(int first, int nelements, const int element[], ElementEdge **edge);
/* One of the edges between nodes p and q among n sorted ones, NULL: there is none.  Not collective. */
const ElementEdge *ElementEdgesFind(int n, const ElementEdge edge[], int p, int q);
#endif
