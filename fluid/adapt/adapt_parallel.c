#include "fluid/adapt/adapt_parallel.h"
#include "common/exchange/scatter.h"
#include "fluid/adapt/adapt_near.h"
#include <string.h>

/* A pass in which a part would have less than so many triangles makes do with fewer parts; twice as many in
 * the next one: a mesh of few triangles cannot be cut away from everywhere. */
enum { MAX_PASSES = 8, SMALL_PART = 50 };

/* A part may be so much larger than the mean. */
#define IMBALANCE 1.03

/* The mesh between two passes. */
typedef struct {
  MPI_Comm comm;
  int rank, size;
  MeshPart part;
  int *weight;        /* [ne][3] for the next partition: where it should not cut */
  double *data;       /* [nv][DATA]: metric and the distance from what was frozen in the last pass */
  long long next_gid; /* above all that are in use */
  AdaptReport report; /* of the whole mesh, so far */
} Parallel;

enum { DATA = 4 };

/* What a pass works on: the part with facets of one more tag on faces to other ranks. */
typedef struct {
  MeshSerial mesh; /* facets and tags of its own, the rest borrowed */
  double *metric;
  char *frozen, *frozen_tag, *inactive;
} Frozen;

static PetscErrorCode FreezeFaces(const MeshSerial *from, const char face[], MeshSerial *to)
{
  const int ntags = from->ntags;
  int nb = from->nb;
  PetscFunctionBeginUser;
  *to = *from;
  to->ntags = ntags + 1;
  for (int k = 0; k < 3 * from->ne; k++) nb += face[k];
  PetscCall(PetscMalloc1(2 * nb, &to->facet));
  PetscCall(PetscMalloc1(nb, &to->facet_tag));
  PetscCall(PetscCalloc1(ntags + 1, &to->tag_name));
  PetscCall(PetscArraycpy(to->facet, from->facet, 2 * from->nb));
  PetscCall(PetscArraycpy(to->facet_tag, from->facet_tag, from->nb));
  if (ntags) memcpy(to->tag_name, from->tag_name, (size_t)ntags * sizeof *to->tag_name);
  for (int k = 0; k < 3 * from->ne; k++) {
    if (!face[k]) continue;
    to->facet[2 * to->nb] = from->vertex[k - k % 3 + (k + 1) % 3];
    to->facet[2 * to->nb + 1] = from->vertex[k - k % 3 + (k + 2) % 3];
    to->facet_tag[to->nb++] = ntags;
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode Freeze(const Parallel *p, Frozen *f)
{
  const MeshSerial *s = &p->part.serial;
  char *face;
  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(3 * s->ne, &face));
  PetscCall(PetscMalloc2(3 * s->nv, &f->metric, s->nv, &f->inactive));
  PetscCall(PetscCalloc1(s->nv, &f->frozen));
  PetscCall(PetscCalloc1(s->ntags + 1, &f->frozen_tag));
  f->frozen_tag[s->ntags] = 1;
  if (p->size > 1) PetscCall(MeshPartShared(p->comm, &p->part, face, f->frozen));
  PetscCall(FreezeFaces(s, face, &f->mesh));
  for (int v = 0; v < s->nv; v++) {
    for (int k = 0; k < 3; k++) f->metric[3 * v + k] = p->data[DATA * v + k];
    f->inactive[v] = p->data[DATA * v + 3] >= NEAR_INACTIVE;
  }
  PetscCall(PetscFree(face));
  PetscFunctionReturn(0);
}

static PetscErrorCode FrozenDestroy(Frozen *f)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(f->mesh.facet));
  PetscCall(PetscFree(f->mesh.facet_tag));
  PetscCall(PetscFree(f->mesh.tag_name));
  PetscCall(PetscFree2(f->metric, f->inactive));
  PetscCall(PetscFree(f->frozen));
  PetscCall(PetscFree(f->frozen_tag));
  PetscFunctionReturn(0);
}

/* Facets of the last tag go, and so does its name. */
static void Thaw(MeshSerial *m)
{
  int nb = 0;
  m->ntags--;
  for (int k = 0; k < m->nb; k++) {
    if (m->facet_tag[k] == m->ntags) continue;
    m->facet[2 * nb] = m->facet[2 * k];
    m->facet[2 * nb + 1] = m->facet[2 * k + 1];
    m->facet_tag[nb++] = m->facet_tag[k];
  }
  m->nb = nb;
}

/* Old vertices keep their global numbers, new ones get those that follow. */
static PetscErrorCode NumberVertices(Parallel *p, const long long old[], const AdaptResult *r,
                                     long long gid[])
{
  long long fresh = 0, before = 0, all;
  PetscFunctionBeginUser;
  for (int v = 0; v < r->mesh.nv; v++) fresh += r->origin[v] < 0;
  PetscCallMPI(MPI_Exscan(&fresh, &before, 1, MPI_LONG_LONG, MPI_SUM, p->comm));
  PetscCallMPI(MPI_Allreduce(&fresh, &all, 1, MPI_LONG_LONG, MPI_SUM, p->comm));
  long long next = p->next_gid + (p->rank ? before : 0);
  for (int v = 0; v < r->mesh.nv; v++) gid[v] = r->origin[v] < 0 ? next++ : old[r->origin[v]];
  p->next_gid += all;
  PetscFunctionReturn(0);
}

/* The result, with the vertices' distances from what was frozen, becomes the part. */
static PetscErrorCode Take(Parallel *p, const int distance[], AdaptResult *r)
{
  const int nv = r->mesh.nv;
  MeshPart new = {.serial = r->mesh};
  double *data;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(nv, &new.gid));
  PetscCall(PetscMalloc1(DATA * nv, &data));
  PetscCall(NumberVertices(p, p->part.gid, r, new.gid));
  for (int v = 0; v < nv; v++) {
    for (int k = 0; k < 3; k++) data[DATA * v + k] = r->metric[3 * v + k];
    data[DATA * v + 3] = distance[v];
  }
  memset(&r->mesh, 0, sizeof r->mesh); /* taken over */
  Thaw(&new.serial);
  PetscCall(PetscFree(p->data));
  PetscCall(MeshPartDestroy(&p->part));
  p->part = new;
  p->data = data;
  PetscFunctionReturn(0);
}

/* Looks at the result near what was frozen; *fits: another pass would change little. */
static PetscErrorCode Judge(Parallel *p, const char frozen[], AdaptResult *r, bool *fits)
{
  Near near;
  int *distance;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(r->mesh.nv, &distance));
  NearDistances(r, frozen, distance);
  NearMeasure(r, distance, p->part.serial.ntags, &near);
  PetscCall(NearReduce(p->comm, &near, &r->report, &p->report, fits));
  PetscCall(PetscMalloc1(3 * r->mesh.ne + 1, &p->weight)); /* NULL would mean: no weights */
  PetscCall(NearWeights(r, distance, p->weight));
  PetscCall(Take(p, distance, r));
  PetscCall(PetscFree(distance));
  PetscFunctionReturn(0);
}

/* One adaptation with frozen cuts; *fits: another pass would change little. */
static PetscErrorCode Pass(Parallel *p, bool *fits)
{
  Frozen f;
  AdaptResult r = {0};
  PetscFunctionBeginUser;
  PetscCall(Freeze(p, &f));
  const AdaptOptions own = {f.frozen, f.frozen_tag, f.inactive};
  const PetscErrorCode failed = CollectiveError(p->comm, MeshAdapt(&f.mesh, f.metric, &own, &r));
  if (!failed) PetscCall(Judge(p, f.frozen, &r, fits));
  PetscCall(AdaptResultDestroy(&r));
  PetscCall(FrozenDestroy(&f));
  PetscFunctionReturn(failed);
}

/* New parts: `least` > 0 triangles in each if these are enough, and away from the last cuts; or, for 0, on
 * all ranks and just as METIS likes it. */
static PetscErrorCode Repartition(Parallel *p, long long least)
{
  long long all = p->part.serial.ne;
  MeshPart moved;
  double *data;
  int *target, nparts = p->size;
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &all, 1, MPI_LONG_LONG, MPI_SUM, p->comm));
  if (least > 0) nparts = (int)PetscMin((long long)nparts, PetscMax(1, all / least));
  PetscCall(PetscMalloc1(p->part.serial.ne, &target));
  PetscCall(MeshPartPartition(p->comm, &p->part, nparts, least > 0 ? p->weight : NULL, target));
  PetscCall(MeshPartMigrate(p->comm, &p->part, target, DATA, p->data, &moved, &data));
  PetscCall(PetscFree(target));
  PetscCall(PetscFree(p->weight));
  PetscCall(PetscFree(p->data));
  PetscCall(MeshPartDestroy(&p->part));
  p->part = moved;
  p->data = data;
  PetscFunctionReturn(0);
}

static PetscErrorCode IsBalanced(const Parallel *p, bool *balanced)
{
  long long most = p->part.serial.ne, all = most;
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &most, 1, MPI_LONG_LONG, MPI_MAX, p->comm));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &all, 1, MPI_LONG_LONG, MPI_SUM, p->comm));
  *balanced = (double)most * p->size <= IMBALANCE * (double)all;
  PetscFunctionReturn(0);
}

/* The parts of the last pass are equal, but keep away from old cuts at the price of longer ones. */
static PetscErrorCode Passes(Parallel *p)
{
  bool fits = false, balanced = true;
  int pass = 0;
  PetscFunctionBeginUser;
  for (; pass < MAX_PASSES && !fits; pass++) {
    if (pass > 0) PetscCall(Repartition(p, (long long)SMALL_PART << pass));
    const PetscErrorCode failed = Pass(p, &fits);
    if (failed) PetscFunctionReturn(failed);
  }
  PetscCall(IsBalanced(p, &balanced));
  if (pass > 1 || !balanced) PetscCall(Repartition(p, 0));
  PetscFunctionReturn(0);
}

static PetscErrorCode ParallelCreate(const Mesh *mesh, const double metric[], Parallel *p)
{
  PetscFunctionBeginUser;
  memset(p, 0, sizeof *p);
  p->comm = mesh->comm;
  PetscCallMPI(MPI_Comm_rank(p->comm, &p->rank));
  PetscCallMPI(MPI_Comm_size(p->comm, &p->size));
  PetscCall(MeshPartOf(mesh, &p->part));
  p->next_gid = mesh->nv_global;
  PetscCall(PetscMalloc1(DATA * p->part.serial.nv, &p->data));
  for (int v = 0; v < p->part.serial.nv; v++) {
    for (int k = 0; k < 3; k++) p->data[DATA * v + k] = metric[3 * v + k];
    p->data[DATA * v + 3] = 0.0; /* all are looked at in the first pass */
  }
  PetscFunctionReturn(0);
}

PetscErrorCode MeshAdaptParallel(const Mesh *mesh, const double metric[], Mesh **adapted, AdaptReport *report)
{
  Parallel p;
  PetscFunctionBeginUser;
  PetscCall(ParallelCreate(mesh, metric, &p));
  const PetscErrorCode failed = Passes(&p);
  if (!failed) PetscCall(MeshBuild(p.comm, &p.part, adapted));
  if (!failed && report) *report = p.report;
  PetscCall(PetscFree(p.data));
  PetscCall(PetscFree(p.weight));
  PetscCall(MeshPartDestroy(&p.part));
  PetscFunctionReturn(failed);
}
