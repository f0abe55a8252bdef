#include "coupler/terms/outside.h"

void OutsideDensity(const Overlap o, ElementTerm element[])
{
  for (int e = 0; e < o->ncoupled; e++) element[e].outside = 0.0;
  if (!o->phases) return;
  for (int p = 0; p < o->pairs.n; p++) /* the solid's area so far */
    if (!o->source[o->pairs.pair[p].a].is_shell)
      element[o->coupled_index[p]].outside += o->pairs.pair[p].area;
  for (int e = 0; e < o->ncoupled; e++) {
    const int k = o->coupled_element[e];
    const double open = fmax(1.0 - element[e].outside / o->area[k], OUTSIDE_LEAST);
    element[e].outside =
        fmin(fmax(o->rho_mean[k] - o->rho[k], 0.0) / open, fmax(o->rho_beside[k] - o->rho[k], 0.0));
  }
}
