#include "solid/bodies/element_edges.h"
#include <stdlib.h>

static int CompareEnds(const void *a, const void *b)
{
  const ElementEdge *p = a, *q = b;
  if (p->low != q->low) return p->low < q->low ? -1 : 1;
  return (p->high > q->high) - (p->high < q->high);
}

static int CompareEdges(const void *a, const void *b)
{
  const ElementEdge *p = a, *q = b;
  const int ends = CompareEnds(a, b);
  return ends ? ends : (p->element > q->element) - (p->element < q->element);
}

PetscErrorCode ElementEdgesSorted(int first, int nelements, const int element[], ElementEdge **edge)
{
  const int n = 3 * (nelements - first);
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1((size_t)n, edge));
  for (int k = 0; k < n; k++) {
    const int e = first + k / 3, i = k % 3, p = element[3 * e + i], q = element[3 * e + (i + 1) % 3];
    (*edge)[k] = (ElementEdge){PetscMin(p, q), PetscMax(p, q), e, i};
  }
  if (n > 0) qsort(*edge, (size_t)n, sizeof **edge, CompareEdges);
  PetscFunctionReturn(0);
}

const ElementEdge *ElementEdgesFind(int n, const ElementEdge edge[], int p, int q)
{
  const ElementEdge key = {.low = PetscMin(p, q), .high = PetscMax(p, q)};
  return n > 0 ? bsearch(&key, edge, (size_t)n, sizeof *edge, CompareEnds) : NULL;
}
