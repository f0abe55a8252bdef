/* Mode penalty_shell (Vire, Xiang, Pain 2015; the paper's Af20 rows): a = rho_f / dt I in the shell, nothing
 * in the volume.
 *
 * Force: the reaction to the penalty is the one conservative part, and it goes to the solid as it is.  The
 * fluid inside is free and carries its own share of the pressure, which the thin shell's reaction does not
 * see; so the pressure's load is the surface integral of -p n.  Gravity and inertia of the inside need no
 * term of their own: total pressure brings buoyancy. */
#include "coupler_impl.h"

static PetscErrorCode Weigh(Coupler c, const ServerSolid *solid)
{
  const Overlap o = c->overlap;

  PetscFunctionBeginUser;
  for (int p = 0; p < o->pairs.n; p++) {
    const SupermeshPair *pair = &o->pairs.pair[p];
    c->weight[p] = WallWeightIsotropic(o->piece[pair->a].is_shell ? o->rho[pair->b] / c->dt : 0.0);
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode React(Coupler c)
{
  PetscFunctionBeginUser;
  ForceReaction(c->overlap, c->weight, c->firmness, &c->flow, c->vertex);
  PetscCall(ForceBringHome(c->overlap, c->vertex, c->nnodes, c->node));
  PetscCall(CouplerAddSurfacePressure(c));
  PetscFunctionReturn(0);
}

const CouplerActions COUPLER_ACTIONS_PENALTY_SHELL = {Weigh, React, CouplerLeaveFluid};
