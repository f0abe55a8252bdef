/* The fluid's side of the link: which elements are near the solid, and what travels for them. */
#ifndef FLUID_EXCHANGE_H
#define FLUID_EXCHANGE_H
#include "fluid/fluid.h"

typedef struct Exchange_s *Exchange;

/* Called once, when the boxes around the solid, box[nbox][2][2], are first known: may put another fluid, on a
 * mesh that is finer there, in the place of *fluid. */
typedef PetscErrorCode (*ExchangeFirst)(void *context, int nbox, const double box[], Fluid *fluid);

/* Registers the fluid with the client and makes the first exchange; first may be NULL.  All are borrowed.
 * Collective. */
PetscErrorCode ExchangeCreate(CoracleClient client, Fluid fluid, ExchangeFirst first, void *context,
                              Exchange *x);
/* Hands the coupling of the coming step to the fluid. */
PetscErrorCode ExchangeReceiveCoupling(Exchange x);
/* Sends u*, u+, p, mu near the solid, waits for the solid, and returns what corrects the inside
 * (borrowed), or that the step does not stand: it will be redone. next: the fluid on another mesh that
 * goes on if it stands (borrowed), or NULL when the mesh stays. */
PetscErrorCode ExchangeFlow(Exchange x, Fluid next, PetscBool *accepted,
                            const CoracleCorrection **correction);
PetscErrorCode ExchangeDestroy(Exchange *x);
#endif
