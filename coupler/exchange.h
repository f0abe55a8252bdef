/* The edge between messages and numerics: receives from the clients (common/link/server.h) and hands the
 * numerics their own structs, which borrow the server's arrays until the next call of the same function.
 * What the coupler sends is sent by time_loop.c with the server's functions.
 *
 *     ServerSolid     -->  SolidState       u is the velocity that the mode couples to
 *     ServerElements  -->  FluidElements    those in the region near the solid
 *
 * All functions are collective; an error of a client ends the job. */
#ifndef CORACLE_EXCHANGE_H
#define CORACLE_EXCHANGE_H
#include "common/link/server.h"
#include "coupler/geometry/fluid_state.h"
#include "coupler/region.h"
#include "coupler/step/mode.h"

/* The solid's mesh at the first call, then its motion over each step. */
PetscErrorCode ExchangeReceiveSolid(Server server, const CouplerModeTable *mode, SolidState *solid);
/* Requests the fluid's elements in the region (set by RegionUpdate). */
PetscErrorCode ExchangeRequestElements(Server server, const Region region, FluidElements *elements);
/* Before the first request of elements: the fluid sends its pressure only if the mode needs it, the solid may touch something, now or once it is
 * released (uplift.h), or it has asked for the pressure's load. */
PetscErrorCode ExchangeSelectFields(Server server, const CouplerOptions *options, const SolidState *solid);
#endif
