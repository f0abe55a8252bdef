/* The constant-strain triangle at finite strain, in the current configuration, per metre of depth (element_law.h).
 *
 *            c                  rest edges    D0 = [b0 - a0, c0 - a0]
 *           / \                 current edges D  = [b - a, c - a]
 *          /   \                F = D D0^-1
 *         a-----b
 *
 *     Cauchy stress   T = elastic (element_law.h) + eta sym(grad v)
 *     nodal force     f_i = -int grad N_i . T dA over the current triangle               [3] of the paper
 *
 * Without eta f = -d(sum W A0)/dx, and elastic motion conserves energy. */
#ifndef SOLID_ELEMENT_H
#define SOLID_ELEMENT_H
#include "solid/element_law.h"

typedef struct {
  Point a, b, c;
} ElementForces;

/* eta sym(grad v), grad v = Dv D^-1, Dv the edges' velocities. */
static inline ElementStress ElementViscousStress(Tensor edges, Tensor velocity, double eta)
{
  const Tensor l = TensorProduct(velocity, TensorInverse(edges));
  return (ElementStress){eta * l.xx, eta * l.yy, 0.5 * eta * (l.xy + l.yx)};
}

/* f_i = -A T grad N_i; A grad N_i is half the opposite edge turned inwards, so nothing is divided by. */
static inline ElementForces ElementForcesOf(Tensor edges, ElementStress t)
{
  ElementForces f;
  f.b.x = -0.5 * (t.xx * edges.yy - t.xy * edges.xy);
  f.b.y = -0.5 * (t.xy * edges.yy - t.yy * edges.xy);
  f.c.x = 0.5 * (t.xx * edges.yx - t.xy * edges.xx);
  f.c.y = 0.5 * (t.xy * edges.yx - t.yy * edges.xx);
  f.a.x = -f.b.x - f.c.x;
  f.a.y = -f.b.y - f.c.y;
  return f;
}

/* Bounds on what the element adds to M^-1 K and M^-1 C (K the tangent stiffness, C the viscous matrix, M the
 * lumped mass).  By Irons' theorem the largest over the elements bounds the whole mesh.  With g_i = grad N_i
 * and L = grad v,  sum_i |v_i|^2 >= |L|^2 / s,  s the largest eigenvalue of sum_i g_i g_i^T, and
 *     A L:a:L <= A |L|^2 a,   a = 2 mu/J + lambda (1/J - J) + 2 lambda J + max(principal stress, 0),
 * a being the tangent modulus of the neo-Hookean law with its geometric part.  Plane stress's energy is the least over
 * l_3, so its tangent lies below that of the law with l_3 fixed: J^2 becomes (J l_3)^2 in 1/J (2 mu + lambda
 * ...).
 *
 * The corotated law's W = mu/2 d^2 + (mu + lambda)/2 (q - 2)^2 (see its energy) is, d being linear in F and q
 * the length of a vector linear in F, a function of F with the second derivatives 2 mu, 2 mu, 2 (mu + lambda)
 * and 2 (mu + lambda)(1 - 2/q) in orthogonal directions: at most a = 2 (mu + lambda), whatever F.  With the
 * gradients at rest in s the bound of a body does not change in time.
 *
 * St. Venant's, with the gradients at rest, too: a change G of F changes E by sym(F^T G), of length b |G| at most, b^2 the larger
 * eigenvalue of C, and with s the larger principal value of 2 mu E + lambda tr E I
 *     a = 2 (mu + lambda) b^2 + s. */
typedef struct {
  double stiffness; /* omega^2, 1/s2 */
  double damping;   /* 2 xi omega, 1/s */
} ElementRates;

/* The larger eigenvalue of a symmetric tensor. */
static inline double ElementPrincipal(double xx, double yy, double xy)
{
  return 0.5 * (xx + yy + sqrt((xx - yy) * (xx - yy) + 4.0 * xy * xy));
}

/* s; rows of g: gradients of N_b and N_c, 1/m */
static inline double ElementSpread(Tensor g)
{
  const Point a = {-g.xx - g.yx, -g.xy - g.yy};
  return ElementPrincipal(g.xx * g.xx + g.yx * g.yx + a.x * a.x, g.xy * g.xy + g.yy * g.yy + a.y * a.y,
                          g.xx * g.xy + g.yx * g.yy + a.x * a.y);
}

/* a of the neo-Hookean law. */
static inline double ElementModulus(Tensor f, double j, ElementLaw law)
{
  const ElementStress t = ElementElasticStress(f, j, law);
  const double volume = j * (law.plane_stress ? ElementThinning(j, law.mu, law.lambda) : 1.0); /* J l_3^2 */
  const double shear = 2.0 * law.mu / j + law.lambda * (1.0 / j - volume);
  return fmax(shear, 0.0) + 2.0 * law.lambda * volume + fmax(ElementPrincipal(t.xx, t.yy, t.xy), 0.0);
}

/* a of the other laws; not less than mu where an element is squeezed so much that it is unstable. */
static inline double ElementRestModulus(Tensor f, ElementLaw law)
{
  const double both = law.mu + ElementPlaneLambda(law);
  if (law.kind == LAW_COROTATED) return 2.0 * both;
  const double square =
      ElementPrincipal(f.xx * f.xx + f.yx * f.yx, f.xy * f.xy + f.yy * f.yy, f.xx * f.xy + f.yx * f.yy);
  return fmax(2.0 * both * square + law.mu * (square - 1.0) + ElementPlaneLambda(law) * ElementTraceGreen(f),
              law.mu);
}

static inline ElementRates ElementRatesOf(Tensor edges, Tensor f, double density, ElementLaw law)
{
  const double j = TensorDeterminant(f);
  const Tensor g = TensorInverse(edges);
  const double spread = 3.0 / density * ElementSpread(g); /* lumped: rho0 A0 / 3 a node */
  const double stiffness = law.kind == LAW_NEO_HOOKEAN ? spread * j * ElementModulus(f, j, law)
                                                       : 3.0 / density * ElementSpread(TensorProduct(g, f)) *
                                                             ElementRestModulus(f, law);
  return (ElementRates){stiffness, spread * j * law.eta};
}

/* Largest stable step of semi-implicit Euler with the viscous force taken at the old velocity:
 * h^2 omega^2 + 2 h (2 xi omega) <= 4;  undamped this is 2/omega. */
static inline double ElementStableStep(ElementRates r)
{
  return 4.0 / (r.damping + sqrt(r.damping * r.damping + 4.0 * r.stiffness));
}
#endif
