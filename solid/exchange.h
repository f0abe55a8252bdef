/* The solid's side of the link: what it gives, what it gets, and the time it waits.  The coupler knows the
 * nodes on the ranks where they were when it was told of the mesh; when elements change ranks it need not
 * know (a new mesh costs the fluid a step's correction): positions, velocities and forces then travel between
 * the present subdomain and the one that was told, until cracks make a new mesh. */
#ifndef SOLID_EXCHANGE_H
#define SOLID_EXCHANGE_H
#include "common/link/coracle.h"
#include "solid/solid.h"

/* This rank's mesh as the coupler knows it. */
typedef struct {
  int n, partition, revision;
  long long *gid; /* [n] */
} RegisteredMesh;

typedef struct {
  CoracleClient client;              /* borrowed */
  Solid solid;                       /* borrowed */
  double waited;                     /* seconds within the link */
  double dt;                         /* of the step, s */
  RegisteredMesh registered, before; /* before: gid is NULL unless this step has told of a new mesh */
  PetscBool remote;                  /* the step has begun on another share than the one told */
  double *load;                      /* [nnodes][2] of the present subdomain, when away */
} Exchange;

/* Gives nodes, surface and volume with what was seen last, binds the state and makes the first exchange.
 * Collective. */
PetscErrorCode ExchangeCreate(CoracleClient client, Solid solid, Exchange *x);
/* Waits for the next step; *load: the force on this rank's nodes, N, borrowed until ExchangeMotion. */
PetscErrorCode ExchangeBegin(Exchange *x, double *dt, CoracleAction *action, const double **load);
/* Tells of a substep of h seconds. */
PetscErrorCode ExchangeSubstep(Exchange *x, double h);
/* Sends the new positions. */
PetscErrorCode ExchangeMotion(Exchange *x);
PetscErrorCode ExchangeDestroy(Exchange *x);
#endif
