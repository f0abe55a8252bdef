/* What the fluid gains of one entry of the coupling over the step: what it takes from the solid, and what the solid must lose.  Kernel: no
 * memory, no errors. */
#ifndef CORACLE_COUPLING_GAIN_H
#define CORACLE_COUPLING_GAIN_H
#include "common/link/coracle.h"

/* gain[2] += the sum over the element's functions of s - a u* - I (G u+ - kept start), I the implicit inertia and G its tensor, less
 * mass start where the element is covered, N/m.  mass: rho |K|/dt, kg/(m s); start, u_star, u_projected: [2][3] of the element, m/s. */
static inline void CouplingAddGain(const CoracleCoupling *k, double mass, const double start[6],
                                   const double u_star[6], const double u_projected[6], double gain[2])
{
  const double third = k->flags & CORACLE_IS_COVERED ? mass / 3.0 : 0.0;
  double inertia[3];
  for (int j = 0; j < 3; j++)
    inertia[j] = k->implicit_inertia[0][j] + k->implicit_inertia[1][j] + k->implicit_inertia[2][j];
  for (int c = 0; c < 2; c++) {
    gain[c] += k->s[c][0] + k->s[c][1] + k->s[c][2];
    for (int j = 0; j < 3; j++) gain[c] -= third * start[3 * c + j];
    for (int d = 0; d < 2; d++)
      for (int j = 0; j < 3; j++)
        gain[c] -= inertia[j] *
                   (k->inertia_tensor[c][d] * u_projected[3 * d + j] - k->kept[c][d] * start[3 * d + j]);
  }
  if (k->a[0][0][0][0] == 0.0 && k->a[1][0][1][0] == 0.0) return; /* a is zero: inside solids */
  for (int c = 0; c < 2; c++)
    for (int i = 0; i < 3; i++)
      for (int j = 0; j < 6; j++) gain[c] -= k->a[c][i][j / 3][j % 3] * u_star[j];
}
#endif
