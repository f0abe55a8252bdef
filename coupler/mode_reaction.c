/* Mode reaction: sigma in the solid's volume, the wall term in its shell, and the force as the reaction to
 * both. */
#include "coupler/coupler_impl.h"
#include "coupler/inertia.h"

static void ReadOptions(CoracleCase file, CouplerOptions *o)
{
  o->relaxation = CoracleCaseNumberOr(file, "coupler.relaxation", 10.0, 0.0, HUGE_VAL);
  if (o->relaxation <= 0.0)
    CoracleCaseRefuse(file, "coupler.relaxation", "expected a number > 0, found %g", o->relaxation);
}

static PetscErrorCode Coefficients(Coupler c, const SolidState *solid)
{
  const Overlap o = c->overlap;

  PetscFunctionBeginUser;
  for (int p = 0; p < o->pairs.n; p++) {
    const int k = o->pairs.pair[p].b;
    const SourceTriangle *source = &o->source[o->pairs.pair[p].a];
    if (source->is_shell) {
      const double dxw = WallExtent((const double(*)[2])o->x[k], source->normal);
      c->coefficient[p] = WallCoefficientOf(o->mu[k] / (c->options.thickness * dxw), source->normal);
    } else {
      c->coefficient[p] = WallCoefficientIsotropic(c->options.relaxation * o->rho[k] / c->dt);
    }
  }
  PetscCall(InertiaCoefficients(o, solid, c->dt, c->coefficient, c->density, c->implicit_factor));
  PetscFunctionReturn(0);
}

const CouplerModeTable COUPLER_MODE_REACTION = {.velocity = COUPLER_VELOCITY_END,
                                                .read_options = ReadOptions,
                                                .coefficients = Coefficients,
                                                .force = CouplerConservativeForce,
                                                .correct = CouplerSolidCorrection};
