/* What a fluid without pressure, viscosity and advection makes of its coupling, element by element. */
#ifndef TESTS_SYNTHETIC_MOMENTUM_H
#define TESTS_SYNTHETIC_MOMENTUM_H
#include "common/link/coracle.h"
#include <string.h>

/* m v = r by Gauss elimination; n <= 6, m symmetric positive definite. */
static inline void SyntheticSolve(int n, double m[6][6], double r[6])
{
  for (int k = 0; k < n; k++) {
    for (int i = k + 1; i < n; i++) {
      const double f = m[i][k] / m[k][k];
      for (int j = k; j < n; j++) m[i][j] -= f * m[k][j];
      r[i] -= f * r[k];
    }
  }
  for (int k = n - 1; k >= 0; k--) {
    for (int j = k + 1; j < n; j++) r[k] -= m[k][j] * r[j];
    r[k] /= m[k][k];
  }
}

/* u[2][3], the velocity at the step's start, becomes u* of
 * rho M/dt (u* - u) + I (G u* - kept u) + a u* = s, 0 in place of u beside rho where the element is covered; rho_dt: rho/dt. */
static inline void SyntheticMomentum(const CoracleCoupling *k, double area, double rho_dt, double u[2][3])
{
  double m[6][6], r[6];
  for (int p = 0; p < 6; p++) {
    r[p] = k->s[p / 3][p % 3];
    for (int q = 0; q < 6; q++) {
      const double mass = p / 3 != q / 3 ? 0.0 : rho_dt * area / (p == q ? 6.0 : 12.0);
      const double inertia = k->implicit_inertia[p % 3][q % 3];
      m[p][q] = k->a[p / 3][p % 3][q / 3][q % 3] + mass + inertia * k->inertia_tensor[p / 3][q / 3];
      r[p] +=
          ((k->flags & CORACLE_IS_COVERED ? 0.0 : mass) + inertia * k->kept[p / 3][q / 3]) * u[q / 3][q % 3];
    }
  }
  SyntheticSolve(6, m, r);
  memcpy(u, r, sizeof r);
}
#endif
