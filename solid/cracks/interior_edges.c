#include "solid/cracks/interior_edges.h"
#include "solid/bodies/element_edges.h"
#include <stdlib.h>

static PetscBool HasJoints(const Model *a)
{
  for (int e = 0; e < a->nelements; e++)
    if (a->jointed[e]) return PETSC_TRUE;
  return PETSC_FALSE;
}

PetscErrorCode InteriorEdgesFind(const Model *a, InteriorEdges *edges)
{
  ElementEdge *edge;
  PetscFunctionBeginUser;
  *edges = (InteriorEdges){0};
  if (!HasJoints(a)) PetscFunctionReturn(0);
  PetscCall(ElementEdgesSorted(0, a->nelements, a->element, &edge));
  PetscCall(PetscMalloc1(3 * (size_t)a->nelements / 2 + 1, &edges->edge));
  for (int k = 0; k + 1 < 3 * a->nelements; k++) {
    const ElementEdge *p = &edge[k], *q = &edge[k + 1];
    if (p->low != q->low || p->high != q->high) continue;
    const int *node = a->element + 3 * p->element,
              parts = a->jointed[p->element] >> p->side & a->jointed[q->element] >> q->side & 1;
    edges->edge[edges->n++] = (InteriorEdge){{node[p->side], node[(p->side + 1) % 3]},
                                             {p->element, q->element},
                                             {p->side, q->side},
                                             parts ? edges->njoints++ : -1};
  }
  PetscCall(PetscFree(edge));
  PetscFunctionReturn(0);
}

/* --- ghosts ------------------------------------------------------------------------------------------- */

static int ComparePairs(const void *a, const void *b)
{
  const int *p = a, *q = b;
  return p[0] != q[0] ? (p[0] > q[0]) - (p[0] < q[0]) : (p[1] > q[1]) - (p[1] < q[1]);
}

static int SortUnique(int n, int pair[][2])
{
  int kept = 0;
  if (n > 0) qsort(pair, (size_t)n, sizeof *pair, ComparePairs);
  for (int k = 0; k < n; k++) {
    if (k > 0 && !ComparePairs(pair[k], pair[k - 1])) continue;
    pair[kept][0] = pair[k][0];
    pair[kept++][1] = pair[k][1];
  }
  return kept;
}

/* first[nnodes + 1] into pair: nodes with joints, each with the ranks that have elements there. */
static PetscErrorCode RanksAtNodes(const InteriorEdges *edges, const Model *a, const int part[],
                                   int (**pair)[2], int first[])
{
  int n = 0;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(3 * (size_t)a->nelements, pair));
  for (int v = 0; v <= a->nnodes; v++) first[v] = 0;
  for (int k = 0; k < edges->n; k++)
    for (int i = 0; i < 2 && edges->edge[k].joint >= 0; i++) first[edges->edge[k].node[i]] = 1;
  for (int k = 0; k < 3 * a->nelements; k++) {
    if (!first[a->element[k]]) continue;
    (*pair)[n][0] = a->element[k];
    (*pair)[n++][1] = part[k / 3];
  }
  n = SortUnique(n, *pair);
  for (int v = 0, k = 0; v <= a->nnodes; v++) {
    first[v] = k;
    while (k < n && (*pair)[k][0] == v) k++;
  }
  PetscFunctionReturn(0);
}

PetscErrorCode InteriorEdgesGhosts(const InteriorEdges *edges, const Model *a, const int part[], int *n,
                                   GhostElement **ghost)
{
  int(*at)[2], (*pair)[2], *first;
  PetscFunctionBeginUser;
  *n = 0;
  *ghost = NULL;
  if (edges->njoints == 0) PetscFunctionReturn(0);
  PetscCall(PetscMalloc1((size_t)a->nnodes + 1, &first));
  PetscCall(RanksAtNodes(edges, a, part, &at, first));
  for (int k = 0; k < 3 * a->nelements; k++) *n += first[a->element[k] + 1] - first[a->element[k]];
  PetscCall(PetscMalloc1((size_t)*n, &pair));
  *n = 0;
  for (int k = 0; k < 3 * a->nelements; k++)
    for (int r = first[a->element[k]]; r < first[a->element[k] + 1]; r++) {
      if (at[r][1] == part[k / 3]) continue;
      pair[*n][0] = at[r][1];
      pair[(*n)++][1] = k / 3;
    }
  *n = SortUnique(*n, pair);
  PetscCall(PetscMalloc1((size_t)*n, ghost));
  for (int k = 0; k < *n; k++) (*ghost)[k] = (GhostElement){pair[k][0], pair[k][1]};
  PetscCall(PetscFree(first));
  PetscCall(PetscFree(at));
  PetscCall(PetscFree(pair));
  PetscFunctionReturn(0);
}

PetscErrorCode InteriorEdgesDestroy(InteriorEdges *edges)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(edges->edge));
  PetscFunctionReturn(0);
}
