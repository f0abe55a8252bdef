/* A route: items of local arrays copied to other ranks, and contributions brought back the same way and
 * summed.
 *
 *        home                              there (items in order of the home's rank)
 *        local[source[k]]  -- Forward -->  item
 *        local[source[k]] += item  <-- ReverseAdd --
 *
 * All functions are collective over the communicator given to RouteCreate. */
#ifndef CORACLE_ROUTE_H
#define CORACLE_ROUTE_H
#include <petscsys.h>

typedef struct Route_s *Route;

/* Item k of n is local[source[k]] and goes to rank[k]; the same source may go to several ranks. */
PetscErrorCode RouteCreate(MPI_Comm comm, int n, const int rank[], const int source[], Route *route);
/* Number of items that arrive on this rank. */
int RouteArriving(Route route);
/* there[RouteArriving][bytes] <- local[][bytes] */
PetscErrorCode RouteForward(Route route, size_t bytes, const void *local, void *there);
/* local[][ncomp] += there[RouteArriving][ncomp] */
PetscErrorCode RouteReverseAdd(Route route, int ncomp, const double there[], double local[]);
PetscErrorCode RouteDestroy(Route *route);
#endif
