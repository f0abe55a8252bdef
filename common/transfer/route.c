#include "common/transfer/route.h"
#include "common/mesh/mesh_route.h"

struct Route_s {
  MeshRoute way;
  int *source; /* [way.out_start[size]] in the order of the ranks that they go to */
  char *buffer;
  size_t capacity;
};

PetscErrorCode RouteCreate(MPI_Comm comm, int n, const int rank[], const int source[], Route *route)
{
  Route r;
  int *slot;

  PetscFunctionBeginUser;
  PetscCall(PetscNew(&r));
  PetscCall(PetscMalloc1(n, &r->source));
  PetscCall(PetscMalloc1(n, &slot));
  PetscCall(MeshRouteCreate(comm, n, rank, slot, &r->way));
  for (int k = 0; k < n; k++) r->source[slot[k]] = source[k];
  PetscCall(PetscFree(slot));
  *route = r;
  PetscFunctionReturn(0);
}

int RouteArriving(Route r)
{
  return r->way.in_start[r->way.size];
}

static int Leaving(Route r)
{
  return r->way.out_start[r->way.size];
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
  PetscFunctionBeginUser;
  PetscCall(Reserve(r, bytes * (size_t)Leaving(r)));
  for (int k = 0; k < Leaving(r); k++) {
    PetscCall(PetscMemcpy(r->buffer + bytes * (size_t)k, (const char *)local + bytes * (size_t)r->source[k],
                          bytes));
  }
  PetscCall(MeshRouteSend(&r->way, bytes, r->buffer, there));
  PetscFunctionReturn(0);
}

PetscErrorCode RouteReverseAdd(Route r, int ncomp, const double there[], double local[])
{
  const size_t n = (size_t)ncomp;

  PetscFunctionBeginUser;
  PetscCall(Reserve(r, sizeof(double) * n * (size_t)Leaving(r)));
  double *back = (double *)(void *)r->buffer;
  PetscCall(MeshRouteReply(&r->way, sizeof(double) * n, there, back));
  for (int k = 0; k < Leaving(r); k++) {
    double *to = local + n * (size_t)r->source[k];
    for (int c = 0; c < ncomp; c++) to[c] += back[n * (size_t)k + (size_t)c];
  }
  PetscFunctionReturn(0);
}

PetscErrorCode RouteDestroy(Route *route)
{
  PetscFunctionBeginUser;
  if (!*route) PetscFunctionReturn(0);
  PetscCall(MeshRouteDestroy(&(*route)->way));
  PetscCall(PetscFree((*route)->source));
  PetscCall(PetscFree((*route)->buffer));
  PetscCall(PetscFree(*route));
  PetscFunctionReturn(0);
}
