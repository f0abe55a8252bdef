/* Contact by the potential method (Munjiza 2004): an edge of one body within a triangle of another, or behind
 * a wall.
 *
 *     target triangle with potential             P------Q  contactor's edge, its body on the left
 *     phi = 3 min(lambda_0, lambda_1, lambda_2)       |    n = (d_y, -d_x)/L, d = Q - P
 *     0 on the edges, 1 in the centre                 v n
 *
 *     f = -(p/J) int phi n ds    on the contactor's edge, over its part in the triangle
 *
 * shared out to P and Q by the edge's linear functions and taken off the target's nodes by its lambda_i: sum
 * and moment of the forces vanish to round-off, whatever the force's direction (friction is shared out so
 * too).  J is the target's area over its rest area; with it the forces of an edge set that encloses a body C
 * are exactly -dU/dx, U = p int_C (phi/J) dA, in the contactor's and in the target's nodes alike, so that
 * contact conserves energy even between deforming bodies. */
#ifndef SOLID_CONTACT_KERNEL_H
#define SOLID_CONTACT_KERNEL_H
#include "solid/plane.h"
#include <math.h>

/* Integrals over the part of the edge inside, in the edge's own measure (times its length they are lengths).
 */
typedef struct {
  double edge[2]; /* of phi (1 - s), phi s: the shares of the edge's ends */
  double
      opposite; /* the share of the third node of the contactor's element: 0 but of discs (circle_kernel.h) */
  double target[3];   /* of phi lambda_i: the shares of the target's nodes */
  double largest_phi; /* at the ends of the part inside and at the kinks */
  double inside;      /* how much of the edge is inside, 0 .. 1 */
  double twice_area;  /* of the target now, m2 */
} ContactIntegrals;

static inline double ContactSum(const ContactIntegrals *c)
{
  return c->edge[0] + c->edge[1] + c->opposite;
}

/* int phi (1 - s) ds and int phi s ds over s in [s0, s1], phi linear from f0 to f1 there (Simpson: exact). */
static inline void ContactPiece(double s0, double s1, double f0, double f1, double integral[2])
{
  const double w = (s1 - s0) / 6.0, sm = 0.5 * (s0 + s1), fm = 0.5 * (f0 + f1);
  const double moment = w * (s0 * f0 + 4.0 * sm * fm + s1 * f1);
  integral[0] += w * (f0 + 4.0 * fm + f1) - moment;
  integral[1] += moment;
}

static inline double ContactPotential(const double at_p[3], const double at_q[3], double s)
{
  double phi = HUGE_VAL;
  for (int i = 0; i < 3; i++) phi = Lesser(phi, at_p[i] + s * (at_q[i] - at_p[i]));
  return Greater(3.0 * phi, 0.0);
}

/* The part s0 .. s1 of the edge on which all lambda_i >= 0; there is none where s0 >= s1 or one of them is not a number. */
static inline void ContactClip(const double at_p[3], const double at_q[3], double *s0, double *s1)
{
  *s0 = 0.0;
  *s1 = 1.0;
  for (int i = 0; i < 3; i++) {
    const double a = at_p[i], b = at_q[i], s = a / (a - b);
    *s0 = a < 0.0 ? Greater(*s0, s) : *s0;
    *s1 = b < 0.0 ? Lesser(*s1, s) : *s1;
    *s1 = (a <= 0.0) & (b <= 0.0) ? -1.0 : *s1;
  }
}

/* The integrals of phi over s0 .. s1: phi is linear between the places where two lambdas cross.  Without branches, as edges and
 * triangles are dealt with side by side: a place outside is moved to s0. */
static inline double ContactIntegrate(const double at_p[3], const double at_q[3], double s0, double s1,
                                      double integral[2])
{
  double place[5] = {s0, s0, s0, s0, s1}, largest;
  for (int i = 0; i < 3; i++) {
    const int j = (i + 1) % 3;
    const double slope = (at_q[i] - at_p[i]) - (at_q[j] - at_p[j]), s = (at_p[j] - at_p[i]) / slope;
    place[1 + i] = (s > s0) & (s < s1) ? s : s0;
  }
  for (int i = 0; i < 3; i++) { /* sorts the three */
    const int k = 1 + i % 2;
    const double low = Lesser(place[k], place[k + 1]), high = Greater(place[k], place[k + 1]);
    place[k] = low;
    place[k + 1] = high;
  }
  double left = ContactPotential(at_p, at_q, s0);
  largest = left;
  for (int k = 1; k < 5; k++) {
    const double right = ContactPotential(at_p, at_q, place[k]);
    ContactPiece(place[k - 1], place[k], left, right, integral);
    left = right;
    largest = Greater(largest, right);
  }
  return largest;
}

/* lambda_i of triangle t at x. */
static inline void ContactCoordinates(const Point t[3], double inverse_twice_area, Point x, double at[3])
{
  for (int i = 0; i < 3; i++) {
    const Point from = t[(i + 1) % 3], side = PointMinus(t[(i + 2) % 3], from);
    at[i] = PointCross(side, PointMinus(x, from)) * inverse_twice_area;
  }
}

static inline double ContactTwiceArea(const Point t[3])
{
  return PointCross(PointMinus(t[1], t[0]), PointMinus(t[2], t[0]));
}

/* The point is beyond, or on, a triangle's side p q: where its lambda there is not positive. */
static inline int ContactBeyond(Point p, Point q, Point x)
{
  return PointCross(PointMinus(q, p), PointMinus(x, p)) <= 0.0;
}

/* The lambda_i of triangle t at both ends of the edge, and the part s0 .. s1 of it inside. */
static inline __attribute__((always_inline)) void ContactInside(Point p, Point q, const Point t[3],
                                                                double inverse_twice_area, double at_p[3],
                                                                double at_q[3], double *s0, double *s1)
{
  ContactCoordinates(t, inverse_twice_area, p, at_p);
  ContactCoordinates(t, inverse_twice_area, q, at_q);
  ContactClip(at_p, at_q, s0, s1);
}

/* Edge and triangle meet where `inside` is more than 0; else the rest is unset. */
static inline __attribute__((always_inline)) ContactIntegrals ContactEdgeTriangle(Point p, Point q,
                                                                                  const Point t[3])
{
  ContactIntegrals c = {.twice_area = ContactTwiceArea(t)};
  double at_p[3], at_q[3], s0, s1;
  ContactInside(p, q, t, 1.0 / c.twice_area, at_p, at_q, &s0, &s1);
  c.inside = s1 - s0;
  c.largest_phi = ContactIntegrate(at_p, at_q, s0, s1, c.edge);
  for (int i = 0; i < 3; i++) c.target[i] = at_p[i] * c.edge[0] + at_q[i] * c.edge[1];
  return c;
}

static inline int ContactTouches(Point p, Point q, const Point t[3])
{
  double at_p[3], at_q[3], s0, s1;
  ContactInside(p, q, t, 1.0 / ContactTwiceArea(t), at_p, at_q, &s0, &s1);
  return s0 < s1;
}

/* A rigid half plane: phi = 3 depth / height behind the wall, depth_p and depth_q those of the edge's ends.
 * Sets edge and inside; returns 0 in front of the wall. */
static inline int ContactEdgeWall(double depth_p, double depth_q, double height, ContactIntegrals *c)
{
  const double a = 3.0 * depth_p / height, b = 3.0 * depth_q / height;
  c->edge[0] = c->edge[1] = c->opposite = 0.0;
  if (a <= 0.0 && b <= 0.0) return 0;
  const double cut = a / (a - b);
  const double s0 = a >= 0.0 ? 0.0 : cut, s1 = b >= 0.0 ? 1.0 : cut;
  ContactPiece(s0, s1, Greater(a, 0.0), Greater(b, 0.0), c->edge);
  c->inside = s1 - s0;
  c->largest_phi = Greater(a, b);
  return 1;
}

/* Friction and damping of all that one edge touches of one body.  Normal force N > 0, relative velocity of
 * the contactor (v.n towards the target, v.t along the edge), slip = what the tangential spring is stretched
 * by. */
typedef struct {
  double friction;  /* Coulomb's mu */
  double stiffness; /* of the tangential spring, N/m */
  double viscosity; /* N s/m, for the whole edge with the mass behind it */
  double bodies;    /* the mass of the bodies over that behind the edge */
  double part;      /* of the edge, that at most lies along the other body: `whole edge` above is this part */
} ContactLaw;

typedef struct {
  double normal, tangential; /* on the contactor, as multiples of N: against v.n > 0, and along the edge */
  double slip;               /* m; cut back to what friction can hold */
} ContactResponse;

static inline double ContactClamp(double value, double bound)
{
  return Greater(-bound, Lesser(bound, value));
}

/* c = 2 zeta sqrt(k m) of the part of the edge inside: k = N/depth is `full`, the mean of phi over the edge over its largest, times the whole
 * edge's stiffness, and behind a corner is the mass of its body, not of its length.  Not more than that of the whole edge. */
static inline double ContactViscosity(ContactLaw law, double inside, double full)
{
  const double mass = 1.0 + Greater(1.0 - inside / law.part, 0.0) * Greater(law.bodies - 1.0, 0.0);
  return law.viscosity * Lesser(sqrt(full / law.part * mass), 1.0);
}

/* Viscous force c v.n, no larger than N, so that nothing sticks and nothing jumps at first touch; tangential
 * spring and dashpot, together no larger than mu times the whole normal force.  Each part takes energy or
 * stores it: the spring is cut back when it slips, and the dashpot always works against the motion. */
static inline ContactResponse ContactRespond(ContactLaw law, double n, double viscosity, double slip,
                                             double vn, double vt)
{
  ContactResponse r;
  const double viscous = ContactClamp(viscosity * vn, n), cap = law.friction * (n + viscous);
  const double spring = ContactClamp(law.stiffness * slip, cap);
  r.normal = viscous / n;
  r.tangential = -ContactClamp(spring + viscosity * vt, cap) / n;
  r.slip = law.stiffness > 0.0 ? spring / law.stiffness : 0.0;
  return r;
}
#endif
