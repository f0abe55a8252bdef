#include "solid/ranks/partition.h"
#include "common/mesh/kept_signals.h"
#include <metis.h>
#include <stdlib.h>

/* --- METIS -------------------------------------------------------------------------------------------- */

/* Adds a link to vertex a's row, which is start[a] .. fill[a] - 1 so far. */
static void AddToRow(int a, int b, int weight, const idx_t start[], idx_t fill[], idx_t to[], idx_t w[])
{
  idx_t k = start[a];
  while (k < fill[a] && to[k] != b) k++;
  if (k == fill[a]) {
    to[fill[a]++] = b;
    w[k] = 0;
  }
  w[k] += weight;
}

/* Rows of the graph, equal links merged; to and w have room for 2 nlinks. */
static PetscErrorCode Rows(const PartitionGraph *g, int n, idx_t start[], idx_t to[], idx_t w[])
{
  idx_t *fill, kept = 0;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1((size_t)n + 1, &fill));
  for (int e = 0; e <= n; e++) start[e] = 0;
  for (int k = 0; k < g->nlinks; k++) {
    start[g->link[k].a + 1]++;
    start[g->link[k].b + 1]++;
  }
  for (int e = 0; e < n; e++) start[e + 1] += start[e];
  for (int e = 0; e < n; e++) fill[e] = start[e];
  for (int k = 0; k < g->nlinks; k++) {
    const PartitionLink *l = &g->link[k];
    AddToRow(l->a, l->b, l->weight, start, fill, to, w);
    AddToRow(l->b, l->a, l->weight, start, fill, to, w);
  }
  for (int e = 0; e < n; e++) {
    const idx_t first = start[e];
    start[e] = kept;
    for (idx_t k = first; k < fill[e]; k++, kept++) {
      to[kept] = to[k];
      w[kept] = w[k];
    }
  }
  start[n] = kept;
  PetscCall(PetscFree(fill));
  PetscFunctionReturn(0);
}

static PetscErrorCode Metis(const PartitionGraph *g, int n, int parts, int part[])
{
  idx_t nv = n, constraints = 1, nparts = parts, cut, *start, *to, *w, *work, *of;
  const size_t room = 2 * (size_t)g->nlinks;
  KeptSignals signals;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc5((size_t)n + 1, &start, room, &to, room, &w, (size_t)n, &work, (size_t)n, &of));
  PetscCall(Rows(g, n, start, to, w));
  for (int e = 0; e < n; e++) work[e] = g->work[e];
  SignalsKeep(&signals);
  const int code = parts > 8 ? METIS_PartGraphKway(&nv, &constraints, start, to, work, NULL, w, &nparts, NULL,
                                                   NULL, NULL, &cut, of)
                             : METIS_PartGraphRecursive(&nv, &constraints, start, to, work, NULL, w, &nparts,
                                                        NULL, NULL, NULL, &cut, of);
  SignalsRestore(&signals);
  PetscCheck(code == METIS_OK, PETSC_COMM_SELF, PETSC_ERR_LIB, "METIS failed with %d", code);
  for (int e = 0; e < n; e++) part[e] = (int)of[e];
  PetscCall(PetscFree5(start, to, w, work, of));
  PetscFunctionReturn(0);
}

/* --- whole pieces ------------------------------------------------------------------------------------- */

/* vertex[nelements] of the graph in which pieces of at most that work are one vertex, and so are the parts of a six-node
 * triangle. */
static PetscErrorCode NumberVertices(const PartitionGraph *g, const Model *a, double most, int vertex[],
                                     int *n)
{
  double *work;
  int *first; /* [pieces] its vertex */
  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1((size_t)a->nelements, &work));
  PetscCall(PetscMalloc1((size_t)a->nelements, &first));
  for (int e = 0; e < a->nelements; e++) {
    work[g->piece[e]] += g->work[e];
    first[e] = -1;
  }
  *n = 0;
  for (int e = 0; e < a->nelements; e++) {
    const int piece = g->piece[e], leader = a->six_node[e] ? e - (a->six_node[e] - SIX_NODE_A) : e;
    if (work[piece] <= most) {
      if (first[piece] < 0) first[piece] = (*n)++;
      vertex[e] = first[piece];
    } else {
      vertex[e] = leader < e ? vertex[leader] : (*n)++;
    }
  }
  PetscCall(PetscFree(work));
  PetscCall(PetscFree(first));
  PetscFunctionReturn(0);
}

/* The graph of the vertices; its pieces and places are not set. */
static PetscErrorCode Contract(const PartitionGraph *g, int nelements, const int vertex[], int n,
                               PartitionGraph *c)
{
  PetscFunctionBeginUser;
  *c = (PartitionGraph){0};
  PetscCall(PetscCalloc1((size_t)n, &c->work));
  for (int e = 0; e < nelements; e++) c->work[vertex[e]] += g->work[e];
  for (int k = 0; k < g->nlinks; k++) {
    const PartitionLink *l = &g->link[k];
    if (vertex[l->a] != vertex[l->b]) PetscCall(PartitionGraphLink(c, vertex[l->a], vertex[l->b], l->weight));
  }
  PetscFunctionReturn(0);
}

/* *excess: of the largest part's work over the mean. */
static PetscErrorCode CutVertices(const PartitionGraph *g, const Model *a, double most, int parts, int part[],
                                  double *excess)
{
  PartitionGraph c;
  double *load, all = 0.0;
  int *vertex, *of, n = 0;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2((size_t)a->nelements, &vertex, (size_t)a->nelements, &of));
  PetscCall(NumberVertices(g, a, most, vertex, &n));
  for (int v = 0; v < n; v++) of[v] = 0;
  PetscCall(Contract(g, a->nelements, vertex, n, &c));
  if (PetscMin(parts, n) > 1) PetscCall(Metis(&c, n, PetscMin(parts, n), of));
  PetscCall(PetscCalloc1((size_t)parts, &load));
  for (int e = 0; e < a->nelements; e++) {
    part[e] = of[vertex[e]];
    load[part[e]] += g->work[e];
    all += g->work[e];
  }
  *excess = 0.0;
  for (int p = 0; p < parts; p++) *excess = fmax(*excess, load[p] * parts / all - 1.0);
  PetscCall(PetscFree(load));
  PetscCall(PetscFree(c.link));
  PetscCall(PetscFree(c.work));
  PetscCall(PetscFree2(vertex, of));
  PetscFunctionReturn(0);
}

PetscErrorCode PartitionGraphCut(PartitionGraph *g, const Model *a, int parts, int part[])
{
  double all = 0.0, excess;
  PetscFunctionBeginUser;
  for (int e = 0; e < a->nelements; e++) all += g->work[e];
  if (parts > 1) PetscCall(PartitionGraphCurve(g, a->nelements));
  PetscCall(CutVertices(g, a, (1.0 + WHOLE_EXCESS) * all / parts, parts, part, &excess));
  if (excess > WHOLE_EXCESS) PetscCall(CutVertices(g, a, 0.0, parts, part, &excess));
  PetscCall(PetscFree(g->link));
  PetscCall(PetscFree3(g->work, g->piece, g->at));
  PetscFunctionReturn(0);
}

/* --- names of the parts ------------------------------------------------------------------------------- */

typedef struct {
  int common, before, now;
} Overlap;

static int CompareOverlaps(const void *a, const void *b)
{
  const Overlap *p = a, *q = b;
  if (p->common != q->common) return p->common < q->common ? 1 : -1;
  return p->before != q->before ? p->before - q->before : p->now - q->now;
}

/* The largest common parts first. */
PetscErrorCode PartitionKeep(int nelements, int parts, const int before[], int part[])
{
  Overlap *o;
  int *name, *taken;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc3((size_t)parts * (size_t)parts, &o, (size_t)parts, &name, (size_t)parts, &taken));
  for (int k = 0; k < parts * parts; k++) o[k] = (Overlap){0, k / parts, k % parts};
  for (int e = 0; e < nelements; e++) o[before[e] * parts + part[e]].common++;
  qsort(o, (size_t)parts * (size_t)parts, sizeof *o, CompareOverlaps);
  for (int p = 0; p < parts; p++) name[p] = taken[p] = -1;
  for (int k = 0; k < parts * parts; k++)
    if (name[o[k].now] < 0 && taken[o[k].before] < 0) {
      name[o[k].now] = o[k].before;
      taken[o[k].before] = o[k].now;
    }
  for (int e = 0; e < nelements; e++) part[e] = name[part[e]];
  PetscCall(PetscFree3(o, name, taken));
  PetscFunctionReturn(0);
}
