#include "coupler/outside.h"

/* Of K, less than which is not divided by. */
#define LEAST_OPEN 1e-3

static double Slip(double share, double inside, double beside, double held)
{
  static const double range[2] = SLIP_SHARE;
  if (beside == inside) return 1.0; /* one fluid */
  if (held > 0.0) return 0.0;
  return fmin(fmax((share - range[0]) / (range[1] - range[0]), 0.0), 1.0);
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
    const double limit = fmax(o->rho_beside[k] - o->rho[k], 0.0),
                 excess = fmax(o->rho_mean[k] - o->rho[k], 0.0) / open;
    outside[e].density = fmin(excess, limit);
    outside[e].slip = Slip(limit > 0.0 ? excess / limit : 0.0, o->rho[k], o->rho_beside[k], sums[e].held);
  }
  PetscCall(PetscFree(sums));
  PetscFunctionReturn(0);
}

void OutsideCoefficients(const Overlap o, const OutsideFluid outside[], const double density[], double dt,
                         const double gravity[2], PairTerm term[])
{
  for (int p = 0; p < o->pairs.n; p++) {
    const double rho = outside[o->coupled_index[p]].density;
    if (density[o->pairs.pair[p].a] == 0.0) continue; /* the shell's, too */
    term[p].outside = rho / dt;
    for (int c = 0; c < 2; c++) term[p].outside_weight[c] = rho * gravity[c];
  }
}
