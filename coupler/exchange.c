#include "coupler/exchange.h"

PetscErrorCode ExchangeReceiveSolid(Server server, const CouplerModeTable *mode, SolidState *solid)
{
  ServerSolid s;

  PetscFunctionBeginUser;
  PetscCall(ServerReceiveSolid(server, &s));
  *solid = (SolidState){.changed = s.changed,
                        .lost = s.lost,
                        .start_element = s.before,
                        .pressure_load = s.pressure_load,
                        .nnodes = s.nnodes,
                        .nfacets = s.nfacets,
                        .nelements = s.nelements,
                        .gid = s.gid,
                        .x = s.x,
                        .u = mode->velocity == COUPLER_VELOCITY_MEAN ? s.mean : s.u,
                        .mobility = s.mobility,
                        .acceleration = s.acceleration,
                        .facet = s.facet,
                        .element = s.element};
  PetscFunctionReturn(0);
}

PetscErrorCode ExchangeRequestElements(Server server, const Region region, FluidElements *elements)
{
  ServerElements e;

  PetscFunctionBeginUser;
  PetscCall(ServerAskElements(server, region->nbox, &region->box[0][0][0], &e));
  *elements = (FluidElements){
      e.n, e.x, e.rho, e.mu, e.rho_inside, e.rho_beside, {e.lower[0], e.lower[1]}, {e.upper[0], e.upper[1]}};
  PetscFunctionReturn(0);
}

PetscErrorCode ExchangeSelectFields(Server server, const CouplerOptions *options, const SolidState *solid)
{
  PetscFunctionBeginUser;
  if (CouplerModeGet(options->mode)->needs_pressure || options->uplift || solid->pressure_load)
    PetscCall(ServerNeedPressure(server));
  PetscFunctionReturn(0);
}
