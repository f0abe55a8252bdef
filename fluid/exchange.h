/* The fluid's side of the link: which elements are near the solid, and what travels for them. */
#ifndef FLUID_EXCHANGE_H
#define FLUID_EXCHANGE_H
#include "fluid.h"

typedef struct Exchange_s *Exchange;

/* Registers the fluid with the client and makes the first exchange.  Both are borrowed.  Collective. */
PetscErrorCode ExchangeCreate(CoracleClient client, Fluid fluid, Exchange *x);
/* Hands the coupling of the coming step to the fluid. */
PetscErrorCode ExchangeReceiveCoupling(Exchange x);
/* Sends u*, u+, p, mu near the solid, waits for the solid, and returns what corrects the inside (borrowed).
 * next: the fluid on another mesh that goes on after this step (borrowed), or NULL when the mesh stays. */
PetscErrorCode ExchangeFlow(Exchange x, Fluid next, const CoracleCorrection **correction);
PetscErrorCode ExchangeDestroy(Exchange *x);
#endif
