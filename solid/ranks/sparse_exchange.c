#include "solid/ranks/sparse_exchange.h"

/* What goes to and comes from each rank. */
typedef struct {
  MPI_Comm comm;
  PetscMPIInt size;
  PetscMPIInt *out, *out_start, *in, *in_start; /* [size], [size + 1] */
  int *place;                                   /* [n] of record k among those that go */
} Route;

static PetscErrorCode RouteCreate(MPI_Comm comm, int n, const int to[], Route *r)
{
  PetscFunctionBeginUser;
  r->comm = comm;
  PetscCallMPI(MPI_Comm_size(comm, &r->size));
  const size_t size = (size_t)r->size;
  PetscCall(PetscCalloc5(size, &r->out, size + 1, &r->out_start, size, &r->in, size + 1, &r->in_start,
                         (size_t)n, &r->place));
  for (int k = 0; k < n; k++) r->out[to[k]]++;
  PetscCallMPI(MPI_Alltoall(r->out, 1, MPI_INT, r->in, 1, MPI_INT, comm));
  for (int q = 0; q < r->size; q++) {
    r->out_start[q + 1] = r->out_start[q] + r->out[q];
    r->in_start[q + 1] = r->in_start[q] + r->in[q];
    r->out[q] = 0;
  }
  for (int k = 0; k < n; k++) r->place[k] = r->out_start[to[k]] + r->out[to[k]]++;
  PetscFunctionReturn(0);
}

static PetscErrorCode RouteDestroy(Route *r)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree5(r->out, r->out_start, r->in, r->in_start, r->place));
  PetscFunctionReturn(0);
}

/* Packed records, `bytes` each; back: the other way. */
static PetscErrorCode RouteTravel(const Route *r, size_t bytes, const void *from, void *to, PetscBool back)
{
  MPI_Datatype record;
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Type_contiguous((int)bytes, MPI_BYTE, &record));
  PetscCallMPI(MPI_Type_commit(&record));
  PetscCallMPI(MPI_Alltoallv(from, back ? r->in : r->out, back ? r->in_start : r->out_start, record, to,
                             back ? r->out : r->in, back ? r->out_start : r->in_start, record, r->comm));
  PetscCallMPI(MPI_Type_free(&record));
  PetscFunctionReturn(0);
}

/* packed[place[k]] = record[k] */
static PetscErrorCode RoutePack(const Route *r, int n, size_t bytes, const void *record, char **packed)
{
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1((size_t)n * bytes + 1, packed));
  for (int k = 0; k < n; k++)
    PetscCall(
        PetscMemcpy(*packed + bytes * (size_t)r->place[k], (const char *)record + bytes * (size_t)k, bytes));
  PetscFunctionReturn(0);
}

PetscErrorCode SparseExchange(MPI_Comm comm, int n, const int to[], size_t bytes, const void *record,
                              int *nin, void **in)
{
  Route r;
  char *packed, *received;
  PetscFunctionBeginUser;
  PetscCall(RouteCreate(comm, n, to, &r));
  PetscCall(RoutePack(&r, n, bytes, record, &packed));
  *nin = r.in_start[r.size];
  PetscCall(PetscMalloc1((size_t)*nin * bytes + 1, &received));
  PetscCall(RouteTravel(&r, bytes, packed, received, PETSC_FALSE));
  *in = received;
  PetscCall(PetscFree(packed));
  PetscCall(RouteDestroy(&r));
  PetscFunctionReturn(0);
}

PetscErrorCode SparseExchangeRequest(MPI_Comm comm, int n, const int of[], const long long key[],
                                     size_t bytes, SparseExchangeAnswer answer, void *context, void *record)
{
  Route r;
  char *packed, *given;
  long long *requested;
  PetscFunctionBeginUser;
  PetscCall(RouteCreate(comm, n, of, &r));
  PetscCall(RoutePack(&r, n, sizeof *key, key, &packed));
  const int nrequested = r.in_start[r.size];
  PetscCall(PetscMalloc1((size_t)nrequested + 1, &requested));
  PetscCall(RouteTravel(&r, sizeof *key, packed, requested, PETSC_FALSE));
  PetscCall(PetscFree(packed));
  PetscCall(PetscCalloc1((size_t)nrequested * bytes + 1, &given));
  for (int k = 0; k < nrequested; k++) PetscCall(answer(context, requested[k], given + bytes * (size_t)k));
  PetscCall(PetscMalloc1((size_t)n * bytes + 1, &packed));
  PetscCall(RouteTravel(&r, bytes, given, packed, PETSC_TRUE));
  for (int k = 0; k < n; k++)
    PetscCall(PetscMemcpy((char *)record + bytes * (size_t)k, packed + bytes * (size_t)r.place[k], bytes));
  PetscCall(PetscFree(packed));
  PetscCall(PetscFree(given));
  PetscCall(PetscFree(requested));
  PetscCall(RouteDestroy(&r));
  PetscFunctionReturn(0);
}
