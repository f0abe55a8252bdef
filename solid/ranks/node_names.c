#include "solid/ranks/node_names.h"
#include "solid/solid_impl.h"
#include <stdlib.h>

static int CompareNames(const void *a, const void *b)
{
  const NodeName *p = a, *q = b;
  return (p->gid > q->gid) - (p->gid < q->gid);
}

PetscErrorCode NodeNamesCreate(int n, const long long gid[], NodeNames *names)
{
  PetscFunctionBeginUser;
  names->n = n;
  PetscCall(PetscMalloc1((size_t)n, &names->name));
  for (int k = 0; k < n; k++) names->name[k] = (NodeName){gid[k], k};
  if (n) qsort(names->name, (size_t)n, sizeof *names->name, CompareNames);
  PetscFunctionReturn(0);
}

int NodeNamesFind(const NodeNames *names, long long gid)
{
  const NodeName wanted = {gid, -1};
  const size_t n = (size_t)names->n;
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
PetscErrorCode NodeRanks(Solid s, int n, const long long gid[], int of[])
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
  Solid s;
  NodeNames names;
  NodeAnswer answer;
} Question;

static PetscErrorCode AnswerByName(void *context, long long gid, void *record)
{
  const Question *q = context;
  const int n = NodeNamesFind(&q->names, gid);
  PetscFunctionBeginUser;
  PetscCheck(n >= 0, PETSC_COMM_SELF, PETSC_ERR_PLIB, "node %lld is not here", gid);
  q->answer(q->s, n, record);
  PetscFunctionReturn(0);
}

PetscErrorCode NodesRequest(Solid s, int n, const long long gid[], size_t bytes, NodeAnswer answer,
                            void *record)
{
  Question q = {.s = s, .answer = answer};
  int *of;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1((size_t)n, &of));
  PetscCall(NodeRanks(s, n, gid, of));
  PetscCall(NodeNamesCreate(s->nnodes, s->gid, &q.names));
  PetscCall(ScatterRequest(s->comm, n, of, gid, bytes, AnswerByName, &q, record));
  PetscCall(NodeNamesDestroy(&q.names));
  PetscCall(PetscFree(of));
  PetscFunctionReturn(0);
}
