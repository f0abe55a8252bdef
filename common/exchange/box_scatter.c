#include "common/exchange/box_scatter.h"

PetscErrorCode BoxScatterCreate(MPI_Comm comm, int n, const GeometryBox box[], const GeometryBox bounds[],
                                Scatter *scatter)
{
  PetscMPIInt size;
  int nitems = 0, *to, *row;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_size(comm, &size));
  PetscCall(PetscMalloc2((size_t)n * (size_t)size, &to, (size_t)n * (size_t)size, &row));
  for (int k = 0; k < n; k++)
    for (int p = 0; p < size; p++) {
      if (!GeometryBoxOverlap(&box[k], &bounds[p])) continue;
      to[nitems] = p;
      row[nitems++] = k;
    }
  PetscCall(ScatterDestroy(scatter));
  PetscCall(ScatterCreate(comm, nitems, to, row, scatter));
  PetscCall(PetscFree2(to, row));
  PetscFunctionReturn(0);
}

PetscErrorCode BoxScatterRecords(MPI_Comm comm, int n, const GeometryBox box[], const GeometryBox *bounds,
                                 size_t bytes, const void *record, int *narrived, void **arrived)
{
  GeometryBox *all;
  PetscMPIInt size;
  Scatter scatter = NULL;
  char *in;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_size(comm, &size));
  PetscCall(PetscMalloc1(size, &all));
  PetscCallMPI(MPI_Allgather(bounds, 4, MPI_DOUBLE, all, 4, MPI_DOUBLE, comm));
  PetscCall(BoxScatterCreate(comm, n, box, all, &scatter));
  *narrived = ScatterArriving(scatter);
  PetscCall(PetscMalloc1(bytes * (size_t)*narrived + 1, &in));
  PetscCall(ScatterForward(scatter, bytes, record, in));
  PetscCall(ScatterDestroy(&scatter));
  PetscCall(PetscFree(all));
  *arrived = in;
  PetscFunctionReturn(0);
}
