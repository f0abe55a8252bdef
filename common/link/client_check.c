/* Checks of the mesh that a solid gives: what would run and give wrong physics without a word is refused. */
#include "common/link/client_impl.h"
#include <stdlib.h>
#include <string.h>

enum { NV = DIM + 1 };

/* --- on this rank --------------------------------------------------------------------------------------- */

static void CheckConnectivity(CoracleClient c, const char *what, int ne, int per, const int conn[])
{
  for (int e = 0; e < ne; e++)
    for (int i = 0; i < per; i++)
      if (conn[per * e + i] < 0 || conn[per * e + i] >= c->solid.mesh.n)
        ParticipantFail(c->p, "%s %d refers to node %d of this rank's %d in step %d", what, e,
                        conn[per * e + i], c->solid.mesh.n, c->p->step);
}

static void CheckIds(CoracleClient c)
{
  const SolidMesh *m = &c->solid.mesh;
  const long long **sorted = SolidMeshSortIds(m);
  for (int i = 1; i < m->n; i++)
    if (*sorted[i] == *sorted[i - 1])
      ParticipantFail(
          c->p, "CoracleSetNodes: two nodes of this rank have the id %lld in step %d: ids must be unique",
          *sorted[i], c->p->step);
  free(sorted);
}

/* x[n][dim]: the nodes' present positions. */
static void CheckMeasure(CoracleClient c, const double x[])
{
  const SolidMesh *m = &c->solid.mesh;
  for (int e = 0; e < m->nelements; e++) {
    const int *v = Ints(&m->element) + NV * e;
    const double *a = x + DIM * v[0], *b = x + DIM * v[1], *d = x + DIM * v[2];
    const double area = 0.5 * ((b[0] - a[0]) * (d[1] - a[1]) - (b[1] - a[1]) * (d[0] - a[0]));
    if (!(area > 0.0))
      ParticipantFail(
          c->p,
          "CoracleSetVolume: element %d (nodes %lld, %lld, %lld) has the area %g m2 in step %d: its nodes "
          "must be in counter-clockwise order",
          e, Ids(&m->gid)[v[0]], Ids(&m->gid)[v[1]], Ids(&m->gid)[v[2]], area, c->p->step);
  }
}

void CheckMesh(CoracleClient c, const double x[])
{
  const SolidMesh *m = &c->solid.mesh;
  CheckConnectivity(c, "facet", m->nfacets, DIM, Ints(&m->facet));
  CheckConnectivity(c, "element", m->nelements, NV, Ints(&m->element));
  CheckIds(c);
  CheckMeasure(c, x);
}

/* --- over all ranks: surface and volume fit ------------------------------------------------------------- */

/* A directed edge a -> b of an element or a facet, as the pair of its ids and a direction. */
typedef struct {
  long long lower, upper;
  int reversed; /* a is upper */
  int is_facet, rank, index;
} Edge;

static Edge MakeEdge(CoracleClient c, int a, int b, int is_facet, int index)
{
  const long long *gid = Ids(&c->solid.mesh.gid), from = gid[a], to = gid[b];
  Edge e;
  memset(&e, 0, sizeof e);
  e.lower = from < to ? from : to;
  e.upper = from < to ? to : from;
  e.reversed = from > to;
  e.is_facet = is_facet;
  e.rank = c->p->rank;
  e.index = index;
  return e;
}

static int ListEdges(CoracleClient c, Edge edge[])
{
  const SolidMesh *m = &c->solid.mesh;
  int n = 0;
  for (int e = 0; e < m->nelements; e++)
    for (int i = 0; i < NV; i++)
      edge[n++] = MakeEdge(c, Ints(&m->element)[NV * e + i], Ints(&m->element)[NV * e + (i + 1) % NV], 0, e);
  for (int e = 0; e < m->nfacets; e++)
    edge[n++] = MakeEdge(c, Ints(&m->facet)[DIM * e], Ints(&m->facet)[DIM * e + 1], 1, e);
  return n;
}

static int CompareEdges(const void *a, const void *b)
{
  const Edge *x = a, *y = b;
  if (x->lower != y->lower) return x->lower < y->lower ? -1 : 1;
  if (x->upper != y->upper) return x->upper < y->upper ? -1 : 1;
  if (x->is_facet != y->is_facet) return x->is_facet - y->is_facet;
  return x->reversed - y->reversed;
}

static int EdgeRank(CoracleClient c, const Edge *e)
{
  const unsigned long long hash =
      (unsigned long long)e->lower * 0x9E3779B97F4A7C15ULL ^ (unsigned long long)e->upper;
  return (int)((hash >> 17) % (unsigned long long)c->p->size);
}

/* Every edge to the rank that its ids give; returns their number, *all is allocated. */
static int GatherEdges(CoracleClient c, int n, const Edge edge[], Edge **all)
{
  const int size = c->p->size, unit = (int)sizeof *edge;
  int *count = calloc(4 * ((size_t)size + 1), sizeof *count), *first = count + size + 1,
      *from = first + size + 1, *start = from + size + 1;
  Edge *sorted = malloc((size_t)n * sizeof *sorted + 1);
  for (int k = 0; k < n; k++) count[EdgeRank(c, &edge[k])] += unit;
  for (int r = 0; r < size; r++) first[r + 1] = first[r] + count[r];
  memset(count, 0, (size_t)size * sizeof *count);
  for (int k = 0; k < n; k++) {
    const int r = EdgeRank(c, &edge[k]);
    sorted[(first[r] + count[r]) / unit] = edge[k];
    count[r] += unit;
  }
  MPI_Alltoall(count, 1, MPI_INT, from, 1, MPI_INT, c->p->app);
  for (int r = 0; r < size; r++) start[r + 1] = start[r] + from[r];
  const int arrived = start[size] / unit;
  *all = malloc((size_t)start[size] + 1);
  MPI_Alltoallv(sorted, count, first, MPI_BYTE, *all, from, start, MPI_BYTE, c->p->app);
  free(sorted);
  free(count);
  return arrived;
}

/* The n entries of one edge: at most one element on each side, and a facet where there is one side only. */
static void CheckEdge(CoracleClient c, int n, const Edge e[])
{
  const Edge *element[2] = {NULL, NULL}, *facet[2] = {NULL, NULL};
  for (int k = 0; k < n; k++) {
    const Edge **slot = e[k].is_facet ? &facet[e[k].reversed] : &element[e[k].reversed];
    if (*slot)
      ParticipantFail(
          c->p,
          "%s %d of rank %d and %s %d of rank %d have the edge between nodes %lld and %lld on the same "
          "side: each must be given once",
          e[k].is_facet ? "facet" : "element", (*slot)->index, (*slot)->rank,
          e[k].is_facet ? "facet" : "element", e[k].index, e[k].rank, e[k].lower, e[k].upper);
    *slot = &e[k];
  }
  for (int side = 0; side < 2; side++)
    if (facet[side] && (!element[side] || element[!side]))
      ParticipantFail(
          c->p,
          "facet %d of rank %d (nodes %lld and %lld) is not on the volume's boundary with the solid on "
          "its left",
          facet[side]->index, facet[side]->rank, e->lower, e->upper);
  for (int side = 0; side < 2; side++)
    if (element[side] && !element[!side] && !facet[side])
      ParticipantFail(
          c->p,
          "the edge between nodes %lld and %lld of element %d of rank %d is on the volume's boundary but "
          "no facet of the surface",
          e->lower, e->upper, element[side]->index, element[side]->rank);
}

void CheckSurface(CoracleClient c)
{
  const SolidMesh *m = &c->solid.mesh;
  int elements = m->nelements, n;
  Edge *edge, *all;
  MPI_Allreduce(MPI_IN_PLACE, &elements, 1, MPI_INT, MPI_MAX, c->p->app);
  if (!elements) return; /* a solid of facets alone */
  edge = malloc(((size_t)m->nelements * NV + (size_t)m->nfacets) * sizeof *edge + 1);
  n = GatherEdges(c, ListEdges(c, edge), edge, &all);
  free(edge);
  qsort(all, (size_t)n, sizeof *all, CompareEdges);
  for (int k = 0, last; k < n; k = last) {
    for (last = k + 1; last < n; last++)
      if (all[last].lower != all[k].lower || all[last].upper != all[k].upper) break;
    CheckEdge(c, last - k, all + k);
  }
  free(all);
}
