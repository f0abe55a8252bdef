/* The state in a checkpoint.  It comes from the file as it comes from other ranks when elements change ranks
 * (migrate.c).  The rows of a table have keys and values; each is there once, in any order:
 *
 *     element    number in the model, rank          the subdomain that was
 *     node       gid                                   NodeState
 *     joint      number, since (JointMemory)           both ends; of joints that are not intact
 *     spring     3 element + side, other, material     slip */
#include "solid/ranks/node_names.h"
#include "solid/ranks/state.h"

enum { PIECE = 1 << 15, MAX_KEYS = 3 }; /* rows that are read at a time */

typedef struct {
  const char *keys, *values; /* names of the two datasets */
  int nkeys, nvalues;        /* long long and double in a row */
} Table;

static const Table ELEMENTS = {"element", NULL, 2, 0};
static const Table NODES = {"node", "node state", 1, sizeof(NodeState) / sizeof(double)};
static const Table JOINTS = {"joint", "joint ends", MAX_KEYS, 2 * sizeof(JointEnd) / sizeof(double)};
static const Table SPRINGS = {"spring", "spring slip", MAX_KEYS, 1};

static PetscErrorCode PutRows(Checkpoint to, const Table *t, int n, const long long key[], const void *value)
{
  PetscFunctionBeginUser;
  PetscCall(CheckpointPutIndices(to, t->keys, n, t->nkeys, key));
  if (t->values) PetscCall(CheckpointPutDoubles(to, t->values, n, t->nvalues, value));
  PetscFunctionReturn(0);
}

typedef void (*RowTaker)(void *context, const long long key[], const double value[]);

/* Every rank reads all rows, a block at a time, and takes what it needs. */
static PetscErrorCode GetRows(Checkpoint from, const Table *t, RowTaker take, void *context)
{
  long long total, *key;
  double *value;
  PetscFunctionBeginUser;
  PetscCall(CheckpointRows(from, t->keys, &total));
  PetscCall(PetscMalloc2((size_t)PIECE * (size_t)t->nkeys, &key, (size_t)PIECE * (size_t)t->nvalues, &value));
  for (long long start = 0; start < total; start += PIECE) {
    const int n = (int)PetscMin(PIECE, total - start);
    PetscCall(CheckpointGetIndices(from, t->keys, start, n, t->nkeys, key));
    if (t->values) PetscCall(CheckpointGetDoubles(from, t->values, start, n, t->nvalues, value));
    for (int k = 0; k < n; k++) take(context, key + k * t->nkeys, value + k * t->nvalues);
  }
  PetscCall(PetscFree2(key, value));
  PetscFunctionReturn(0);
}

/* --- the subdomain ------------------------------------------------------------------------------------ */

static PetscErrorCode PutElements(Solid s, Checkpoint to)
{
  const Elements *e = &s->elements;
  long long *key;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(2 * (size_t)e->n, &key));
  for (int k = 0; k < e->n; k++) {
    key[2 * k] = e->number[k];
    key[2 * k + 1] = s->rank;
  }
  PetscCall(PutRows(to, &ELEMENTS, e->n, key, NULL));
  PetscCall(PetscFree(key));
  PetscFunctionReturn(0);
}

static void TakeRank(void *part, const long long key[], const double value[])
{
  (void)value;
  ((int *)part)[key[0]] = (int)key[1];
}

PetscErrorCode StateTakePartition(Solid s, Checkpoint from)
{
  const size_t n = (size_t)s->global.elements;
  PetscBool same;
  int *part;
  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(n, &part));
  PetscCall(GetRows(from, &ELEMENTS, TakeRank, part));
  PetscCall(PetscArraycmp(part, s->part, n, &same));
  if (!same) PetscCall(SolidRedistribute(s, part));
  PetscCall(PetscFree(part));
  PetscFunctionReturn(0);
}

/* --- nodes -------------------------------------------------------------------------------------------- */

static PetscErrorCode PutNodes(Solid s, Checkpoint to)
{
  long long *gid;
  NodeState *state;
  int n = 0;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2((size_t)s->nnodes, &gid, (size_t)s->nnodes, &state));
  for (int i = 0; i < s->nnodes; i++) {
    if (!SolidOwns(s, i)) continue;
    gid[n] = s->gid[i];
    StateOfNode(s, i, &state[n++]);
  }
  PetscCall(PutRows(to, &NODES, n, gid, state));
  PetscCall(PetscFree2(gid, state));
  PetscFunctionReturn(0);
}

typedef struct {
  NodeNames names;
  NodeState *node;
  int found;
} FoundNodes;

static void TakeNode(void *found, const long long key[], const double value[])
{
  FoundNodes *f = found;
  const int n = NodeNamesFind(&f->names, key[0]);
  if (n < 0) return;
  memcpy(&f->node[n], value, sizeof f->node[n]);
  f->found++;
}

static PetscErrorCode GetNodes(void *checkpoint, Solid to, NodeState node[])
{
  FoundNodes f = {.node = node};
  PetscFunctionBeginUser;
  PetscCall(NodeNamesCreate(to->nnodes, to->gid, &f.names));
  PetscCall(GetRows(checkpoint, &NODES, TakeNode, &f));
  PetscCall(NodeNamesDestroy(&f.names));
  PetscCheck(f.found == to->nnodes, PETSC_COMM_SELF, PETSC_ERR_FILE_UNEXPECTED,
             "%s/solid.h5 has %d of %d nodes", CheckpointFolder(checkpoint), f.found, to->nnodes);
  PetscFunctionReturn(0);
}

/* --- joints ------------------------------------------------------------------------------------------- */

static PetscErrorCode PutJoints(Solid s, Checkpoint to)
{
  const Joints j = s->joints;
  long long *key;
  JointEnd(*end)[2];
  int n = 0;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(MAX_KEYS * (size_t)j->n, &key, (size_t)j->n, &end));
  for (int k = 0; k < j->n; k++) {
    const JointMemory *m = &j->memory[k];
    if (!j->joint[k].mine || m->stage == JOINT_INTACT) continue;
    key[MAX_KEYS * n] = j->joint[k].number;
    for (int i = 0; i < 2; i++) {
      key[MAX_KEYS * n + 1 + i] = m->since[i];
      end[n][i] = m->end[i];
    }
    n++;
  }
  PetscCall(PutRows(to, &JOINTS, n, key, end));
  PetscCall(PetscFree2(key, end));
  PetscFunctionReturn(0);
}

static void TakeJoint(void *joints, const long long key[], const double value[])
{
  const Joints j = joints;
  const int k = JointsFind(j, (int)key[0]);
  if (k < 0) return;
  for (int i = 0; i < 2; i++) j->memory[k].since[i] = (int)key[1 + i];
  memcpy(j->memory[k].end, value, sizeof j->memory[k].end);
}

static PetscErrorCode GetJoints(void *checkpoint, Joints j)
{
  return GetRows(checkpoint, &JOINTS, TakeJoint, j);
}

/* --- springs of friction ------------------------------------------------------------------------------ */

static PetscErrorCode PutSlips(Solid s, Checkpoint to)
{
  Slip *slip;
  long long *key;
  double *value;
  int n;
  PetscFunctionBeginUser;
  PetscCall(StateOfSlips(s, &n, &slip));
  PetscCall(PetscMalloc2(MAX_KEYS * (size_t)n, &key, (size_t)n, &value));
  for (int k = 0; k < n; k++) {
    key[MAX_KEYS * k] = slip[k].edge;
    key[MAX_KEYS * k + 1] = slip[k].other;
    key[MAX_KEYS * k + 2] = slip[k].material;
    value[k] = slip[k].slip;
  }
  PetscCall(PutRows(to, &SPRINGS, n, key, value));
  PetscCall(PetscFree2(key, value));
  PetscCall(PetscFree(slip));
  PetscFunctionReturn(0);
}

typedef struct {
  Solid to;
  int n;
  Slip *slip;
} FoundSlips;

static void TakeSlip(void *found, const long long key[], const double value[])
{
  FoundSlips *f = found;
  if (StateElement(f->to, key[0] / 3) >= 0)
    f->slip[f->n++] = (Slip){(int)key[0], (int)key[1], (int)key[2], value[0]};
}

static PetscErrorCode GetSlips(void *checkpoint, Solid to, int *n, Slip **slip)
{
  FoundSlips f = {.to = to};
  long long total;
  PetscFunctionBeginUser;
  PetscCall(CheckpointRows(checkpoint, SPRINGS.keys, &total));
  PetscCall(PetscMalloc1((size_t)total, &f.slip));
  PetscCall(GetRows(checkpoint, &SPRINGS, TakeSlip, &f));
  *n = f.n;
  *slip = f.slip;
  PetscFunctionReturn(0);
}

/* --- all ---------------------------------------------------------------------------------------------- */

PetscErrorCode StateToFile(Solid s, Checkpoint to)
{
  PetscFunctionBeginUser;
  PetscCall(PutElements(s, to));
  PetscCall(PutNodes(s, to));
  if (s->joints) PetscCall(PutJoints(s, to));
  PetscCall(PutSlips(s, to));
  PetscFunctionReturn(0);
}

StateSource StateFromFile(Checkpoint from)
{
  return (StateSource){from, GetJoints, GetNodes, GetSlips};
}
