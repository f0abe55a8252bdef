/* The solid's side of the link: what it gives, what it gets, and the time it waits. */
#ifndef SOLID_EXCHANGE_H
#define SOLID_EXCHANGE_H
#include "coracle.h"
#include "solid.h"

typedef struct {
  CoracleClient client; /* borrowed */
  Solid solid;          /* borrowed */
  double waited;        /* seconds within the link */
  double dt;            /* of the step, s */
  int revision;         /* of the mesh that the coupler has */
} Exchange;

/* Gives nodes, surface and volume, binds the state and makes the first exchange.  Collective. */
PetscErrorCode ExchangeCreate(CoracleClient client, Solid solid, Exchange *x);
/* Waits for the next step; *load: the force on this rank's nodes, N, borrowed until ExchangeMotion. */
PetscErrorCode ExchangeBegin(Exchange *x, double *dt, CoracleAction *action, const double **load);
/* Tells of a substep of h seconds. */
PetscErrorCode ExchangeSubstep(Exchange *x, double h);
/* Sends the new positions. */
PetscErrorCode ExchangeMotion(Exchange *x);
#endif
