/* Mode reaction: the solid's inertia in its volume, the wall term in its shell, slip in the elements that the surface crosses,
 * and the force as the reaction to all. */
#include "coupler/step/coupler_impl.h"
#include "coupler/terms/inertia.h"
#include "coupler/terms/outside.h"
#include "coupler/terms/slip.h"

static PetscErrorCode Coefficients(Coupler c, const SolidState *solid)
{
  const Overlap o = c->overlap;

  PetscFunctionBeginUser;
  for (int p = 0; p < o->pairs.n; p++) {
    const int k = o->pairs.pair[p].b;
    const SourceTriangle *source = &o->source[o->pairs.pair[p].a];
    if (!source->is_shell) continue;
    const double dxw = WallExtent((const double(*)[2])o->x[k], source->normal);
    c->term[p].a = WallCoefficientOf(WALL_PENALTY * o->mu[k] / (c->options.thickness * dxw), source->normal);
  }
  PetscCall(InertiaCoefficients(o, solid, c->dt, c->options.capillary, c->term, c->source));
  OutsideDensity(o, c->element);
  SlipTensors(o, c->source, c->options.gravity, c->dt, c->element);
  PetscCall(DisplacedDensity(o, solid, c->element, c->source, &c->harmonic, c->displaced));
  InertiaStart(o, c->source, c->dt, c->element, c->term);
  SlipCoefficients(o, c->element, c->term);
  PetscFunctionReturn(0);
}

const CouplerModeTable COUPLER_MODE_REACTION = {
    .velocity = COUPLER_VELOCITY_END, .coefficients = Coefficients, .force = CouplerConservativeForce};
