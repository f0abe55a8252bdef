/* Elements change ranks.  The new share is taken from the assembly as the first one was, so that it is whole
 * and at rest; then what has happened since is asked of the ranks that had it:
 *
 *     damage of joints    of the rank of the joint's first element; cracks are cut again, and by the numbers
 *                         of their corners the parts of nodes get the gid that they had (joints_impl.h)
 *     nodes               x, v, .. by gid, of the rank of the lowest element there, which has it for certain
 *     slips               to the rank of the edge's element, by its number in the assembly
 *
 * The share before stays as it is while a saved state is in it. */
#include "contact_impl.h"
#include "deal.h"
#include "joints_impl.h"
#include <stdlib.h>

/* --- joints
 * ------------------------------------------------------------------------------------------------- */

static PetscErrorCode AnswerJoint(void *joints, long long number, void *record)
{
  const Joints j = joints;
  PetscFunctionBeginUser;
  const int k = JointsFind(j, (int)number);
  PetscCheck(k >= 0, PETSC_COMM_SELF, PETSC_ERR_PLIB, "joint %lld is not here", number);
  PetscCall(PetscMemcpy(record, &j->memory[k], sizeof j->memory[k]));
  PetscFunctionReturn(0);
}

static PetscErrorCode TakeJoints(Solid s, Solid new)
{
  const Joints j = new->joints;
  long long *key;
  int *of;
  PetscFunctionBeginUser;
  if (!s->joints) PetscFunctionReturn(0);
  PetscCall(PetscMalloc2((size_t)j->n, &key, (size_t)j->n, &of));
  for (int k = 0; k < j->n; k++) {
    key[k] = j->joint[k].number;
    of[k] = s->part[j->joint[k].first];
  }
  PetscCall(DealAsk(s->comm, j->n, of, key, sizeof *j->memory, AnswerJoint, s->joints, j->memory));
  PetscCall(PetscFree2(key, of));
  JointsReplay(j, new);
  PetscFunctionReturn(0);
}

/* --- nodes
 * -------------------------------------------------------------------------------------------------- */

typedef struct {
  double x[2], v[2], start[2], load[2];
} NodeState;

typedef struct {
  long long gid;
  int node;
} Named;

typedef struct {
  Solid s;
  Named *name; /* [s->nnodes] by gid */
} NodeNames;

static int CompareNames(const void *a, const void *b)
{
  const Named *p = a, *q = b;
  return (p->gid > q->gid) - (p->gid < q->gid);
}

static PetscErrorCode AnswerNode(void *names, long long gid, void *record)
{
  const NodeNames *k = names;
  const Named wanted = {gid, -1};
  NodeState *to = record;
  PetscFunctionBeginUser;
  const Named *found = bsearch(&wanted, k->name, (size_t)k->s->nnodes, sizeof *k->name, CompareNames);
  PetscCheck(found, PETSC_COMM_SELF, PETSC_ERR_PLIB, "node %lld is not here", gid);
  for (int c = 0; c < 2; c++) {
    const int i = 2 * found->node + c;
    to->x[c] = k->s->x[i];
    to->v[c] = k->s->v[i];
    to->start[c] = k->s->start[i];
    to->load[c] = k->s->load[i];
  }
  PetscFunctionReturn(0);
}

/* of[n]: the rank of the corner that has given the node its gid: an element's own, or the lowest at a node of
 * the start. */
static PetscErrorCode NodeOwners(Solid s, int n, const long long gid[], int of[])
{
  const Assembly *a = s->assembly;
  int *lowest;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1((size_t)a->nnodes, &lowest));
  for (int k = 3 * a->nelements - 1; k >= 0; k--) lowest[a->element[k]] = k / 3;
  for (int k = 0; k < n; k++)
    of[k] = s->part[gid[k] < a->nnodes ? lowest[gid[k]] : (int)((gid[k] - a->nnodes) / 3)];
  PetscCall(PetscFree(lowest));
  PetscFunctionReturn(0);
}

static PetscErrorCode TakeNodes(Solid s, Solid new)
{
  NodeNames names = {s, NULL};
  NodeState *state;
  int *of;
  PetscFunctionBeginUser;
  PetscCall(
      PetscMalloc3((size_t)s->nnodes, &names.name, (size_t) new->nnodes, &of, (size_t) new->nnodes, &state));
  for (int n = 0; n < s->nnodes; n++) names.name[n] = (Named){s->gid[n], n};
  if (s->nnodes) qsort(names.name, (size_t)s->nnodes, sizeof *names.name, CompareNames);
  PetscCall(NodeOwners(s, new->nnodes, new->gid, of));
  PetscCall(DealAsk(s->comm, new->nnodes, of, new->gid, sizeof *state, AnswerNode, &names, state));
  for (int k = 0; k < 2 * new->nnodes; k++) {
    const NodeState *from = &state[k / 2];
    new->x[k] = from->x[k % 2];
    new->v[k] = from->v[k % 2];
    new->start[k] = from->start[k % 2];
    new->load[k] = from->load[k % 2];
  }
  PetscCall(PetscFree3(names.name, of, state));
  PetscFunctionReturn(0);
}

/* --- springs of friction
 * ------------------------------------------------------------------------------------ */

static int CompareNumbers(const void *a, const void *b)
{
  const int *p = a, *q = b;
  return (*p > *q) - (*p < *q);
}

/* Slips travel with their edges numbered as in the assembly. */
static PetscErrorCode TakeSlips(Solid s, Solid new, const int part[])
{
  const Slips *h;
  const Elements *e = &new->elements;
  Slip *out, *in;
  void *received;
  int *to, n;
  PetscFunctionBeginUser;
  PetscCall(ContactForgetPairs(s->contact));
  h = &s->contact->history;
  PetscCall(PetscMalloc2((size_t)h->n, &out, (size_t)h->n, &to));
  for (int k = 0; k < h->n; k++) {
    const int number = s->elements.number[h->slip[k].edge / 3];
    out[k] = (Slip){3 * number + h->slip[k].edge % 3, h->slip[k].other, h->slip[k].slip};
    to[k] = part[number];
  }
  PetscCall(Deal(s->comm, h->n, to, sizeof *out, out, &n, &received));
  in = received;
  for (int k = 0; k < n; k++) {
    const int number = in[k].edge / 3;
    const int *found = bsearch(&number, e->number, (size_t)e->n, sizeof *e->number, CompareNumbers);
    PetscCheck(found, PETSC_COMM_SELF, PETSC_ERR_PLIB, "element %d is not here", number);
    in[k].edge = 3 * (int)(found - e->number) + in[k].edge % 3;
  }
  PetscCall(ContactTakeSlips(new->contact, n, in));
  PetscCall(PetscFree2(out, to));
  PetscCall(PetscFree(in));
  PetscFunctionReturn(0);
}

/* --- the share
 * ---------------------------------------------------------------------------------------------- */

/* What is the same on all ranks. */
static void TakeTime(const Solid s, Solid new)
{
  new->h = s->h;
  new->dt = s->dt;
  new->done = s->done;
  new->moved_for = s->moved_for;
  new->stats = s->stats;
  new->balance = s->balance;
  new->assembly = s->assembly;
  new->before = s->before;
  new->kept = s->kept;
  new->revision = s->revision + 1;
}

/* The share with everything but `before` freed. */
static PetscErrorCode Forget(Solid *s)
{
  PetscFunctionBeginUser;
  if (*s) PetscCall(SolidFreeShare(*s));
  PetscCall(PetscFree(*s));
  PetscFunctionReturn(0);
}

static void Swap(Solid a, Solid b)
{
  const struct Solid_s old = *a;
  *a = *b;
  *b = old;
}

PetscErrorCode SolidRedistribute(Solid s, const int part[])
{
  Solid new;
  PetscFunctionBeginUser;
  PetscCheck(s->part || s->size == 1, s->comm, PETSC_ERR_ARG_WRONGSTATE, "the solid has no `rebalance`");
  if (!s->part) PetscFunctionReturn(0);
  PetscCall(PetscNew(&new));
  new->comm = s->comm;
  new->rank = s->rank;
  new->size = s->size;
  new->setup = s->setup;
  PetscCall(SolidTakeShare(new, s->assembly, part));
  PetscCall(PetscMalloc1((size_t)s->assembly->nelements, &new->part));
  PetscCall(PetscArraycpy(new->part, part, (size_t)s->assembly->nelements));
  PetscCall(ContactCreate(new, &new->contact));
  PetscCall(TakeJoints(s, new));
  PetscCall(TakeNodes(s, new));
  PetscCall(TakeSlips(s, new, part));
  TakeTime(s, new);
  if (new->joints)
    PetscCall(JointsSettle(new->joints, new));
  else
    PetscCall(ContactSearch(new->contact, new, 0.0));
  new->stats.rebalanced++;
  Swap(s, new);
  if (s->kept && !s->before)
    s->before = new;
  else
    PetscCall(Forget(&new));
  PetscFunctionReturn(0);
}

PetscErrorCode SolidKeepShare(Solid s)
{
  PetscFunctionBeginUser;
  PetscCall(Forget(&s->before));
  s->kept = PETSC_TRUE;
  PetscFunctionReturn(0);
}

PetscErrorCode SolidPutBackShare(Solid s)
{
  Solid before = s->before;
  PetscFunctionBeginUser;
  if (!before) PetscFunctionReturn(0);
  before->stats = s->stats;
  Swap(s, before);
  PetscCall(Forget(&before));
  PetscFunctionReturn(0);
}
