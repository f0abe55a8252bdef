#include "solid/ranks/node_directory.h"
#include "solid/ranks/node_names.h"
#include "solid/solid_impl.h"

struct NodeDirectory_s {
  Solid s; /* borrowed */
  int n, partition, revision;
  long long *gid; /* [n] */
};

PetscErrorCode NodeDirectoryCreate(Solid s, NodeDirectory *directory)
{
  NodeDirectory d;
  PetscFunctionBeginUser;
  PetscCall(PetscNew(&d));
  d->s = s;
  d->n = s->nnodes;
  d->partition = s->partition_number;
  d->revision = s->revision;
  PetscCall(PetscMalloc1((size_t)d->n, &d->gid));
  PetscCall(PetscArraycpy(d->gid, s->gid, (size_t)d->n));
  *directory = d;
  PetscFunctionReturn(0);
}

PetscErrorCode NodeDirectoryDestroy(NodeDirectory *directory)
{
  PetscFunctionBeginUser;
  if (!*directory) PetscFunctionReturn(0);
  PetscCall(PetscFree((*directory)->gid));
  PetscCall(PetscFree(*directory));
  PetscFunctionReturn(0);
}

int NodeDirectorySize(NodeDirectory d)
{
  return d->n;
}

PetscBool NodeDirectoryIsPresent(NodeDirectory d)
{
  return (PetscBool)(d->partition == d->s->partition_number);
}

PetscBool NodeDirectoryIsComplete(NodeDirectory d)
{
  return (PetscBool)(d->revision == d->s->revision);
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

PetscErrorCode NodeDirectoryMotion(NodeDirectory d, NodeMotion motion[])
{
  PetscFunctionBeginUser;
  PetscCall(NodesRequest(d->s, d->n, d->gid, sizeof *motion, AnswerMotion, motion));
  PetscFunctionReturn(0);
}

typedef struct {
  long long gid;
  double load[2];
} NodeLoad;

PetscErrorCode NodeDirectoryLoad(NodeDirectory d, const double load[], double present[])
{
  NodeNames names;
  NodeLoad *out, *in;
  void *received;
  int *of, nin;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2((size_t)d->n, &of, (size_t)d->n, &out));
  PetscCall(NodeRanks(d->s, d->n, d->gid, of));
  for (int k = 0; k < d->n; k++) out[k] = (NodeLoad){d->gid[k], {load[2 * k], load[2 * k + 1]}};
  PetscCall(ScatterRecords(d->s->comm, d->n, of, sizeof *out, out, &nin, &received));
  in = received;
  PetscCall(NodeNamesCreate(d->s, &names));
  PetscCall(PetscArrayzero(present, 2 * (size_t)d->s->nnodes));
  for (int k = 0; k < nin; k++) {
    const int node = NodeNamesFind(&names, in[k].gid);
    PetscCheck(node >= 0, PETSC_COMM_SELF, PETSC_ERR_PLIB, "node %lld is not here", in[k].gid);
    for (int c = 0; c < 2; c++) present[2 * node + c] += in[k].load[c];
  }
  PetscCall(NodeNamesDestroy(&names));
  PetscCall(PetscFree(in));
  PetscCall(PetscFree2(of, out));
  PetscFunctionReturn(0);
}
