#include "fluid/phases/stars.h"
#include "common/mesh/mesh_table.h"
#include "fluid/phases/stars_impl.h"
#include <string.h>

/* Local vertices: of owned elements, of the first ring, of the second. */
static PetscErrorCode NumberVertices(Stars *s)
{
  MeshTable table;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(s->nl, &s->vertex));
  PetscCall(PetscMalloc1(3 * s->nl, &s->gid));
  PetscCall(PetscMalloc1(3 * s->nl, &s->point));
  PetscCall(MeshTableCreate(&table, (size_t)(3 * s->nl)));
  for (int r = 0; r <= RINGS; r++) {
    for (int k = 0; k < 3 * s->nl; k++) {
      const StarElement *element = &s->element[k / 3];
      if (element->ring != r) continue;
      int *at = MeshTableAt(&table, 0, (int)element->vertex[k % 3]);
      if (*at < 0) {
        *at = s->nv;
        memcpy(s->point[s->nv], element->x[k % 3], sizeof *s->point);
        s->gid[s->nv++] = element->vertex[k % 3];
      }
      s->vertex[k / 3][k % 3] = *at;
    }
    if (r == 0) s->nowned = s->nv;
    if (r == 1) s->nwhole = s->nv;
  }
  PetscCall(MeshTableDestroy(&table));
  PetscFunctionReturn(0);
}

static PetscErrorCode ListAround(Stars *s)
{
  int *next;
  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(s->nv + 1, &s->start));
  PetscCall(PetscMalloc1(3 * s->nl, &s->around));
  PetscCall(PetscMalloc1(s->nv, &next));
  for (int k = 0; k < 3 * s->nl; k++) s->start[s->vertex[k / 3][k % 3] + 1]++;
  for (int v = 0; v < s->nv; v++) s->start[v + 1] += s->start[v];
  PetscCall(PetscArraycpy(next, s->start, s->nv));
  /* elements by ascending global number: owned ones are a range of it */
  int below = 0;
  while (s->ne + below < s->nl && s->element[s->ne + below].egid < s->mesh->estart) below++;
  for (int k = 0; k < s->nl; k++) {
    const int e = k < below ? s->ne + k : k < below + s->ne ? k - below : k;
    for (int i = 0; i < 3; i++) s->around[next[s->vertex[e][i]]++] = 3 * e + i;
  }
  PetscCall(PetscFree(next));
  PetscFunctionReturn(0);
}

static PetscErrorCode FindNeighbors(Stars *s)
{
  MeshTable edge;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(s->nl, &s->neighbor));
  PetscCall(MeshTableCreate(&edge, (size_t)(3 * s->nl)));
  for (int k = 0; k < 3 * s->nl; k++) s->neighbor[k / 3][k % 3] = -1;
  for (int k = 0; k < 3 * s->nl; k++) {
    const int *v = s->vertex[k / 3];
    int *other = MeshTableEdge(&edge, v[(k + 1) % 3], v[(k + 2) % 3]);
    if (*other >= 0) {
      s->neighbor[k / 3][k % 3] = *other / 3;
      s->neighbor[*other / 3][*other % 3] = k / 3;
    }
    *other = k;
  }
  PetscCall(MeshTableDestroy(&edge));
  PetscFunctionReturn(0);
}

/* Owners learn which of their elements are elsewhere.  Arrivals are in the order of the owners, which is that
 * of the global numbers. */
static PetscErrorCode MakeRoute(Stars *s)
{
  const MPI_Comm comm = s->mesh->comm;
  const int n = s->nl - s->ne;
  const ScatterRanks *asking;
  int *to, *wanted, *asked, *rank;
  Scatter ask;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(n, &to, n, &wanted));
  for (int k = 0; k < n; k++) {
    to[k] = s->element[s->ne + k].rank;
    wanted[k] = s->element[s->ne + k].local;
  }
  PetscCall(ScatterCreate(comm, n, to, NULL, &ask));
  const int narrived = ScatterArriving(ask);
  PetscCall(PetscMalloc2(narrived, &asked, narrived, &rank));
  PetscCall(ScatterForward(ask, sizeof *wanted, wanted, asked));
  PetscCall(ScatterGetSources(ask, &asking));
  for (int r = 0; r < asking->n; r++) {
    for (int k = asking->start[r]; k < asking->start[r + 1]; k++) rank[k] = asking->rank[r];
  }
  PetscCall(ScatterCreate(comm, narrived, rank, asked, &s->route));
  PetscCall(ScatterDestroy(&ask));
  PetscCall(PetscFree2(asked, rank));
  PetscCall(PetscFree2(to, wanted));
  PetscFunctionReturn(0);
}

PetscErrorCode StarsCreate(const Mesh *mesh, Stars **stars)
{
  Stars *s;
  PetscFunctionBeginUser;
  PetscCall(PetscNew(stars));
  s = *stars;
  s->mesh = mesh;
  s->ne = mesh->ne;
  PetscCall(StarsGather(mesh, &s->nl, &s->element));
  PetscCall(NumberVertices(s));
  PetscCall(ListAround(s));
  PetscCall(FindNeighbors(s));
  PetscCall(MakeRoute(s));
  PetscFunctionReturn(0);
}

PetscErrorCode StarsDestroy(Stars **stars)
{
  Stars *s = *stars;
  PetscFunctionBeginUser;
  if (!s) PetscFunctionReturn(0);
  PetscCall(PetscFree(s->element));
  PetscCall(PetscFree(s->vertex));
  PetscCall(PetscFree(s->neighbor));
  PetscCall(PetscFree(s->gid));
  PetscCall(PetscFree(s->point));
  PetscCall(PetscFree(s->start));
  PetscCall(PetscFree(s->around));
  PetscCall(ScatterDestroy(&s->route));
  PetscCall(PetscFree(*stars));
  PetscFunctionReturn(0);
}

PetscErrorCode StarsExchange(const Stars *s, size_t bytes, void *data)
{
  PetscFunctionBeginUser;
  PetscCall(ScatterForward(s->route, bytes, data, (char *)data + bytes * (size_t)s->ne));
  PetscFunctionReturn(0);
}
