/* Mode penalty_shell (Vire, Xiang, Pain 2015; the paper's Af20 rows): a = rho_f/dt I in the shell, nothing in
 * the volume.  The force is the reaction to it, so that momentum is kept. */
#include "coupler/step/coupler_impl.h"

static PetscErrorCode Coefficients(Coupler c, const SolidState *solid)
{
  const Overlap o = c->overlap;

  PetscFunctionBeginUser;
  for (int p = 0; p < o->pairs.n; p++) {
    const SupermeshPair *pair = &o->pairs.pair[p];
    c->term[p].a = WallCoefficientIsotropic(o->source[pair->a].is_shell ? o->rho[pair->b] / c->dt : 0.0);
  }
  PetscFunctionReturn(0);
}

const CouplerModeTable COUPLER_MODE_PENALTY_SHELL = {
    .velocity = COUPLER_VELOCITY_END, .coefficients = Coefficients, .force = CouplerConservativeForce};
