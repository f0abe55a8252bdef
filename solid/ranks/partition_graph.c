#include "solid/bodies/element_edges.h"
#include "solid/contact/cell_grid.h"
#include "solid/ranks/partition.h"
#include <stdint.h>
#include <stdlib.h>

/* --- links -------------------------------------------------------------------------------------------- */

PetscErrorCode PartitionGraphLink(PartitionGraph *g, int a, int b, int weight)
{
  PetscFunctionBeginUser;
  if (g->nlinks == g->capacity) {
    g->capacity = 2 * g->capacity + 64;
    PetscCall(PetscRealloc((size_t)g->capacity * sizeof *g->link, &g->link));
  }
  g->link[g->nlinks++] = (PartitionLink){a, b, weight};
  PetscFunctionReturn(0);
}

PetscErrorCode PartitionGraphCreate(const Model *a, PartitionGraph *g)
{
  ElementEdge *edge;
  PetscFunctionBeginUser;
  *g = (PartitionGraph){.capacity = 4 * a->nelements};
  PetscCall(PetscMalloc1((size_t)g->capacity, &g->link));
  PetscCall(PetscMalloc3((size_t)a->nelements, &g->work, (size_t)a->nelements, &g->piece,
                         (size_t)a->nelements, &g->at));
  for (int e = 0; e < a->nelements; e++) {
    g->work[e] = WORK_ELEMENT;
    g->piece[e] = a->element_body[e];
  }
  PetscCall(ElementEdgesSorted(0, a->nelements, a->element, &edge));
  for (int k = 0; k + 1 < 3 * a->nelements; k++)
    if (edge[k].low == edge[k + 1].low && edge[k].high == edge[k + 1].high)
      PetscCall(PartitionGraphLink(g, edge[k].element, edge[k + 1].element, LINK_INTACT));
  PetscCall(PetscFree(edge));
  PetscFunctionReturn(0);
}

typedef struct {
  const Model *a;
  PartitionGraph *g;
} NearSearch;

static PetscErrorCode NearFound(void *context, int facet, int e)
{
  const NearSearch *s = context;
  const int own = s->a->facet_element[facet];
  PetscFunctionBeginUser;
  if (s->a->element_body[own] == s->a->element_body[e]) PetscFunctionReturn(0);
  s->g->work[own] += WORK_CANDIDATE;
  PetscCall(PartitionGraphLink(s->g, own, e, LINK_NEAR));
  PetscFunctionReturn(0);
}

static double FacetSpan(const Model *a, int k)
{
  const double *p = a->x + 2 * a->facet[2 * k], *q = a->x + 2 * a->facet[2 * k + 1];
  return hypot(q[0] - p[0], q[1] - p[1]);
}

/* As the first search for contact does, but with boxes alone. */
PetscErrorCode PartitionGraphNear(PartitionGraph *g, const Model *a)
{
  NearSearch search = {a, g};
  GeometryBox *facet, *element;
  double buffer = 0.0;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2((size_t)a->nfacets, &facet, (size_t)a->nelements, &element));
  for (int k = 0; k < a->nfacets; k++) buffer += 0.5 * FacetSpan(a, k) / a->nfacets;
  for (int k = 0; k < a->nfacets; k++)
    facet[k] = GeometryBoxWidened(GeometryBoxOfNodes(2, a->facet + 2 * k, a->x), buffer);
  for (int e = 0; e < a->nelements; e++) {
    element[e] = GeometryBoxOfNodes(3, a->element + 3 * e, a->x);
    g->at[e][0] = g->at[e][1] = 0.0;
    for (int k = 0; k < 6; k++) g->at[e][k % 2] += a->x[2 * a->element[3 * e + k / 2] + k % 2] / 3.0;
  }
  if (a->nbodies > 1) PetscCall(CellGridPairs(a->nfacets, facet, a->nelements, element, NearFound, &search));
  PetscCall(PetscFree2(facet, element));
  PetscFunctionReturn(0);
}

/* --- the curve ---------------------------------------------------------------------------------------- */

typedef struct {
  uint64_t key;
  int element;
} Stop;

/* Place along Hilbert's curve through 2^16 x 2^16 cells. */
static uint64_t HilbertKey(uint32_t x, uint32_t y)
{
  uint64_t key = 0;
  for (uint32_t s = 1u << 15; s > 0; s /= 2) {
    const uint32_t rx = (x & s) > 0, ry = (y & s) > 0;
    key += (uint64_t)s * s * ((3 * rx) ^ ry);
    if (ry) continue;
    if (rx) {
      x = 0xffff - x;
      y = 0xffff - y;
    }
    const uint32_t swap = x;
    x = y;
    y = swap;
  }
  return key;
}

static int CompareStops(const void *a, const void *b)
{
  const Stop *p = a, *q = b;
  return p->key != q->key ? (p->key > q->key) - (p->key < q->key) : p->element - q->element;
}

PetscErrorCode PartitionGraphCurve(PartitionGraph *g, int n)
{
  GeometryBox all = GeometryBoxEmpty();
  Stop *stop;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1((size_t)n, &stop));
  for (int e = 0; e < n; e++) GeometryBoxGrow(&all, g->at[e]);
  const double size = fmax(fmax(all.upper[0] - all.lower[0], all.upper[1] - all.lower[1]), 1e-300);
  for (int e = 0; e < n; e++)
    stop[e] = (Stop){HilbertKey((uint32_t)(65535.0 * ((g->at[e][0] - all.lower[0]) / size)),
                                (uint32_t)(65535.0 * ((g->at[e][1] - all.lower[1]) / size))),
                     e};
  qsort(stop, (size_t)n, sizeof *stop, CompareStops);
  for (int k = 0; k + 1 < n; k++)
    PetscCall(PartitionGraphLink(g, stop[k].element, stop[k + 1].element, LINK_CURVE));
  PetscCall(PetscFree(stop));
  PetscFunctionReturn(0);
}
