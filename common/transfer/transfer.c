#include "common/transfer/transfer_impl.h"

/* Areas of both meshes on all ranks agree. */
static PetscErrorCode CheckDomain(Transfer t)
{
  const Mesh *mesh[2] = {t->from, t->to};
  double area[2] = {0.0};
  PetscFunctionBeginUser;
  for (int m = 0; m < 2; m++) {
    for (int e = 0; e < mesh[m]->ne; e++) {
      const int *v = &mesh[m]->vertex[3 * e];
      const double *x = mesh[m]->x;
      area[m] += 0.5 * GeometryTurn(&x[2 * v[0]], &x[2 * v[1]], &x[2 * v[2]]);
    }
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, area, 2, MPI_DOUBLE, MPI_SUM, t->comm));
  PetscCheck(fabs(area[1] - area[0]) <= 1e-10 * area[0], t->comm, PETSC_ERR_ARG_INCOMP,
             "the old mesh covers %.15g m2 and the new one %.15g: they are not of the same domain", area[0],
             area[1]);
  PetscFunctionReturn(0);
}

PetscErrorCode TransferCreate(const Mesh *from, const Mesh *to, Transfer *transfer)
{
  Transfer t;
  TransferElements old;
  PetscFunctionBeginUser;
  PetscCall(PetscNew(&t));
  t->comm = to->comm;
  t->from = from;
  t->to = to;
  PetscCall(CheckDomain(t));
  PetscCall(TransferMatch(t, &old));
  PetscCall(TransferMigrate(t, &old));
  PetscCall(TransferElementsDestroy(&old));
  PetscCheck(!ProjectionCreate(t->changed.n, (const double(*)[3][2])t->changed.x, t->search,
                               (const double(*)[3][2])t->moved, &t->projection),
             PETSC_COMM_SELF, PETSC_ERR_MEM, "no memory for the supermesh of %d elements", t->changed.n);
  *transfer = t;
  PetscFunctionReturn(0);
}

PetscErrorCode TransferP1DG(Transfer t, int ncomp, const double source[], double target[])
{
  const size_t n = 3 * (size_t)ncomp;
  double *copy, *moved;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(n * (size_t)t->ncopies, &copy));
  PetscCall(PetscMalloc1(n * (size_t)t->nmoved, &moved));
  PetscCall(ScatterForward(t->copy_scatter, n * sizeof *source, source, copy));
  PetscCall(ScatterForward(t->moved_scatter, n * sizeof *source, source, moved));
  for (int k = 0; k < t->ncopies; k++) {
    const double *from = copy + n * (size_t)k;
    double *to = target + n * (size_t)t->copy[k].target;
    for (int c = 0; c < ncomp; c++) {
      for (int i = 0; i < 3; i++) to[3 * c + i] = from[3 * c + (i + t->copy[k].turn) % 3];
    }
  }
  ProjectionApply(t->projection, ncomp, moved, t->changed.element, target);
  PetscCall(PetscFree(copy));
  PetscCall(PetscFree(moved));
  PetscFunctionReturn(0);
}

PetscErrorCode TransferGetStats(Transfer t, TransferStats *stats)
{
  PetscInt sum[4] = {t->ncopies, t->changed.n, ProjectionPairs(t->projection), t->nmoved};
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sum, 4, MPIU_INT, MPI_SUM, t->comm));
  *stats = (TransferStats){sum[0], sum[1], sum[2], sum[3]};
  PetscFunctionReturn(0);
}

PetscErrorCode TransferDestroy(Transfer *transfer)
{
  Transfer t = *transfer;
  PetscFunctionBeginUser;
  if (!t) PetscFunctionReturn(0);
  PetscCall(ScatterDestroy(&t->copy_scatter));
  PetscCall(ScatterDestroy(&t->moved_scatter));
  PetscCall(PetscFree(t->copy));
  PetscCall(PetscFree(t->moved));
  PetscCall(TransferElementsDestroy(&t->changed));
  SearchDestroy(&t->search);
  ProjectionDestroy(&t->projection);
  PetscCall(PetscFree(*transfer));
  PetscFunctionReturn(0);
}
