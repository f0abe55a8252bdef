/* Elements change ranks.  The new share is taken from the assembly as the first one was, so that it is whole
 * and at rest; then what has happened since is asked of the ranks that had it:
 *
 *     damage of joints    of the rank of the joint's first element; cracks are cut again, and by the numbers
 *                         of their corners the parts of nodes get the gid that they had (joints_impl.h)
 *     nodes               x, v, .. by gid, of a rank that has them for certain (abroad.h)
 *     slips               to the rank of the edge's element, by its number in the assembly
 *
 * The share before stays as it is while a saved state is in it. */
#include "abroad.h"
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

static PetscErrorCode TakeJoints(Solid s, Solid fresh)
{
  const Joints j = fresh->joints;
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
  JointsReplay(j, fresh);
  PetscFunctionReturn(0);
}

/* --- nodes
 * -------------------------------------------------------------------------------------------------- */

typedef struct {
  double x[2], v[2], start[2], load[2];
} NodeState;

static void AnswerNode(const Solid s, int n, void *record)
{
  NodeState *to = record;
  for (int c = 0; c < 2; c++) {
    to->x[c] = s->x[2 * n + c];
    to->v[c] = s->v[2 * n + c];
    to->start[c] = s->start[2 * n + c];
    to->load[c] = s->load[2 * n + c];
  }
}

static PetscErrorCode TakeNodes(Solid s, Solid fresh)
{
  NodeState *state;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1((size_t)fresh->nnodes, &state));
  PetscCall(NodesAsk(s, fresh->nnodes, fresh->gid, sizeof *state, AnswerNode, state));
  for (int k = 0; k < 2 * fresh->nnodes; k++) {
    const NodeState *from = &state[k / 2];
    fresh->x[k] = from->x[k % 2];
    fresh->v[k] = from->v[k % 2];
    fresh->start[k] = from->start[k % 2];
    fresh->load[k] = from->load[k % 2];
  }
  PetscCall(PetscFree(state));
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
static PetscErrorCode TakeSlips(Solid s, Solid fresh, const int part[])
{
  const Slips *h;
  const Elements *e = &fresh->elements;
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
  PetscCall(ContactTakeSlips(fresh->contact, n, in));
  PetscCall(PetscFree2(out, to));
  PetscCall(PetscFree(in));
  PetscFunctionReturn(0);
}

/* --- the share
 * ---------------------------------------------------------------------------------------------- */

/* What is the same on all ranks. */
static void TakeTime(const Solid s, Solid fresh)
{
  fresh->h = s->h;
  fresh->dt = s->dt;
  fresh->done = s->done;
  fresh->moved_for = s->moved_for;
  fresh->stats = s->stats;
  fresh->budget = s->budget;
  fresh->balance = s->balance;
  fresh->assembly = s->assembly;
  fresh->before = s->before;
  fresh->kept = s->kept;
  fresh->revision = s->revision;
  fresh->share_number = s->share_number + 1;
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
  Solid fresh;
  PetscFunctionBeginUser;
  PetscCheck(s->part || s->size == 1, s->comm, PETSC_ERR_ARG_WRONGSTATE, "the solid has no `rebalance`");
  if (!s->part) PetscFunctionReturn(0);
  PetscCall(PetscNew(&fresh));
  fresh->comm = s->comm;
  fresh->rank = s->rank;
  fresh->size = s->size;
  fresh->setup = s->setup;
  PetscCall(SolidTakeShare(fresh, s->assembly, part));
  PetscCall(PetscMalloc1((size_t)s->assembly->nelements, &fresh->part));
  PetscCall(PetscArraycpy(fresh->part, part, (size_t)s->assembly->nelements));
  PetscCall(ContactCreate(fresh, &fresh->contact));
  PetscCall(TakeJoints(s, fresh));
  PetscCall(TakeNodes(s, fresh));
  PetscCall(TakeSlips(s, fresh, part));
  TakeTime(s, fresh);
  if (fresh->joints)
    PetscCall(JointsSettle(fresh->joints, fresh));
  else
    PetscCall(ContactSearch(fresh->contact, fresh, 0.0));
  fresh->stats.rebalanced++;
  Swap(s, fresh);
  if (s->kept && !s->before)
    s->before = fresh;
  else
    PetscCall(Forget(&fresh));
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
