#include "solid/ranks/node_directory.h"
#include "solid/ranks/node_names.h"
#include "solid/ranks/state.h"

struct NodeDirectory_s {
  Solid s; /* borrowed */
  int n, nelements, nfacets, partition, revision;
  long long *gid; /* [n] */
  int *number;    /* [nelements] in the model */
  int *element;   /* [nelements][3] */
  int *facet;     /* [nfacets][2] */
};

/* With room for its nodes, elements and facets. */
static PetscErrorCode Allocate(Solid s, int n, int nelements, int nfacets, NodeDirectory *directory)
{
  NodeDirectory d;
  PetscFunctionBeginUser;
  PetscCall(PetscNew(&d));
  d->s = s;
  d->n = n;
  d->nelements = nelements;
  d->nfacets = nfacets;
  d->partition = s->partition_number;
  d->revision = s->revision;
  PetscCall(PetscMalloc1((size_t)n, &d->gid));
  PetscCall(PetscMalloc1((size_t)nelements, &d->number));
  PetscCall(PetscMalloc1(3 * (size_t)nelements, &d->element));
  PetscCall(PetscMalloc1(2 * (size_t)nfacets, &d->facet));
  *directory = d;
  PetscFunctionReturn(0);
}

PetscErrorCode NodeDirectoryCreate(Solid s, NodeDirectory *directory)
{
  NodeDirectory d;
  PetscFunctionBeginUser;
  PetscCall(Allocate(s, s->nnodes, s->elements.n, s->nfacets, &d));
  PetscCall(PetscArraycpy(d->gid, s->gid, (size_t)d->n));
  PetscCall(PetscArraycpy(d->number, s->elements.number, (size_t)d->nelements));
  PetscCall(PetscArraycpy(d->element, s->element, 3 * (size_t)d->nelements));
  PetscCall(PetscArraycpy(d->facet, s->facet, 2 * (size_t)d->nfacets));
  *directory = d;
  PetscFunctionReturn(0);
}

PetscErrorCode NodeDirectoryDestroy(NodeDirectory *directory)
{
  NodeDirectory d = *directory;
  PetscFunctionBeginUser;
  if (!d) PetscFunctionReturn(0);
  PetscCall(PetscFree(d->gid));
  PetscCall(PetscFree(d->number));
  PetscCall(PetscFree(d->element));
  PetscCall(PetscFree(d->facet));
  PetscCall(PetscFree(*directory));
  PetscFunctionReturn(0);
}

/* --- after cracks ---------------------------------------------------------------------------------------- */

/* An element as it is now. */
typedef struct {
  long long gid[3];
  int surface[3]; /* whether the side from corner i to the next is a facet */
} ElementRecord;

typedef struct {
  Solid s;
  int (*surface)[3]; /* [elements.n] */
} ElementQuestion;

static PetscErrorCode AnswerElement(void *context, long long number, void *record)
{
  const ElementQuestion *q = context;
  const int e = StateElement(q->s, number);
  ElementRecord *r = record;
  PetscFunctionBeginUser;
  PetscCheck(e >= 0, PETSC_COMM_SELF, PETSC_ERR_PLIB, "element %lld is not here", number);
  for (int i = 0; i < 3; i++) {
    r->gid[i] = q->s->gid[q->s->element[3 * e + i]];
    r->surface[i] = q->surface[e][i];
  }
  PetscFunctionReturn(0);
}

/* record[d->nelements], of the ranks that have the elements. */
static PetscErrorCode RequestElements(NodeDirectory d, ElementRecord record[])
{
  const Solid s = d->s;
  ElementQuestion q = {.s = s};
  long long *key;
  int *of;
  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1((size_t)s->elements.n, &q.surface));
  PetscCall(PetscMalloc2((size_t)d->nelements, &of, (size_t)d->nelements, &key));
  for (int k = 0; k < s->nfacets; k++) q.surface[s->facet_element[k]][s->facet_side[k]] = 1;
  for (int k = 0; k < d->nelements; k++) {
    key[k] = d->number[k];
    of[k] = s->part[d->number[k]];
  }
  PetscCall(ScatterRequest(s->comm, d->nelements, of, key, sizeof *record, AnswerElement, &q, record));
  PetscCall(PetscFree2(of, key));
  PetscCall(PetscFree(q.surface));
  PetscFunctionReturn(0);
}

/* gid[*n]: the nodes of the directory in their order, then new ones of its elements by ascending gid; allocated. */
static PetscErrorCode ListNodes(NodeDirectory d, const ElementRecord record[], int *n, long long **gid)
{
  NodeNames old, fresh;
  long long *corner;
  int ncorners = 0;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(3 * (size_t)d->nelements, &corner));
  PetscCall(NodeNamesCreate(d->n, d->gid, &old));
  for (int k = 0; k < 3 * d->nelements; k++)
    if (NodeNamesFind(&old, record[k / 3].gid[k % 3]) < 0) corner[ncorners++] = record[k / 3].gid[k % 3];
  PetscCall(NodeNamesCreate(ncorners, corner, &fresh));
  PetscCall(PetscMalloc1((size_t)(d->n + ncorners), gid));
  PetscCall(PetscArraycpy(*gid, d->gid, (size_t)d->n));
  *n = d->n;
  for (int k = 0; k < ncorners; k++)
    if (k == 0 || fresh.name[k].gid != fresh.name[k - 1].gid) (*gid)[(*n)++] = fresh.name[k].gid;
  PetscCall(NodeNamesDestroy(&old));
  PetscCall(NodeNamesDestroy(&fresh));
  PetscCall(PetscFree(corner));
  PetscFunctionReturn(0);
}

PetscErrorCode NodeDirectoryRenew(NodeDirectory d, NodeDirectory *renewed)
{
  NodeDirectory r;
  ElementRecord *record;
  NodeNames names;
  long long *gid;
  int n, nfacets = 0;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1((size_t)d->nelements, &record));
  PetscCall(RequestElements(d, record));
  PetscCall(ListNodes(d, record, &n, &gid));
  for (int k = 0; k < 3 * d->nelements; k++) nfacets += record[k / 3].surface[k % 3];
  PetscCall(Allocate(d->s, n, d->nelements, nfacets, &r));
  r->partition = d->partition;
  PetscCall(PetscArraycpy(r->gid, gid, (size_t)n));
  PetscCall(PetscArraycpy(r->number, d->number, (size_t)d->nelements));
  PetscCall(NodeNamesCreate(n, gid, &names));
  for (int k = 0; k < 3 * d->nelements; k++) r->element[k] = NodeNamesFind(&names, record[k / 3].gid[k % 3]);
  nfacets = 0;
  for (int k = 0; k < 3 * d->nelements; k++) {
    if (!record[k / 3].surface[k % 3]) continue;
    r->facet[nfacets++] = r->element[k];
    r->facet[nfacets++] = r->element[k - k % 3 + (k + 1) % 3];
  }
  PetscCall(NodeNamesDestroy(&names));
  PetscCall(PetscFree(gid));
  PetscCall(PetscFree(record));
  *renewed = r;
  PetscFunctionReturn(0);
}

/* --- what is registered ---------------------------------------------------------------------------------- */

RegisteredMesh NodeDirectoryMesh(NodeDirectory d)
{
  return (RegisteredMesh){d->n, d->nelements, d->nfacets, d->gid, d->element, d->facet};
}

PetscBool NodeDirectoryIsPresent(NodeDirectory d)
{
  return (PetscBool)(d->partition == d->s->partition_number);
}

PetscBool NodeDirectoryIsComplete(NodeDirectory d)
{
  return (PetscBool)(d->revision == d->s->revision);
}

/* --- what is exchanged ----------------------------------------------------------------------------------- */

static void AnswerMotion(const Solid s, int n, void *record)
{
  NodeMotion *m = record;
  m->mobility = s->mobility[n];
  for (int c = 0; c < 2; c++) {
    m->x[c] = s->x[2 * n + c];
    m->interface_velocity[c] = s->interface_velocity[2 * n + c];
    m->acceleration[c] = s->acceleration[2 * n + c];
    m->mean[c] = (s->x[2 * n + c] - s->start[2 * n + c]) / s->dt;
  }
}

PetscErrorCode NodeDirectoryMotion(NodeDirectory d, NodeMotion motion[])
{
  PetscFunctionBeginUser;
  PetscCall(NodesRequest(d->s, d->n, d->gid, sizeof *motion, AnswerMotion, motion));
  PetscFunctionReturn(0);
}

enum { LOAD_MOST = 4 };

typedef struct {
  long long gid;
  double load[LOAD_MOST];
} NodeLoad;

PetscErrorCode NodeDirectoryLoad(NodeDirectory d, int ncomp, const double load[], double present[])
{
  NodeNames names;
  NodeLoad *out, *in;
  void *received;
  int *of, nin;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2((size_t)d->n, &of, (size_t)d->n, &out));
  PetscCall(NodeRanks(d->s, d->n, d->gid, of));
  for (int k = 0; k < d->n; k++) {
    out[k] = (NodeLoad){.gid = d->gid[k]};
    for (int c = 0; c < ncomp; c++) out[k].load[c] = load[ncomp * k + c];
  }
  PetscCall(ScatterRecords(d->s->comm, d->n, of, sizeof *out, out, &nin, &received));
  in = received;
  PetscCall(NodeNamesCreate(d->s->nnodes, d->s->gid, &names));
  PetscCall(PetscArrayzero(present, (size_t)ncomp * (size_t)d->s->nnodes));
  for (int k = 0; k < nin; k++) {
    const int node = NodeNamesFind(&names, in[k].gid);
    PetscCheck(node >= 0, PETSC_COMM_SELF, PETSC_ERR_PLIB, "node %lld is not here", in[k].gid);
    for (int c = 0; c < ncomp; c++) present[ncomp * node + c] += in[k].load[c];
  }
  PetscCall(NodeNamesDestroy(&names));
  PetscCall(PetscFree(in));
  PetscCall(PetscFree2(of, out));
  PetscFunctionReturn(0);
}
