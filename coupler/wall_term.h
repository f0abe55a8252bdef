/* The coupling term s_c = a (u_s - u) in the fluid [37]-[39], assembled pair by pair.
 *
 * Each pair of the overlap (T, K) has one symmetric 2 x 2 coefficient a, kg/(m3 s): sigma I where T belongs
 * to the solid's volume, the wall term where it belongs to the shell,
 *
 *     a = mu / (dr dxw) (I + n n / 3)          [37], dr the shell's thickness, dxw the extent of K along n
 *
 * times WALL_PENALTY in mode reaction.
 *
 * Element K receives, summed over its pairs (B = int N_K N_K^T, C = int N_T N_K^T),
 *
 *     a                 =  a B                s   =  a C^T u_s + C^T q + start C^T v
 *     implicit inertia  =  m B
 *     ms                =  B                  us  =  C^T u_s          T in the solid's volume, held
 *
 * with q a body force at the vertices of T, m the solid's inertia in the fluid's solve and start the inertia that begins with the
 * solid's velocity v (inertia.h); T is held where it has none.  The reaction (force.h) is made of the same coefficients and
 * integrals, so what the fluid gains the solid loses.  No field is projected, so none undershoots: a sum of
 * positive semidefinite coefficients times Gram matrices is positive semidefinite. */
#ifndef CORACLE_WALL_TERM_H
#define CORACLE_WALL_TERM_H
#include "coupler/overlap.h"

/* The wall term of mode reaction is so many times [37], with which the velocity changes over a whole element: the body is as thin then
 * as if the fluid slipped over an element's length.  The drag of a cylinder in a channel (Schaefer and Turek, 2D-1), with
 * elements of D/12 and D/25 and a shell of D/200: with 1 it is 3.4 and 1.3 % low, with 4 0.5 % low and 0.1 % high, with 10 (D/12) 1.7 % high. */
#define WALL_PENALTY 4.0

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

static inline int WallIsZero(const WallCoefficient *a)
{
  return (a->xx == 0.0) & (a->xy == 0.0) & (a->yy == 0.0);
}

/* a v */
static inline void WallApply(const WallCoefficient *a, const double v[2], double av[2])
{
  av[0] = a->xx * v[0] + a->xy * v[1];
  av[1] = a->xy * v[0] + a->yy * v[1];
}

/* What a pair gives the fluid, beside its integrals. */
typedef struct {
  WallCoefficient a;
  double inertia;        /* m, kg/(m3 s) */
  PetscBool covered;     /* K lies in the solid as a whole (inertia.h) */
  WallCoefficient start; /* how much of the inertia starts from the solid's velocity (inertia.h), kg/(m3 s) */
  double q[3][2];        /* N/m3, at the vertices of T */
  /* N/m3, of the fluid beside the solid (outside.h), which the solid does not feel */
  double outside_weight[2];
} PairTerm;

/* q[i] = int over the pair of N_T,i (u - u_s): u [2][3] on the fluid element, u_s [3][2] on the source
 * triangle. */
static inline void PairSlip(const SupermeshPair *pair, const double u[6], const double us[3][2],
                            double q[3][2])
{
  for (int i = 0; i < 3; i++) {
    const double *ab = pair->ab[i], *aa = pair->aa[i];
    for (int c = 0; c < 2; c++) {
      q[i][c] = ab[0] * u[3 * c] + ab[1] * u[3 * c + 1] + ab[2] * u[3 * c + 2] -
                (aa[0] * us[0][c] + aa[1] * us[1][c] + aa[2] * us[2][c]);
    }
  }
}

/* Local: coupling[overlap->ncoupled], one per coupled element (coracle.h has shapes and units), from the
 * pairs' term[pairs.n], the source triangles' velocities and density[overlap->nsources] (inertia.h), which is 0
 * where the solid is held; tangential[ncoupled]: D (slip.h); start_velocity[nsources][3][2]: the solid's at the
 * step's start, m/s, which the elements' mean velocity is of. */
void WallTermAssemble(const Overlap overlap, const PairTerm term[], const double density[],
                      const WallCoefficient tangential[], const double start_velocity[][3][2],
                      CoracleCoupling coupling[]);
#endif
