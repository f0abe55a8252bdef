#include "coupler/geometry/solid_parts.h"
#include "common/exchange/union_find.h"
#include "common/supermesh/geometry.h"

static void Least(void *into, const void *next)
{
  long long *least = into;
  *least = PetscMin(*least, *(const long long *)next);
}

/* label[nnodes]: the least number of the nodes that elements of any rank connect a node with. */
static PetscErrorCode Label(MPI_Comm comm, const SolidState *solid, Copies nodes, long long label[])
{
  int *root, changed = 1;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(solid->nnodes, &root));
  for (int i = 0; i < solid->nnodes; i++) {
    root[i] = i;
    label[i] = solid->gid[i];
  }
  for (int k = 0; k < 3 * solid->nelements; k++)
    (void)UnionFindJoin(root, solid->element[k], solid->element[k - k % 3]);
  while (changed) {
    changed = 0;
    for (int i = 0; i < solid->nnodes; i++) {
      Least(&label[UnionFindRoot(root, i)], &label[i]);
    }
    for (int i = 0; i < solid->nnodes; i++) {
      const long long least = label[UnionFindRoot(root, i)];
      if (label[i] > least) changed = 1;
      label[i] = least;
    }
    PetscCall(CopiesReduce(nodes, sizeof *label, Least, label));
    PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &changed, 1, MPI_INT, MPI_LOR, comm));
  }
  PetscCall(PetscFree(root));
  PetscFunctionReturn(0);
}

PetscErrorCode SolidPartsCreate(MPI_Comm comm, const SolidState *solid, Copies nodes, Copies *parts)
{
  long long *label;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(solid->nnodes, &label));
  PetscCall(Label(comm, solid, nodes, label));
  PetscCall(CopiesCreateByNumber(comm, solid->nnodes, label, parts));
  PetscCall(PetscFree(label));
  PetscFunctionReturn(0);
}

PetscErrorCode SolidPartsAreas(const SolidState *solid, Copies parts, double area[])
{
  PetscFunctionBeginUser;
  PetscCall(PetscArrayzero(area, solid->nnodes));
  for (int e = 0; e < solid->nelements; e++) {
    const int *node = solid->element + 3 * e;
    const double *x = solid->x;
    area[node[0]] += 0.5 * GeometryTurn(x + 2 * node[0], x + 2 * node[1], x + 2 * node[2]);
  }
  PetscCall(CopiesSum(parts, 1, area));
  PetscFunctionReturn(0);
}
