/* Elements change ranks.  The new subdomain is taken from the model as the first one was, so that it is intact
 * and at rest; then what has happened since is asked of the ranks that had it (state.h):
 *
 *     damage of joints    of the rank of the joint's first element; cracks are cut again
 *     nodes               of a rank that has them for certain (node_names.h)
 *     slips               to the rank of the edge's element
 *
 * The subdomain before stays as it is while a saved state is in it. */
#include "common/exchange/scatter.h"
#include "solid/ranks/node_names.h"
#include "solid/ranks/state.h"

/* --- the state ---------------------------------------------------------------------------------------- */

/* The subdomain that has it, and the rank that is to have each element. */
typedef struct {
  Solid s;
  const int *part;
} OldPartition;

static PetscErrorCode AnswerJoint(void *joints, long long number, void *record)
{
  const Joints j = joints;
  PetscFunctionBeginUser;
  const int k = JointsFind(j, (int)number);
  PetscCheck(k >= 0, PETSC_COMM_SELF, PETSC_ERR_PLIB, "joint %lld is not here", number);
  PetscCall(PetscMemcpy(record, &j->memory[k], sizeof j->memory[k]));
  PetscFunctionReturn(0);
}

static PetscErrorCode RequestJoints(void *old, Joints j)
{
  const Solid s = ((OldPartition *)old)->s;
  long long *key;
  int *of;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2((size_t)j->n, &key, (size_t)j->n, &of));
  for (int k = 0; k < j->n; k++) {
    key[k] = j->joint[k].number;
    of[k] = s->part[j->joint[k].first];
  }
  PetscCall(ScatterRequest(s->comm, j->n, of, key, sizeof *j->memory, AnswerJoint, s->joints, j->memory));
  PetscCall(PetscFree2(key, of));
  PetscFunctionReturn(0);
}

static PetscErrorCode RequestNodes(void *old, Solid to, NodeState node[])
{
  PetscFunctionBeginUser;
  PetscCall(NodesRequest(((OldPartition *)old)->s, to->nnodes, to->gid, sizeof *node, StateOfNode, node));
  PetscFunctionReturn(0);
}

static PetscErrorCode SendSlips(void *old, Solid to, int *n, Slip **slip)
{
  const OldPartition *from = old;
  Slip *own;
  void *received;
  int nown, *rank;
  PetscFunctionBeginUser;
  PetscCall(StateOfSlips(from->s, &nown, &own));
  PetscCall(PetscMalloc1((size_t)nown, &rank));
  for (int k = 0; k < nown; k++) rank[k] = from->part[own[k].edge / 3];
  PetscCall(ScatterRecords(to->comm, nown, rank, sizeof *own, own, n, &received));
  *slip = received;
  PetscCall(PetscFree(rank));
  PetscCall(PetscFree(own));
  PetscFunctionReturn(0);
}

/* --- the subdomain ------------------------------------------------------------------------------------ */

/* What is the same on all ranks. */
static void TakeTime(const Solid s, Solid fresh)
{
  fresh->h = s->h;
  fresh->dt = s->dt;
  fresh->done = s->done;
  fresh->moved_for = s->moved_for;
  fresh->planned = s->planned;
  fresh->stats = s->stats;
  fresh->budget = s->budget;
  memcpy(fresh->reaction, s->reaction, (size_t)s->nbodies * sizeof *s->reaction);
  memcpy(fresh->momentum, s->momentum, (size_t)s->nbodies * sizeof *s->momentum);
  for (int k = 0; k < s->nmotions; k++)
    memcpy(fresh->motion_impulse[k], s->motion_impulse[k], sizeof s->motion_impulse[k]);
  memcpy(fresh->contact_impulse, s->contact_impulse, sizeof s->contact_impulse);
  fresh->balance = s->balance;
  fresh->model = s->model;
  fresh->before = s->before;
  fresh->kept = s->kept;
  fresh->revision = s->revision;
  fresh->partition_number = s->partition_number + 1;
}

/* The subdomain with everything but `before` freed. */
static PetscErrorCode DestroyOld(Solid *s)
{
  PetscFunctionBeginUser;
  if (*s) PetscCall(SolidFreeSubdomain(*s));
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
  OldPartition old = {s, part};
  const StateSource ranks = {&old, RequestJoints, RequestNodes, SendSlips};
  Solid fresh;
  PetscFunctionBeginUser;
  PetscCheck(s->part || s->size == 1, s->comm, PETSC_ERR_ARG_WRONGSTATE, "the solid has no `rebalance`");
  if (!s->part) PetscFunctionReturn(0);
  PetscCall(PetscNew(&fresh));
  fresh->comm = s->comm;
  fresh->rank = s->rank;
  fresh->size = s->size;
  fresh->setup = s->setup;
  PetscCall(SolidTakeSubdomain(fresh, s->model, part));
  PetscCall(PetscMalloc1((size_t)s->model->nelements, &fresh->part));
  PetscCall(PetscArraycpy(fresh->part, part, (size_t)s->model->nelements));
  PetscCall(ContactCreate(fresh, &fresh->contact));
  TakeTime(s, fresh);
  PetscCall(SolidTakeState(fresh, &ranks));
  fresh->stats.rebalanced++;
  Swap(s, fresh);
  if (s->kept && !s->before)
    s->before = fresh;
  else
    PetscCall(DestroyOld(&fresh));
  PetscFunctionReturn(0);
}

PetscErrorCode SolidKeepSubdomain(Solid s)
{
  PetscFunctionBeginUser;
  PetscCall(DestroyOld(&s->before));
  s->kept = PETSC_TRUE;
  PetscFunctionReturn(0);
}

PetscErrorCode SolidRestoreSubdomain(Solid s)
{
  Solid before = s->before;
  PetscFunctionBeginUser;
  if (!before) PetscFunctionReturn(0);
  before->stats = s->stats;
  Swap(s, before);
  PetscCall(DestroyOld(&before));
  PetscFunctionReturn(0);
}
