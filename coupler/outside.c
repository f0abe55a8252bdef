#include "coupler/outside.h"

/* Of K, less than which is not divided by. */
#define LEAST_OPEN 1e-3

/* excess[ncoupled]: rho_o - rho_f, kg/m3, between 0 and that of the phases beside the solid. */
static void Excess(const Overlap o, double excess[])
{
  for (int e = 0; e < o->ncoupled; e++) excess[e] = 0.0; /* the solid's area so far */
  for (int p = 0; p < o->pairs.n; p++)
    if (!o->source[o->pairs.pair[p].a].is_shell) excess[o->coupled_index[p]] += o->pairs.pair[p].area;
  for (int e = 0; e < o->ncoupled; e++) {
    const int k = o->coupled_element[e];
    const double open = fmax(1.0 - excess[e] / o->area[k], LEAST_OPEN);
    excess[e] = fmin(fmax(o->rho_mean[k] - o->rho[k], 0.0) / open, fmax(o->rho_beside[k] - o->rho[k], 0.0));
  }
}

PetscErrorCode OutsideWeight(const Overlap o, const double gravity[2], ElementTerm element[])
{
  double *excess;

  PetscFunctionBeginUser;
  if (!o->phases) PetscFunctionReturn(0);
  PetscCall(PetscMalloc1(o->ncoupled, &excess));
  Excess(o, excess);
  for (int e = 0; e < o->ncoupled; e++)
    for (int c = 0; c < 2; c++) element[e].outside_weight[c] = excess[e] * gravity[c];
  PetscCall(PetscFree(excess));
  PetscFunctionReturn(0);
}
