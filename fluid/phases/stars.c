/* The owner of a vertex keeps its whole star.  Ranks send it the elements that they own around
 * it; then each rank asks for the stars of its vertices, ring by ring. */
#include "fluid/phases/stars.h"
#include "common/mesh/mesh_table.h"
#include <petscis.h>
#include <string.h>

enum { RINGS = 2 };

/* Elements around vertices, as they were sent: for one vertex first one, then next[]. */
typedef struct {
  int n, capacity;
  StarElement *element;
  int *next;
} Pool;

typedef struct {
  const Mesh *mesh;
  int rank;
  PetscLayout owners; /* of the vertices */
  Pool pool;          /* around owned vertices */
  int *first;         /* [nv_owned] in the pool, -1 */
  MeshTable known;    /* global number -> local element */
  int nl, capacity;
  StarElement *local;
} Gathering;

static PetscErrorCode Reserve(int n, int *capacity, StarElement **element)
{
  PetscFunctionBeginUser;
  if (n > *capacity) {
    *capacity = 2 * n + 64;
    PetscCall(PetscRealloc((size_t)*capacity * sizeof **element, element));
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode AddToPool(Gathering *s, PetscInt vertex, const StarElement *element)
{
  Pool *p = &s->pool;
  int capacity = p->capacity;
  PetscFunctionBeginUser;
  PetscCall(Reserve(p->n + 1, &p->capacity, &p->element));
  if (p->capacity > capacity) PetscCall(PetscRealloc((size_t)p->capacity * sizeof(int), &p->next));
  int *first = &s->first[vertex - s->mesh->vstart];
  p->element[p->n] = *element;
  p->next[p->n] = *first;
  *first = p->n++;
  PetscFunctionReturn(0);
}

static StarElement OwnElement(const Gathering *s, int e)
{
  const Mesh *m = s->mesh;
  StarElement r = {.egid = m->egid[e], .rank = s->rank, .local = e};
  for (int i = 0; i < 3; i++) {
    r.vertex[i] = m->vgid[m->vertex[3 * e + i]];
    r.tag[i] = m->tag[3 * e + i];
    memcpy(r.x[i], &m->x[2 * m->vertex[3 * e + i]], sizeof r.x[i]);
  }
  return r;
}

/* An element of the star of a vertex, on its way to the vertex' owner. */
typedef struct {
  PetscInt vertex;
  StarElement element;
} StarRecord;

/* Elements go to the owners of their vertices. */
static PetscErrorCode FillPool(Gathering *s)
{
  const int n = 3 * s->mesh->ne;
  int *to, m = 0, narrived;
  StarRecord *out, *in;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(n, &to, n, &out));
  for (int e = 0; e < s->mesh->ne; e++) {
    const StarElement element = OwnElement(s, e);
    for (int i = 0; i < 3; i++) {
      PetscMPIInt owner;
      PetscCall(PetscLayoutFindOwner(s->owners, element.vertex[i], &owner));
      if (owner == s->rank) {
        PetscCall(AddToPool(s, element.vertex[i], &element));
        continue;
      }
      to[m] = owner;
      out[m++] = (StarRecord){element.vertex[i], element};
    }
  }
  PetscCall(ScatterRecords(s->mesh->comm, m, to, sizeof *out, out, &narrived, (void **)&in));
  for (int k = 0; k < narrived; k++) PetscCall(AddToPool(s, in[k].vertex, &in[k].element));
  PetscCall(PetscFree(in));
  PetscCall(PetscFree2(to, out));
  PetscFunctionReturn(0);
}

static PetscErrorCode AddLocal(Gathering *s, const StarElement *element)
{
  PetscFunctionBeginUser;
  if ((size_t)(4 * s->nl) > s->known.mask) { /* a larger table */
    PetscCall(MeshTableDestroy(&s->known));
    PetscCall(MeshTableCreate(&s->known, (size_t)(8 * s->nl + 64)));
    for (int e = 0; e < s->nl; e++) *MeshTableAt(&s->known, 0, (int)s->local[e].egid) = e;
  }
  int *at = MeshTableAt(&s->known, 0, (int)element->egid);
  if (*at < 0) {
    PetscCall(Reserve(s->nl + 1, &s->capacity, &s->local));
    *at = s->nl;
    s->local[s->nl++] = *element;
  }
  PetscFunctionReturn(0);
}

/* The stars of vertices that were asked for go to those who asked. */
static PetscErrorCode Answer(Gathering *s, const ScatterRanks *asking, const PetscInt vertex[])
{
  const PetscInt before = s->mesh->vstart;
  int n = 0, narrived, *to;
  StarElement *out, *in;
  PetscFunctionBeginUser;
  for (int k = 0; k < asking->start[asking->n]; k++) {
    for (int p = s->first[vertex[k] - before]; p >= 0; p = s->pool.next[p]) n++;
  }
  PetscCall(PetscMalloc2(n, &to, n, &out));
  n = 0;
  for (int r = 0; r < asking->n; r++) {
    for (int k = asking->start[r]; k < asking->start[r + 1]; k++) {
      for (int p = s->first[vertex[k] - before]; p >= 0; p = s->pool.next[p]) {
        to[n] = asking->rank[r];
        out[n++] = s->pool.element[p];
      }
    }
  }
  PetscCall(ScatterRecords(s->mesh->comm, n, to, sizeof *out, out, &narrived, (void **)&in));
  for (int k = 0; k < narrived; k++) PetscCall(AddLocal(s, &in[k]));
  PetscCall(PetscFree(in));
  PetscCall(PetscFree2(to, out));
  PetscFunctionReturn(0);
}

/* The stars of all vertices of elements begin .. nl - 1. */
static PetscErrorCode AddRing(Gathering *s, int begin)
{
  const int end = s->nl, max = 3 * (end - begin);
  const ScatterRanks *asking;
  int *to, n = 0;
  PetscInt *vertex, *asked;
  MeshTable known;
  Scatter scatter;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(max, &to, max, &vertex));
  PetscCall(MeshTableCreate(&known, (size_t)max));
  for (int k = 3 * begin; k < 3 * end; k++) {
    const PetscInt v = s->local[k / 3].vertex[k % 3];
    int *at = MeshTableAt(&known, 0, (int)v);
    if (*at >= 0) continue;
    *at = 0;
    PetscCall(PetscLayoutFindOwner(s->owners, v, &to[n]));
    vertex[n++] = v;
  }
  PetscCall(MeshTableDestroy(&known));
  PetscCall(ScatterCreate(s->mesh->comm, n, to, NULL, &scatter));
  PetscCall(PetscMalloc1(ScatterArriving(scatter), &asked));
  PetscCall(ScatterForward(scatter, sizeof *vertex, vertex, asked));
  PetscCall(ScatterGetSources(scatter, &asking));
  PetscCall(Answer(s, asking, asked));
  PetscCall(ScatterDestroy(&scatter));
  PetscCall(PetscFree(asked));
  PetscCall(PetscFree2(to, vertex));
  PetscFunctionReturn(0);
}

static PetscErrorCode GatheringBegin(const Mesh *m, Gathering *s)
{
  PetscFunctionBeginUser;
  *s = (Gathering){.mesh = m};
  PetscCallMPI(MPI_Comm_rank(m->comm, &s->rank));
  PetscCall(PetscLayoutCreateFromSizes(m->comm, m->nv_owned, m->nv_global, 1, &s->owners));
  PetscCall(PetscMalloc1(m->nv_owned, &s->first));
  for (int v = 0; v < m->nv_owned; v++) s->first[v] = -1;
  PetscCall(MeshTableCreate(&s->known, (size_t)(2 * m->ne + 64)));
  PetscCall(FillPool(s));
  for (int e = 0; e < m->ne; e++) {
    const StarElement element = OwnElement(s, e);
    PetscCall(AddLocal(s, &element));
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode GatheringEnd(Gathering *s)
{
  PetscFunctionBeginUser;
  PetscCall(PetscLayoutDestroy(&s->owners));
  PetscCall(PetscFree(s->first));
  PetscCall(PetscFree(s->pool.element));
  PetscCall(PetscFree(s->pool.next));
  PetscCall(MeshTableDestroy(&s->known));
  PetscFunctionReturn(0);
}

static int ByNumber(const void *p, const void *q)
{
  const StarElement *a = p, *b = q;
  return (a->egid > b->egid) - (a->egid < b->egid);
}

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
  Gathering gathering;
  Stars *s;
  int end[RINGS + 1];
  PetscFunctionBeginUser;
  PetscCall(PetscNew(stars));
  s = *stars;
  s->mesh = mesh;
  s->ne = end[0] = mesh->ne;
  PetscCall(GatheringBegin(mesh, &gathering));
  for (int r = 0, begin = 0; r < RINGS; r++) {
    PetscCall(AddRing(&gathering, begin));
    begin = end[r];
    end[r + 1] = gathering.nl;
  }
  s->nl = gathering.nl;
  s->element = gathering.local;
  for (int e = 0; e < s->nl; e++) s->element[e].ring = (e >= end[0]) + (e >= end[1]);
  if (s->nl > s->ne) qsort(s->element + s->ne, (size_t)(s->nl - s->ne), sizeof *s->element, ByNumber);
  PetscCall(GatheringEnd(&gathering));
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
