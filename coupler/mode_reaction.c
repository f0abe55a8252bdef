/* Mode reaction: sigma in the solid's volume, the wall term in its shell, and the force as the reaction to
 * both. */
#include "coupler/coupler_impl.h"
#include "coupler/inertia.h"

static PetscErrorCode Weigh(Coupler c, const ServerSolid *solid)
{
  const Overlap o = c->overlap;

  PetscFunctionBeginUser;
  for (int p = 0; p < o->pairs.n; p++) {
    const int k = o->pairs.pair[p].b;
    const OverlapPiece *piece = &o->piece[o->pairs.pair[p].a];
    if (piece->is_shell) {
      const double dxw = WallExtent((const double(*)[2])o->x[k], piece->normal);
      c->weight[p] = WallWeightOf(o->mu[k] / (c->options.thickness * dxw), piece->normal);
    } else {
      c->weight[p] = WallWeightIsotropic(c->options.relaxation * o->rho[k] / c->dt);
    }
  }
  PetscCall(InertiaYield(o, solid, c->dt, c->options.gravity, c->weight, c->firmness));
  PetscFunctionReturn(0);
}

const CouplerActions COUPLER_ACTIONS_REACTION = {PETSC_FALSE, Weigh, CouplerReactConserving,
                                                 CouplerFillSolid};
