/* Nodes by their gid for whoever does not know on which rank they are now. */
#include "solid/ranks/node_directory.h"
#include "common/exchange/scatter.h"
#include "solid/solid_impl.h"
#include <stdlib.h>

static int CompareNames(const void *a, const void *b)
{
  const NodeName *p = a, *q = b;
  return (p->gid > q->gid) - (p->gid < q->gid);
}

PetscErrorCode NodeNamesCreate(Solid s, NodeNames *names)
{
  PetscFunctionBeginUser;
  names->s = s;
  PetscCall(PetscMalloc1((size_t)s->nnodes, &names->name));
  for (int n = 0; n < s->nnodes; n++) names->name[n] = (NodeName){s->gid[n], n};
  if (s->nnodes) qsort(names->name, (size_t)s->nnodes, sizeof *names->name, CompareNames);
  PetscFunctionReturn(0);
}

int NodeNamesFind(const NodeNames *names, long long gid)
{
  const NodeName wanted = {gid, -1};
  const size_t n = (size_t)names->s->nnodes;
  const NodeName *found = n ? bsearch(&wanted, names->name, n, sizeof *names->name, CompareNames) : NULL;
  return found ? found->node : -1;
}

PetscErrorCode NodeNamesDestroy(NodeNames *names)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(names->name));
  PetscFunctionReturn(0);
}

/* The rank of the corner that has given the node its gid: an element's own, or the lowest at a node of the
 * start. */
static PetscErrorCode NodeOwners(Solid s, int n, const long long gid[], int of[])
{
  const Model *a = s->model;
  int *lowest;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1((size_t)a->nnodes, &lowest));
  for (int k = 3 * a->nelements - 1; k >= 0; k--) lowest[a->element[k]] = k / 3;
  for (int k = 0; k < n; k++)
    of[k] = s->part[gid[k] < a->nnodes ? lowest[gid[k]] : (int)((gid[k] - a->nnodes) / 3)];
  PetscCall(PetscFree(lowest));
  PetscFunctionReturn(0);
}

typedef struct {
  NodeNames names;
  NodeAnswer answer;
} Question;

static PetscErrorCode AnswerByName(void *context, long long gid, void *record)
{
  const Question *q = context;
  const int n = NodeNamesFind(&q->names, gid);
  PetscFunctionBeginUser;
  PetscCheck(n >= 0, PETSC_COMM_SELF, PETSC_ERR_PLIB, "node %lld is not here", gid);
  q->answer(q->names.s, n, record);
  PetscFunctionReturn(0);
}

PetscErrorCode NodesRequest(Solid s, int n, const long long gid[], size_t bytes, NodeAnswer answer,
                            void *record)
{
  Question q = {.answer = answer};
  int *of;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1((size_t)n, &of));
  PetscCall(NodeOwners(s, n, gid, of));
  PetscCall(NodeNamesCreate(s, &q.names));
  PetscCall(ScatterRequest(s->comm, n, of, gid, bytes, AnswerByName, &q, record));
  PetscCall(NodeNamesDestroy(&q.names));
  PetscCall(PetscFree(of));
  PetscFunctionReturn(0);
}

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

PetscErrorCode NodeDirectoryMotion(Solid s, int n, const long long gid[], NodeMotion motion[])
{
  PetscFunctionBeginUser;
  PetscCall(NodesRequest(s, n, gid, sizeof *motion, AnswerMotion, motion));
  PetscFunctionReturn(0);
}

typedef struct {
  long long gid;
  double load[2];
} NodeLoad;

PetscErrorCode NodeDirectoryLoad(Solid s, int n, const long long gid[], const double load[], double owned[])
{
  NodeNames names;
  NodeLoad *out, *in;
  void *received;
  int *of, nin;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2((size_t)n, &of, (size_t)n, &out));
  PetscCall(NodeOwners(s, n, gid, of));
  for (int k = 0; k < n; k++) out[k] = (NodeLoad){gid[k], {load[2 * k], load[2 * k + 1]}};
  PetscCall(ScatterRecords(s->comm, n, of, sizeof *out, out, &nin, &received));
  in = received;
  PetscCall(NodeNamesCreate(s, &names));
  PetscCall(PetscArrayzero(owned, 2 * (size_t)s->nnodes));
  for (int k = 0; k < nin; k++) {
    const int node = NodeNamesFind(&names, in[k].gid);
    PetscCheck(node >= 0, PETSC_COMM_SELF, PETSC_ERR_PLIB, "node %lld is not here", in[k].gid);
    for (int c = 0; c < 2; c++) owned[2 * node + c] += in[k].load[c];
  }
  PetscCall(NodeNamesDestroy(&names));
  PetscCall(PetscFree(in));
  PetscCall(PetscFree2(of, out));
  PetscFunctionReturn(0);
}
