#include "route.h"

struct Route_s {
  MPI_Comm comm;
  int size, nsend, nreceive;
  int *count; /* [4][size]: sent, first sent, received, first received, in items */
  int *source;
  char *buffer;
  size_t capacity;
};

static int *Sent(Route r)
{
  return r->count;
}
static int *FirstSent(Route r)
{
  return r->count + r->size;
}
static int *Received(Route r)
{
  return r->count + 2 * r->size;
}
static int *FirstReceived(Route r)
{
  return r->count + 3 * r->size;
}

PetscErrorCode RouteCreate(MPI_Comm comm, int n, const int rank[], const int source[], Route *route)
{
  Route r;
  int *next;

  PetscFunctionBeginUser;
  PetscCall(PetscNew(&r));
  r->comm = comm;
  r->nsend = n;
  PetscCallMPI(MPI_Comm_size(comm, &r->size));
  PetscCall(PetscCalloc1(4 * (size_t)r->size, &r->count));
  PetscCall(PetscMalloc1(n, &r->source));
  PetscCall(PetscMalloc1(r->size, &next));
  for (int k = 0; k < n; k++) Sent(r)[rank[k]]++;
  PetscCallMPI(MPI_Alltoall(Sent(r), 1, MPI_INT, Received(r), 1, MPI_INT, comm));
  for (int p = 0; p + 1 < r->size; p++) {
    FirstSent(r)[p + 1] = FirstSent(r)[p] + Sent(r)[p];
    FirstReceived(r)[p + 1] = FirstReceived(r)[p] + Received(r)[p];
  }
  r->nreceive = FirstReceived(r)[r->size - 1] + Received(r)[r->size - 1];
  PetscCall(PetscArraycpy(next, FirstSent(r), r->size));
  for (int k = 0; k < n; k++) r->source[next[rank[k]]++] = source[k];
  PetscCall(PetscFree(next));
  *route = r;
  PetscFunctionReturn(0);
}

int RouteArriving(Route r)
{
  return r->nreceive;
}

static PetscErrorCode Reserve(Route r, size_t bytes)
{
  PetscFunctionBeginUser;
  if (bytes > r->capacity) {
    PetscCall(PetscFree(r->buffer));
    PetscCall(PetscMalloc1(bytes, &r->buffer));
    r->capacity = bytes;
  }
  PetscFunctionReturn(0);
}

PetscErrorCode RouteForward(Route r, size_t bytes, const void *local, void *there)
{
  MPI_Datatype item;

  PetscFunctionBeginUser;
  PetscCall(Reserve(r, bytes * (size_t)r->nsend));
  for (int k = 0; k < r->nsend; k++) {
    PetscCall(PetscMemcpy(r->buffer + bytes * (size_t)k, (const char *)local + bytes * (size_t)r->source[k],
                          bytes));
  }
  PetscCallMPI(MPI_Type_contiguous((int)bytes, MPI_BYTE, &item));
  PetscCallMPI(MPI_Type_commit(&item));
  PetscCallMPI(MPI_Alltoallv(r->buffer, Sent(r), FirstSent(r), item, there, Received(r), FirstReceived(r),
                             item, r->comm));
  PetscCallMPI(MPI_Type_free(&item));
  PetscFunctionReturn(0);
}

PetscErrorCode RouteReverseAdd(Route r, int ncomp, const double there[], double local[])
{
  MPI_Datatype item;
  double *back;

  PetscFunctionBeginUser;
  PetscCall(Reserve(r, sizeof(double) * (size_t)ncomp * (size_t)r->nsend));
  back = (double *)r->buffer;
  PetscCallMPI(MPI_Type_contiguous(ncomp, MPI_DOUBLE, &item));
  PetscCallMPI(MPI_Type_commit(&item));
  PetscCallMPI(
      MPI_Alltoallv(there, Received(r), FirstReceived(r), item, back, Sent(r), FirstSent(r), item, r->comm));
  PetscCallMPI(MPI_Type_free(&item));
  for (int k = 0; k < r->nsend; k++) {
    double *to = local + (size_t)ncomp * (size_t)r->source[k];
    for (int c = 0; c < ncomp; c++) to[c] += back[(size_t)ncomp * (size_t)k + (size_t)c];
  }
  PetscFunctionReturn(0);
}

PetscErrorCode RouteDestroy(Route *route)
{
  PetscFunctionBeginUser;
  if (!*route) PetscFunctionReturn(0);
  PetscCall(PetscFree((*route)->count));
  PetscCall(PetscFree((*route)->source));
  PetscCall(PetscFree((*route)->buffer));
  PetscCall(PetscFree(*route));
  PetscFunctionReturn(0);
}
