/* The solid's side of the link: what it sends, what it receives, and the time it waits.
 *
 * The solid registers its nodes and elements with the coupler once, on the ranks where they are then, and nodes again only
 * when cracks make new ones: a mesh of other elements would cost the fluid a step's correction.  When elements change
 * ranks, the node directory brings what is exchanged from the registered ranks to the present ones and back:
 *
 *     coupler  -->  force on registered nodes       -- NodeDirectoryLoad -->     load[nnodes][2]  --> SolidStart
 *     coupler  <--  x, velocity, mobility of these  <-- NodeDirectoryMotion --   SolidView, InterfaceMotion */
#ifndef SOLID_EXCHANGE_H
#define SOLID_EXCHANGE_H
#include "common/link/coracle.h"
#include "solid/ranks/node_directory.h"
#include "solid/solid.h"

typedef struct {
  CoracleClient client;             /* borrowed */
  Solid solid;                      /* borrowed */
  double waited;                    /* seconds within the link since the output is open */
  double dt;                        /* of the step, s */
  NodeDirectory registered, before; /* before: NULL unless this step has registered a new mesh */
  double *load, *film_load,
      *film_resistance; /* [nnodes][2], [2], [4] of the present subdomain, when it is not the registered one */
} Exchange;

/* Gives nodes, surface and volume with their interface motion, binds the state and makes the first exchange.
 * Collective. */
PetscErrorCode ExchangeCreate(CoracleClient client, Solid solid, Exchange *x);
/* Waits for the next step; *load: the force on this rank's nodes, N, borrowed until ExchangeMotion. */
PetscErrorCode ExchangeBegin(Exchange *x, double *dt, CoracleAction *action, const double **load);
/* Sends the new positions. */
PetscErrorCode ExchangeMotion(Exchange *x);
/* Instead of that: the step cannot be made (CoracleRejectStep). */
PetscErrorCode ExchangeReject(Exchange *x, const char *why);
PetscErrorCode ExchangeDestroy(Exchange *x);
#endif
