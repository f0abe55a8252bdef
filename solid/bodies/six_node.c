#include "solid/bodies/six_node.h"
#include "solid/bodies/element_edges.h"
#include <stdlib.h>

/* Sides of the triangles, each once, and their numbers. */
typedef struct {
  int n;
  int *of;  /* [ne][3] side from corner i to the next */
  int *end; /* [n][2], the lower vertex first, in order */
} Sides;

static PetscErrorCode NumberSides(const MeshSerial *m, Sides *sides)
{
  ElementEdge *edge;
  PetscFunctionBeginUser;
  sides->n = 0;
  PetscCall(PetscMalloc2(3 * (size_t)m->ne, &sides->of, 6 * (size_t)m->ne, &sides->end));
  PetscCall(ElementEdgesSorted(0, m->ne, m->vertex, &edge));
  for (int k = 0; k < 3 * m->ne; k++) {
    if (k == 0 || edge[k].low != edge[k - 1].low || edge[k].high != edge[k - 1].high) {
      sides->end[2 * sides->n] = edge[k].low;
      sides->end[2 * sides->n++ + 1] = edge[k].high;
    }
    sides->of[3 * edge[k].element + edge[k].side] = sides->n - 1;
  }
  PetscCall(PetscFree(edge));
  PetscFunctionReturn(0);
}

static int CompareEnds(const void *a, const void *b)
{
  const int *p = a, *q = b;
  return p[0] != q[0] ? (p[0] > q[0]) - (p[0] < q[0]) : (p[1] > q[1]) - (p[1] < q[1]);
}

static PetscErrorCode SplitElements(MeshSerial *m, const Sides *sides)
{
  int *vertex, *region = NULL, *curve = NULL;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(12 * (size_t)m->ne, &vertex));
  if (m->region) PetscCall(PetscMalloc1(4 * (size_t)m->ne, &region));
  if (m->curve) PetscCall(PetscMalloc1(12 * (size_t)m->ne, &curve));
  for (int e = 0; e < m->ne; e++) {
    int middle[3];
    for (int i = 0; i < 3; i++) middle[i] = m->nv + sides->of[3 * e + i];
    for (int i = 0; i < 3; i++) {
      int *corner = vertex + 12 * e + 3 * i;
      corner[0] = m->vertex[3 * e + i];
      corner[1] = middle[i];
      corner[2] = middle[(i + 2) % 3];
      vertex[12 * e + 9 + i] = middle[i];
    }
    for (int i = 0; i < 4 && region; i++) region[4 * e + i] = m->region[e];
    for (int i = 0; i < 12 && curve; i++) curve[12 * e + i] = -1;
    for (int i = 0; i < 3 && curve; i++) { /* the halves of side i */
      curve[12 * e + 3 * i] = m->curve[3 * e + i];
      curve[12 * e + 3 * ((i + 1) % 3) + 2] = m->curve[3 * e + i];
    }
  }
  PetscCall(PetscFree(m->vertex));
  PetscCall(PetscFree(m->region));
  PetscCall(PetscFree(m->curve));
  m->vertex = vertex;
  m->region = region;
  m->curve = curve;
  PetscFunctionReturn(0);
}

static PetscErrorCode SplitFacets(MeshSerial *m, const Sides *sides)
{
  int *facet, *tag;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(4 * (size_t)m->nb, &facet));
  PetscCall(PetscMalloc1(2 * (size_t)m->nb, &tag));
  for (int b = 0; b < m->nb; b++) {
    const int *end = m->facet + 2 * b, key[2] = {PetscMin(end[0], end[1]), PetscMax(end[0], end[1])};
    const int *side = bsearch(key, sides->end, (size_t)sides->n, 2 * sizeof *key, CompareEnds);
    const int middle = m->nv + (int)(side - sides->end) / 2, part[4] = {end[0], middle, middle, end[1]};
    PetscCall(PetscArraycpy(facet + 4 * b, part, 4));
    tag[2 * b] = tag[2 * b + 1] = m->facet_tag[b];
  }
  PetscCall(PetscFree(m->facet));
  PetscCall(PetscFree(m->facet_tag));
  m->facet = facet;
  m->facet_tag = tag;
  PetscFunctionReturn(0);
}

/* Appends the nodes on the sides. */
static PetscErrorCode AddMiddles(int nv, const Sides *sides, double **x)
{
  PetscFunctionBeginUser;
  PetscCall(PetscRealloc(2 * ((size_t)nv + (size_t)sides->n) * sizeof **x, x));
  for (int k = 0; k < 2 * sides->n; k++) {
    const int *end = sides->end + k / 2 * 2;
    (*x)[2 * nv + k] = 0.5 * ((*x)[2 * end[0] + k % 2] + (*x)[2 * end[1] + k % 2]);
  }
  PetscFunctionReturn(0);
}

PetscErrorCode SixNodeSplit(MeshSerial *m, double **position)
{
  Sides sides;
  PetscFunctionBeginUser;
  PetscCall(NumberSides(m, &sides));
  PetscCall(AddMiddles(m->nv, &sides, &m->x));
  if (*position) PetscCall(AddMiddles(m->nv, &sides, position));
  PetscCall(SplitFacets(m, &sides));
  PetscCall(SplitElements(m, &sides));
  m->nv += sides.n;
  m->ne *= 4;
  m->nb *= 2;
  m->order = 2;
  PetscCall(PetscFree2(sides.of, sides.end));
  PetscFunctionReturn(0);
}
