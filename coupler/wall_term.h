/* The coupling term s_c = a (u_s - u) in the fluid [37]-[39], assembled pair by pair.
 *
 * Each pair of the overlap (T, K) has one symmetric 2 x 2 coefficient a, kg/(m3 s): sigma I where T belongs
 * to the solid's volume, the wall term where it belongs to the shell,
 *
 *     a = mu / (dr dxw) (I + n n / 3)          [37], dr the shell's thickness, dxw the extent of K along n.
 *
 * Element K receives, summed over its pairs (B = int N_K N_K^T, C = int N_T N_K^T),
 *
 *     a                 =  a B                s   =  a C^T u_s + C^T q
 *     implicit inertia  =  (1 - b) a B
 *     ms                =  b B                us  =  b C^T u_s        T in the solid's volume
 *
 * with q a body force at the vertices of T and b = 0 where the fluid's solve has the solid's inertia, else 1
 * (inertia.h).  The reaction (force.h) is made of the
 * same coefficients and integrals, so what the fluid gains the solid loses.  No field is projected, so none
 * undershoots: a sum of positive semidefinite coefficients times Gram matrices is positive semidefinite. */
#ifndef CORACLE_WALL_TERM_H
#define CORACLE_WALL_TERM_H
#include "coupler/overlap.h"

typedef struct {
  double xx, xy, yy; /* kg/(m3 s) */
} WallCoefficient;

/* dxw: the extent of fluid element x along n, m.  The wall function [33] lets the velocity change from the
 * wall's to the element's over one cell; the cell's length in that direction is the distance over which its
 * P1 functions can. */
static inline double WallExtent(const double x[3][2], const double n[2])
{
  double lower = HUGE_VAL, upper = -HUGE_VAL;
  for (int i = 0; i < 3; i++) {
    const double d = n[0] * x[i][0] + n[1] * x[i][1];
    lower = fmin(lower, d);
    upper = fmax(upper, d);
  }
  return upper - lower;
}

/* k (I + n n / 3): [37] written out. */
static inline WallCoefficient WallCoefficientOf(double k, const double n[2])
{
  return (WallCoefficient){k * (1.0 + n[0] * n[0] / 3.0), k * n[0] * n[1] / 3.0,
                           k * (1.0 + n[1] * n[1] / 3.0)};
}

static inline WallCoefficient WallCoefficientIsotropic(double k)
{
  return (WallCoefficient){k, 0.0, k};
}

static inline WallCoefficient WallCoefficientScaled(const WallCoefficient *a, double factor)
{
  return (WallCoefficient){factor * a->xx, factor * a->xy, factor * a->yy};
}

/* a v */
static inline void WallApply(const WallCoefficient *a, const double v[2], double av[2])
{
  av[0] = a->xx * v[0] + a->xy * v[1];
  av[1] = a->xy * v[0] + a->yy * v[1];
}

/* Local: coupling[overlap->ncoupled], one per coupled element (coracle.h has shapes and units), from the
 * pairs' coefficient[pairs.n] a, the source triangles' velocities, implicit_factor[overlap->nsources]
 * b and body_force[pairs.n][3][2] q, N/m3. */
void WallTermAssemble(const Overlap overlap, const WallCoefficient coefficient[],
                      const double implicit_factor[], const double body_force[][3][2],
                      CoracleCoupling coupling[]);
#endif
