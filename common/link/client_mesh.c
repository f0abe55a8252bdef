/* The solid's mesh as its client gives it, and again within a step that changes it. */
#include "common/link/client_impl.h"
#include <stdlib.h>

static void SolidMeshCopy(SolidMesh *to, const SolidMesh *from)
{
  to->n = from->n;
  to->nfacets = from->nfacets;
  to->nelements = from->nelements;
  BufferCopy(&to->gid, from->gid.data, from->gid.size);
  BufferCopy(&to->x, from->x.data, from->x.size);
  BufferCopy(&to->u, from->u.data, from->u.size);
  BufferCopy(&to->start, from->start.data, from->start.size);
  BufferCopy(&to->sums, from->sums.data, from->sums.size);
  BufferCopy(&to->facet, from->facet.data, from->facet.size);
  BufferCopy(&to->element, from->element.data, from->element.size);
}

void SolidMeshFree(SolidMesh *m)
{
  Buffer *all[] = {&m->gid, &m->x, &m->u, &m->start, &m->sums, &m->facet, &m->element};
  for (int k = 0; k < 7; k++) BufferFree(all[k]);
}

/* Before the mesh changes: within a step the old one is kept, for the step may be redone. */
static void BeforeChange(CoracleClient c, const char *function)
{
  ClientSolid *s = &c->solid;
  ClientExpect(c, function, ROLE_SOLID, STAGE_SETUP, STAGE_STEP);
  if (c->stage == STAGE_STEP && s->pressure_load)
    ClientMisuse(c, function, "the mesh of a solid with CoracleSetPressureLoad does not change");
  if (c->stage == STAGE_STEP && !s->has_before) {
    SolidMeshCopy(&s->before, &s->mesh);
    s->has_before = true;
  }
  s->changed = true;
}

static int CompareIds(const void *a, const void *b)
{
  const long long x = **(const long long *const *)a, y = **(const long long *const *)b;
  return (x > y) - (x < y);
}

const long long **SolidMeshSortIds(const SolidMesh *m)
{
  const long long **sorted = malloc(((size_t)m->n + 1) * sizeof *sorted);
  for (int i = 0; i < m->n; i++) sorted[i] = &Ids(&m->gid)[i];
  qsort(sorted, (size_t)m->n, sizeof *sorted, CompareIds);
  return sorted;
}

/* Sums and start positions on new nodes: a node whose id was there before keeps its own, a new one has moved
 * with u to x so far. */
static void CarrySums(const ClientSolid *s, int n, const long long gid[], const double x[], const double u[],
                      double sums[], double start[])
{
  const SolidMesh *m = &s->mesh;
  const long long **sorted = SolidMeshSortIds(m);
  for (int i = 0; i < n; i++) {
    const long long *id = &gid[i];
    const long long **found = bsearch(&id, sorted, (size_t)m->n, sizeof *sorted, CompareIds);
    const ptrdiff_t k = found ? *found - Ids(&m->gid) : -1;
    for (int d = 0; d < DIM; d++) {
      const int at = DIM * i + d;
      sums[2 * DIM * i + d] = k < 0 ? s->elapsed * u[at] : Doubles(&m->sums)[2 * DIM * k + d];
      sums[2 * DIM * i + DIM + d] = k < 0 ? s->first * u[at] : Doubles(&m->sums)[2 * DIM * k + DIM + d];
      start[at] = k < 0 ? x[at] - s->elapsed * u[at] : Doubles(&m->start)[DIM * k + d];
    }
  }
  free(sorted);
}

int CoracleSetNodes(CoracleClient c, int dim, int n, const long long gid[], const double x[],
                    const double u[])
{
  SolidMesh *m = &c->solid.mesh;
  const size_t bytes = DIM * (size_t)n * sizeof(double);
  Buffer sums = {0}, start = {0};
  BeforeChange(c, "CoracleSetNodes");
  if (dim != DIM) ParticipantFail(c->p, "CoracleSetNodes: dim is %d, only %d is there yet", dim, DIM);
  if (n < 0) ClientMisuse(c, "CoracleSetNodes", "n is negative");
  ClientGiven(c, "CoracleSetNodes", "gid", gid, n);
  ClientGiven(c, "CoracleSetNodes", "x", x, n);
  ClientGiven(c, "CoracleSetNodes", "u", u, n);
  MessageCheckFinite(c->p, "position", "node", NULL, (size_t)n, DIM, x);
  MessageCheckFinite(c->p, "velocity", "node", NULL, (size_t)n, DIM, u);
  BufferResize(&sums, 2 * bytes);
  BufferResize(&start, bytes);
  CarrySums(&c->solid, n, gid, x, u, Doubles(&sums), Doubles(&start));
  BufferFree(&m->sums);
  BufferFree(&m->start);
  m->sums = sums;
  m->start = start;
  m->n = n;
  BufferCopy(&m->gid, gid, (size_t)n * sizeof *gid);
  BufferCopy(&m->x, x, bytes);
  BufferCopy(&m->u, u, bytes);
  c->solid.has_nodes = true;
  return 0;
}

/* conn[ne][nodes] of the elements that `name` sets. */
static void SetElements(CoracleClient c, const char *name, int ne, int nodes, const int conn[], int *n,
                        Buffer *elements)
{
  BeforeChange(c, name);
  if (ne < 0) ClientMisuse(c, name, "ne is negative");
  ClientGiven(c, name, "conn", conn, ne);
  *n = ne;
  BufferCopy(elements, conn, (size_t)nodes * (size_t)ne * sizeof *conn);
}

int CoracleSetSurface(CoracleClient c, int ne, const int conn[])
{
  SolidMesh *m = &c->solid.mesh;
  SetElements(c, "CoracleSetSurface", ne, DIM, conn, &m->nfacets, &m->facet);
  return 0;
}

int CoracleSetVolume(CoracleClient c, int ne, const int conn[])
{
  SolidMesh *m = &c->solid.mesh;
  SetElements(c, "CoracleSetVolume", ne, DIM + 1, conn, &m->nelements, &m->element);
  return 0;
}
