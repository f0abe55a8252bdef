/* Messages between all ranks whose contents alone decide who talks to whom, and the
 * meeting of ranks that hold the same thing without knowing of each other.  All collective. */
#ifndef CORACLE_MESH_ROUTE_H
#define CORACLE_MESH_ROUTE_H
#include "common/exchange/scatter.h"
#include <petscsys.h>

/* How many items go to and come from each rank; items lie in the order of the ranks. */
typedef struct {
  MPI_Comm comm; /* borrowed */
  int size;
  int *out, *out_start; /* [size], [size + 1] */
  int *in, *in_start;
} MeshRoute;

/* Item i goes to rank to[i]; slot[n], or NULL if `to` ascends, is its place among those that go out. */
PetscErrorCode MeshRouteCreate(MPI_Comm comm, int n, const int to[], int slot[], MeshRoute *route);
PetscErrorCode MeshRouteDestroy(MeshRoute *route);
/* Items of so many bytes: out[out_start[size]] -> in[in_start[size]], and answers the other way. */
PetscErrorCode MeshRouteSend(const MeshRoute *route, size_t bytes, const void *out, void *in);
PetscErrorCode MeshRouteReply(const MeshRoute *route, size_t bytes, const void *in, void *out);

/* A thing, known by a pair of numbers.  Who holds it tells the rank that a hash of the pair names. */
typedef struct {
  long long a, b;
} MeshKey;

typedef struct {
  MeshRoute route;
  int n;      /* keys here */
  int *slot;  /* [n] */
  int *group; /* [in_start[size]] one number for all that hold the same thing */
  int ngroups;
} MeshRendezvous;

/* What those that hold a thing have said of it. */
typedef struct {
  long long lowest, highest, count;
} MeshMet;

PetscErrorCode MeshRendezvousCreate(MPI_Comm comm, int n, const MeshKey key[], MeshRendezvous *r);
PetscErrorCode MeshRendezvousDestroy(MeshRendezvous *r);
PetscErrorCode MeshRendezvousMeet(const MeshRendezvous *r, const long long value[], MeshMet met[]);
#endif
