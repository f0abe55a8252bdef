/* The coupling term s_c = a (u_s - u) in the fluid [37]-[39], pair by pair.
 *
 * Each pair of the overlap has one symmetric 2 x 2 coefficient a, its weight: sigma I where the triangle
 * belongs to the solid's volume, the wall term where it belongs to the shell.  The fluid's coefficients and
 * the solid's reaction (force.h) are made of the same weights and the same integrals, so what the fluid gains
 * the solid loses.  Nothing is projected, hence nothing undershoots: a sum of positive semidefinite weights
 * times Gram matrices is positive semidefinite. */
#ifndef CORACLE_WALL_TERM_H
#define CORACLE_WALL_TERM_H
#include "coupler/overlap.h"

typedef struct {
  double xx, xy, yy; /* kg/(m3 s) */
} WallWeight;

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
static inline WallWeight WallWeightOf(double k, const double n[2])
{
  return (WallWeight){k * (1.0 + n[0] * n[0] / 3.0), k * n[0] * n[1] / 3.0, k * (1.0 + n[1] * n[1] / 3.0)};
}

static inline WallWeight WallWeightIsotropic(double k)
{
  return (WallWeight){k, 0.0, k};
}

static inline WallWeight WallWeightScaled(const WallWeight *a, double factor)
{
  return (WallWeight){factor * a->xx, factor * a->xy, factor * a->yy};
}

/* a v */
static inline void WallApply(const WallWeight *a, const double v[2], double av[2])
{
  av[0] = a->xx * v[0] + a->xy * v[1];
  av[1] = a->xy * v[0] + a->yy * v[1];
}

/* Local: one entry per element of the overlap, from the pairs' weights and the pieces' velocities (coracle.h
 * says what the entries hold).  firmness[overlap->npieces]: b of the entries' ms and us (inertia.h);
 * coupling[overlap->nentries]. */
void WallTermAssemble(const Overlap overlap, const WallWeight weight[], const double firmness[],
                      CoracleCoupling coupling[]);
#endif
