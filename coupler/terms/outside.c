#include "coupler/terms/outside.h"

void OutsideDensity(const Overlap o, ElementTerm element[])
{
  for (int e = 0; e < o->ncoupled; e++) {
    element[e].outside = 0.0;
    if (!o->phases) continue;
    const int k = o->coupled_element[e];
    const double open = fmax(1.0 - o->solid_area[e] / o->area[k], OUTSIDE_LEAST);
    element[e].outside =
        fmin(fmax(o->rho_mean[k] - o->rho[k], 0.0) / open, fmax(o->rho_beside[k] - o->rho[k], 0.0));
  }
}
