#include "coupler/outside.h"

/* Of K, less than which is not divided by. */
#define LEAST_OPEN 1e-3

/* 0 .. 1 while value goes from range[0] to range[1]. */
static double Ramp(double value, const double range[2])
{
  return fmin(fmax((value - range[0]) / (range[1] - range[0]), 0.0), 1.0);
}

/* share: of what is open, that which is not of the phase that fills solids. */
static double Slip(double share, double open, double held)
{
  static const double of_share[2] = SLIP_SHARE, of_open[2] = SLIP_OPEN;
  return held > 0.0 ? 0.0 : Ramp(share, of_share) * Ramp(open, of_open);
}

PetscErrorCode OutsideFind(const Overlap o, const double density[], OutsideFluid outside[])
{
  typedef struct {
    double solid, held; /* areas */
  } Sums;
  Sums *sums;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(o->ncoupled, &sums));
  for (int p = 0; p < o->pairs.n; p++) {
    const SupermeshPair *pair = &o->pairs.pair[p];
    if (o->source[pair->a].is_shell) continue;
    sums[o->coupled_index[p]].solid += pair->area;
    if (density[pair->a] == 0.0) sums[o->coupled_index[p]].held += pair->area;
  }
  for (int e = 0; e < o->ncoupled; e++) {
    const int k = o->coupled_element[e];
    const double open = fmax(1.0 - sums[e].solid / o->area[k], LEAST_OPEN);
    const double largest = fmax(o->rho_beside[k] - o->rho[k], 0.0),
                 excess = fmax(o->rho_mean[k] - o->rho[k], 0.0) / open;
    outside[e].density = fmin(excess, largest);
    outside[e].slip = o->phases ? Slip(largest > 0.0 ? excess / largest : 0.0, open, sums[e].held) : 1.0;
  }
  PetscCall(PetscFree(sums));
  PetscFunctionReturn(0);
}

void OutsideWeight(const Overlap o, const OutsideFluid outside[], const double density[],
                   const double gravity[2], PairTerm term[])
{
  for (int p = 0; p < o->pairs.n; p++)
    for (int c = 0; c < 2 && density[o->pairs.pair[p].a] > 0.0; c++) /* not the shell's */
      term[p].outside_weight[c] = outside[o->coupled_index[p]].density * gravity[c];
}
