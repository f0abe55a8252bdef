#include "fluid/phases/phases_impl.h"

/* Of the face between a and b, what lies where n.x < d. */
static double Below(const double normal[2], double d, const double a[2], const double b[2])
{
  const double da = normal[0] * a[0] + normal[1] * a[1] - d, db = normal[0] * b[0] + normal[1] * b[1] - d;
  if (fmax(da, db) <= 0.0) return 1.0;
  return fmin(da, db) < 0.0 ? -fmin(da, db) / fabs(db - da) : 0.0;
}

void InflowShares(const PhasesInflow *inflow, const StarElement *element, int i, int np, double share[])
{
  const int tag = element->tag[i];
  const PhasesLevels *levels = inflow->levels ? &inflow->levels[tag] : NULL;
  double below = 0.0;
  for (int p = 0; p < np; p++) share[p] = 0.0;
  for (int k = 0; levels && k < levels->n; k++) {
    const double now = Below(levels->normal, levels->d[k], element->x[(i + 1) % 3], element->x[(i + 2) % 3]);
    share[levels->phase[k]] += now - below;
    below = now;
  }
  for (int p = 0; p < np; p++) share[p] += (1.0 - below) * inflow->fraction[tag][p];
}
