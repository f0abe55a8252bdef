#include "coupler/geometry/solid_parts.h"
#include "common/exchange/union_find.h"
#include "common/supermesh/geometry.h"

/* label[nnodes]: the least number of the nodes that elements of any rank connect a node with. */
static PetscErrorCode Label(MPI_Comm comm, const SolidState *solid, Copies nodes, double label[])
{
  int *root, changed = 1;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(solid->nnodes, &root));
  for (int i = 0; i < solid->nnodes; i++) {
    root[i] = i;
    label[i] = (double)solid->gid[i];
  }
  for (int k = 0; k < 3 * solid->nelements; k++)
    (void)UnionFindJoin(root, solid->element[k], solid->element[k - k % 3]);
  while (changed) {
    changed = 0;
    for (int i = 0; i < solid->nnodes; i++) {
      double *least = &label[UnionFindRoot(root, i)];
      *least = fmin(*least, label[i]);
    }
    for (int i = 0; i < solid->nnodes; i++) {
      const double least = label[UnionFindRoot(root, i)];
      if (label[i] > least) changed = 1;
      label[i] = least;
    }
    PetscCall(CopiesMin(nodes, 1, label));
    PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &changed, 1, MPI_INT, MPI_LOR, comm));
  }
  PetscCall(PetscFree(root));
  PetscFunctionReturn(0);
}

PetscErrorCode SolidPartsCreate(MPI_Comm comm, const SolidState *solid, Copies nodes, Copies *parts)
{
  double *label;
  long long *number;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(solid->nnodes, &label, solid->nnodes, &number));
  PetscCall(Label(comm, solid, nodes, label));
  for (int i = 0; i < solid->nnodes; i++) number[i] = (long long)label[i];
  PetscCall(CopiesCreateByNumber(comm, solid->nnodes, number, parts));
  PetscCall(PetscFree2(label, number));
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
