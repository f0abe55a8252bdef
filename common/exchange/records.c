/* Exchanges that are made once: records, requests, errors. */
#include "common/exchange/scatter.h"

PetscErrorCode ScatterRecords(MPI_Comm comm, int n, const int to[], size_t bytes, const void *record,
                              int *narrived, void **arrived)
{
  Scatter e;
  char *in;
  PetscFunctionBeginUser;
  PetscCall(ScatterCreate(comm, n, to, NULL, &e));
  *narrived = ScatterArriving(e);
  PetscCall(PetscMalloc1(bytes * (size_t)ScatterArriving(e) + 1, &in));
  PetscCall(ScatterForward(e, bytes, record, in));
  PetscCall(ScatterDestroy(&e));
  *arrived = in;
  PetscFunctionReturn(0);
}

PetscErrorCode ScatterRequest(MPI_Comm comm, int n, const int of[], const long long key[], size_t bytes,
                              ScatterAnswer answer, void *context, void *record)
{
  Scatter e;
  long long *asked;
  char *answers;
  PetscFunctionBeginUser;
  PetscCall(ScatterCreate(comm, n, of, NULL, &e));
  PetscCall(PetscMalloc1(ScatterArriving(e), &asked));
  PetscCall(PetscCalloc1(bytes * (size_t)ScatterArriving(e) + 1, &answers));
  PetscCall(ScatterForward(e, sizeof *key, key, asked));
  for (int k = 0; k < ScatterArriving(e); k++)
    PetscCall(answer(context, asked[k], answers + bytes * (size_t)k));
  PetscCall(ScatterReverse(e, bytes, answers, record));
  PetscCall(PetscFree(asked));
  PetscCall(PetscFree(answers));
  PetscCall(ScatterDestroy(&e));
  PetscFunctionReturn(0);
}

PetscErrorCode GatherRecords(MPI_Comm comm, int n, size_t bytes, const void *record, int *total, void **all)
{
  PetscMPIInt size, *count, *start;
  MPI_Datatype type;
  char *gathered;
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_size(comm, &size));
  PetscCall(PetscMalloc2(size, &count, size + 1, &start));
  PetscCallMPI(MPI_Allgather(&n, 1, MPI_INT, count, 1, MPI_INT, comm));
  start[0] = 0;
  for (int r = 0; r < size; r++) start[r + 1] = start[r] + count[r];
  *total = start[size];
  PetscCall(PetscMalloc1(bytes * (size_t)*total + 1, &gathered));
  PetscCallMPI(MPI_Type_contiguous((int)bytes, MPI_BYTE, &type));
  PetscCallMPI(MPI_Type_commit(&type));
  PetscCallMPI(MPI_Allgatherv(record, n, type, gathered, count, start, type, comm));
  PetscCallMPI(MPI_Type_free(&type));
  PetscCall(PetscFree2(count, start));
  *all = gathered;
  PetscFunctionReturn(0);
}

PetscErrorCode CollectiveError(MPI_Comm comm, PetscErrorCode here)
{
  int all = (int)here;
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &all, 1, MPI_INT, MPI_MAX, comm));
  PetscFunctionReturn(here ? here : (PetscErrorCode)all);
}
