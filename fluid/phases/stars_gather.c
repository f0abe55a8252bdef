/* The owner of a vertex keeps its whole star.  Ranks send it the elements that they own around it; then each rank asks
 * for the stars of its vertices, ring by ring. */
#include "common/mesh/mesh_table.h"
#include "fluid/phases/stars_impl.h"
#include <petscis.h>
#include <stdlib.h>
#include <string.h>

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

PetscErrorCode StarsGather(const Mesh *mesh, int *nl, StarElement **element)
{
  Gathering gathering;
  int end[RINGS + 1] = {mesh->ne};
  PetscFunctionBeginUser;
  PetscCall(GatheringBegin(mesh, &gathering));
  for (int r = 0, begin = 0; r < RINGS; r++) {
    PetscCall(AddRing(&gathering, begin));
    begin = end[r];
    end[r + 1] = gathering.nl;
  }
  *nl = gathering.nl;
  *element = gathering.local;
  for (int e = 0; e < *nl; e++) (*element)[e].ring = (e >= end[0]) + (e >= end[1]);
  if (*nl > end[0]) qsort(*element + end[0], (size_t)(*nl - end[0]), sizeof **element, ByNumber);
  PetscCall(GatheringEnd(&gathering));
  PetscFunctionReturn(0);
}
