/* The share a of a phase on the face between two elements, downwind-biased: what compressive advection carries through it.  Kernel: no
 * mesh, no MPI.
 *
 *      U --- C -|-> D      C: the element that the flux leaves, D: that which it enters, h: the distance of their centres,
 *                          n: the face's unit normal out of C, U: the vertex of C opposite the face
 *
 *     a_FE   shares at vertices, means over stars weighted with areas (a lumped Galerkin projection), linear in elements
 *     a_HO = a_FE + nu (n.g)/(u.n),    nu = P R^2/|g|^2,    P = h/(2 |A|),    A = (u.g) g/|g|^2,    R = |u|/h,    g = grad a_FE
 *     a~   = (a - a_U)/(a_D - a_U)
 *     a~_f = max(min(a~_HO, xi a~_C, 1), a~_C),    xi = min(max(1/(3 c), 2), 1/c);    a~_f = a~_C where a~_C is not in (0, 1)
 *
 * c is the share of C's area that leaves it in a step.  a_HO is an extrapolation to the face of negative diffusion, about 1/(2 h |g|)
 * downwind of a_FE; xi a~_C limits it to what C can lose.  (Pavlidis, Gomes, Xie, Percival, Pain and Matar, Int. J. Numer. Meth. Fluids
 * 80, 2016, for control volumes around nodes and an implicit step; the normalised variable is Leonard's, 1988.  1/c is for the explicit
 * step.) */
#ifndef CORACLE_FACE_SHARE_H
#define CORACLE_FACE_SHARE_H
#include <math.h>

/* Shares that differ by less are equal. */
#define SHARE_TINY 1e-12

/* Velocity at the face's middle, m/s; n, h, m; c. */
typedef struct {
  double u[2], n[2], h, courant;
} FaceFlow;

/* a_HO from a_FE at the face's middle and its gradient, 1/m. */
static inline double FaceShareHighOrder(const FaceFlow *face, double value, const double gradient[2])
{
  const double *u = face->u, *n = face->n, *g = gradient;
  const double below =
      2.0 * face->h * hypot(g[0], g[1]) * fabs(u[0] * g[0] + u[1] * g[1]) * (u[0] * n[0] + u[1] * n[1]);
  return below != 0.0 ? value + (u[0] * u[0] + u[1] * u[1]) * (n[0] * g[0] + n[1] * g[1]) / below : value;
}

/* a_f, between a_C and a_D. */
static inline double FaceShare(double high_order, double behind, double from, double to, double courant)
{
  const double range = to - behind;
  if (fabs(range) < SHARE_TINY) return from;
  const double c = (from - behind) / range;
  if (c <= 0.0 || c >= 1.0) return from;
  const double xi = fmin(fmax(1.0 / (3.0 * courant), 2.0), 1.0 / courant);
  return behind + range * fmax(fmin(fmin((high_order - behind) / range, xi * c), 1.0), c);
}
#endif
