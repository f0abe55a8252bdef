/* The fluid's side of the link: which elements are near the solid, and the fields that travel for them.
 *
 *     ExchangeCreate           elements near the solid, rho, mu           -->  first coupling
 *     ExchangeReceiveCoupling  a, s, ... of the coming step               -->  FluidSetCoupling
 *     ExchangeFlow             u*, u projected, rho, mu (, p) of the step -->  correction, or: to be redone
 *     ExchangeReject           in its place: why the step cannot be made  -->  to be redone, shorter */
#ifndef FLUID_EXCHANGE_H
#define FLUID_EXCHANGE_H
#include "fluid/flow/fluid.h"

typedef struct Exchange_s *Exchange;

/* Registers the fluid with the client and makes the first exchange.  Both are borrowed.  Collective. */
PetscErrorCode ExchangeCreate(CoracleClient client, Fluid fluid, Exchange *x);
/* Hands the coupling of the coming step to the fluid. */
PetscErrorCode ExchangeReceiveCoupling(Exchange x);
/* Sends the flow near the solid and waits for the solid.  *accepted: the step is complete, else it will be
 * redone; *correction: of the fluid inside the solid, borrowed.  next: the fluid on another mesh that takes
 * over if the step is accepted (borrowed), or NULL when the mesh stays. */
PetscErrorCode ExchangeFlow(Exchange x, Fluid next, PetscBool *accepted,
                            const CoracleCorrection **correction);
/* Instead of that: the step cannot be made (CoracleRejectStep). */
PetscErrorCode ExchangeReject(Exchange x, const char *why);
PetscErrorCode ExchangeDestroy(Exchange *x);
#endif
