#include "common/mesh/mesh_route.h"
#include <stdint.h>
#include <string.h>

static void Starts(int n, const int count[], int start[])
{
  start[0] = 0;
  for (int r = 0; r < n; r++) start[r + 1] = start[r] + count[r];
}

PetscErrorCode MeshRouteCreate(MPI_Comm comm, int n, const int to[], int slot[], MeshRoute *route)
{
  int *next;
  PetscFunctionBeginUser;
  route->comm = comm;
  PetscCallMPI(MPI_Comm_size(comm, &route->size));
  PetscCall(PetscCalloc1(route->size, &route->out));
  PetscCall(PetscMalloc1(route->size, &route->in));
  PetscCall(PetscMalloc2(route->size + 1, &route->out_start, route->size + 1, &route->in_start));
  for (int i = 0; i < n; i++) route->out[to[i]]++;
  PetscCallMPI(MPI_Alltoall(route->out, 1, MPI_INT, route->in, 1, MPI_INT, comm));
  Starts(route->size, route->out, route->out_start);
  Starts(route->size, route->in, route->in_start);
  if (!slot) PetscFunctionReturn(0);
  PetscCall(PetscMalloc1(route->size, &next));
  PetscCall(PetscArraycpy(next, route->out_start, route->size));
  for (int i = 0; i < n; i++) slot[i] = next[to[i]]++;
  PetscCall(PetscFree(next));
  PetscFunctionReturn(0);
}

PetscErrorCode MeshRouteDestroy(MeshRoute *route)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(route->out));
  PetscCall(PetscFree(route->in));
  PetscCall(PetscFree2(route->out_start, route->in_start));
  PetscFunctionReturn(0);
}

PetscErrorCode MeshRouteSend(const MeshRoute *route, size_t bytes, const void *out, void *in)
{
  MPI_Datatype item;
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Type_contiguous((int)bytes, MPI_BYTE, &item));
  PetscCallMPI(MPI_Type_commit(&item));
  PetscCallMPI(MPI_Alltoallv(out, route->out, route->out_start, item, in, route->in, route->in_start, item,
                             route->comm));
  PetscCallMPI(MPI_Type_free(&item));
  PetscFunctionReturn(0);
}

PetscErrorCode MeshRouteReply(const MeshRoute *route, size_t bytes, const void *in, void *out)
{
  const MeshRoute back = {route->comm, route->size, route->in, route->in_start, route->out, route->out_start};
  PetscFunctionBeginUser;
  PetscCall(MeshRouteSend(&back, bytes, in, out));
  PetscFunctionReturn(0);
}

typedef struct {
  MeshKey key;
  int place;
} Arrival;

static int ByKey(const void *p, const void *q)
{
  const Arrival *a = p, *b = q;
  if (a->key.a != b->key.a) return a->key.a < b->key.a ? -1 : 1;
  return (a->key.b > b->key.b) - (a->key.b < b->key.b);
}

/* One number for equal keys. */
static PetscErrorCode Group(int n, const MeshKey key[], int group[], int *ngroups)
{
  Arrival *arrival;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(n, &arrival));
  for (int i = 0; i < n; i++) arrival[i] = (Arrival){key[i], i};
  if (n) qsort(arrival, (size_t)n, sizeof *arrival, ByKey);
  *ngroups = 0;
  for (int i = 0; i < n; i++) {
    if (i == 0 || ByKey(&arrival[i - 1], &arrival[i])) (*ngroups)++;
    group[arrival[i].place] = *ngroups - 1;
  }
  PetscCall(PetscFree(arrival));
  PetscFunctionReturn(0);
}

/* The rank where those with a key meet: the high bits of a product (Fibonacci hashing). */
static int Place(MeshKey key, int size)
{
  uint64_t h = (uint64_t)key.a * UINT64_C(0x9E3779B97F4A7C15);
  h = (h ^ h >> 32 ^ (uint64_t)key.b) * UINT64_C(0xD6E8FEB86659FD93);
  return (int)((h >> 32) % (uint64_t)size);
}

PetscErrorCode MeshRendezvousCreate(MPI_Comm comm, int n, const MeshKey key[], MeshRendezvous *r)
{
  int size, *to;
  MeshKey *out, *in;
  PetscFunctionBeginUser;
  r->n = n;
  PetscCallMPI(MPI_Comm_size(comm, &size));
  PetscCall(PetscMalloc1(n, &r->slot));
  PetscCall(PetscMalloc2(n, &to, n, &out));
  for (int i = 0; i < n; i++) to[i] = Place(key[i], size);
  PetscCall(MeshRouteCreate(comm, n, to, r->slot, &r->route));
  for (int i = 0; i < n; i++) out[r->slot[i]] = key[i];
  const int arrived = r->route.in_start[size];
  PetscCall(PetscMalloc1(arrived, &in));
  PetscCall(PetscMalloc1(arrived, &r->group));
  PetscCall(MeshRouteSend(&r->route, sizeof *in, out, in));
  PetscCall(Group(arrived, in, r->group, &r->ngroups));
  PetscCall(PetscFree2(to, out));
  PetscCall(PetscFree(in));
  PetscFunctionReturn(0);
}

PetscErrorCode MeshRendezvousDestroy(MeshRendezvous *r)
{
  PetscFunctionBeginUser;
  PetscCall(MeshRouteDestroy(&r->route));
  PetscCall(PetscFree(r->slot));
  PetscCall(PetscFree(r->group));
  PetscFunctionReturn(0);
}

PetscErrorCode MeshRendezvousMeet(const MeshRendezvous *r, const long long value[], MeshMet met[])
{
  const int arrived = r->route.in_start[r->route.size];
  long long *out, *in;
  MeshMet *all, *answer, *back;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc5(r->n, &out, arrived, &in, r->ngroups, &all, arrived, &answer, r->n, &back));
  for (int i = 0; i < r->n; i++) out[r->slot[i]] = value[i];
  PetscCall(MeshRouteSend(&r->route, sizeof *in, out, in));
  for (int g = 0; g < r->ngroups; g++) all[g] = (MeshMet){INT64_MAX, INT64_MIN, 0};
  for (int k = 0; k < arrived; k++) {
    MeshMet *m = &all[r->group[k]];
    m->lowest = PetscMin(m->lowest, in[k]);
    m->highest = PetscMax(m->highest, in[k]);
    m->count++;
  }
  for (int k = 0; k < arrived; k++) answer[k] = all[r->group[k]];
  PetscCall(MeshRouteReply(&r->route, sizeof *answer, answer, back));
  for (int i = 0; i < r->n; i++) met[i] = back[r->slot[i]];
  PetscCall(PetscFree5(out, in, all, answer, back));
  PetscFunctionReturn(0);
}
