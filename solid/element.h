/* The constant-strain triangle at finite strain, in the current configuration, per metre of depth (or of rest
 * thickness: what has a thickness has its constants multiplied by it).
 *
 *            c                  rest edges    D0 = [b0 - a0, c0 - a0]
 *           / \                 current edges D  = [b - a, c - a]
 *          /   \                F = D D0^-1,   J = det F,   B = F F^T
 *         a-----b
 *
 *     Cauchy stress   T = mu/J (B - I) + lambda/2 (J - 1/J) I + eta sym(grad v)            (method.md 1, 8)
 *     nodal force     f_i = -int grad N_i . T dA over the current triangle                            [3]
 *
 * Without eta the law is hyperelastic, T = (2/J) F dW/dC F^T with, per unit of rest volume,
 *     W = mu/2 (tr B - 2 - 2 ln J) + lambda/4 (J^2 - 1 - 2 ln J)
 * (a compressible neo-Hookean solid; B_33 = 1), so that f = -d(sum W A0)/dx and elastic motion conserves
 * energy.
 *
 * That is plane strain.  In plane stress the sheet gets thinner by l_3 so that T_33 = 0 for the same solid
 * law: mu (l_3^2 - 1) + lambda/2 (J^2 l_3^2 - 1) = 0,   l_3^2 = (mu + lambda/2)/(mu + lambda/2 J^2), J the
 * in-plane determinant as above, and the stress times l_3 (per unit of rest thickness) becomes l_3 T = mu/J
 * (B - l_3^2 I),   the derivative of   W = mu/2 (tr B + l_3^2 - 3 - 2 ln J l_3) + lambda/4 (J^2 l_3^2 - 1 - 2
 * ln J l_3). */
#ifndef SOLID_ELEMENT_H
#define SOLID_ELEMENT_H
#include "plane.h"
#include <math.h>

typedef struct {
  double mu, lambda; /* Lame constants, Pa */
  double eta;        /* viscosity, Pa s */
  int sheet;         /* plane stress */
} ElementLaw;

typedef struct {
  double xx, yy, xy; /* Pa */
} ElementStress;

typedef struct {
  Point a, b, c;
} ElementForces;

/* Lame constants from Young's modulus (Pa) and Poisson's ratio. */
static inline ElementLaw ElementLawOf(double youngs_modulus, double poisson_ratio, double eta)
{
  return (ElementLaw){youngs_modulus / (2.0 * (1.0 + poisson_ratio)),
                      youngs_modulus * poisson_ratio / ((1.0 + poisson_ratio) * (1.0 - 2.0 * poisson_ratio)),
                      eta, 0};
}

static inline ElementStress ElementElasticStress(Tensor f, double j, double mu, double lambda)
{
  const double r = 1.0 / j, m = mu * r, volumetric = 0.5 * lambda * (j - r) - m;
  return (ElementStress){m * (f.xx * f.xx + f.xy * f.xy) + volumetric,
                         m * (f.yx * f.yx + f.yy * f.yy) + volumetric, m * (f.xx * f.yx + f.xy * f.yy)};
}

/* l_3^2: the square of a sheet's stretch across its plane. */
static inline double ElementThinning(double j, double mu, double lambda)
{
  return (mu + 0.5 * lambda) / (mu + 0.5 * lambda * j * j);
}

/* l_3 T in plane stress */
static inline ElementStress ElementSheetStress(Tensor f, double j, double mu, double lambda)
{
  const double m = mu / j, across = m * ElementThinning(j, mu, lambda);
  return (ElementStress){m * (f.xx * f.xx + f.xy * f.xy) - across, m * (f.yx * f.yx + f.yy * f.yy) - across,
                         m * (f.xx * f.yx + f.xy * f.yy)};
}

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

/* W: strain energy per unit of rest area, J/m3; written in F - I so that small strains keep their digits. */
static inline double ElementEnergy(Tensor f, ElementLaw law)
{
  const Tensor e = {f.xx - 1.0, f.xy, f.yx, f.yy - 1.0};
  const double trace = e.xx + e.yy, growth = trace + TensorDeterminant(e); /* J - 1 */
  const double square = e.xx * e.xx + e.xy * e.xy + e.yx * e.yx + e.yy * e.yy;
  double across = 0.0, squares = growth * (growth + 2.0), logarithm = log1p(growth); /* J^2 - 1, ln J */
  if (law.sheet) { /* l_3^2 - 1; then those of J l_3 */
    across = -0.5 * law.lambda * squares / (law.mu + 0.5 * law.lambda * (1.0 + squares));
    squares += across + squares * across;
    logarithm += 0.5 * log1p(across);
  }
  return 0.5 * law.mu * (2.0 * trace + square + across - 2.0 * logarithm) +
         0.25 * law.lambda * (squares - 2.0 * logarithm);
}

/* Bounds on what the element adds to M^-1 K and M^-1 C (K the tangent stiffness, C the viscous matrix, M the
 * lumped mass).  By Irons' theorem the largest over the elements bounds the whole mesh.  With g_i = grad N_i
 * and L = grad v,  sum_i |v_i|^2 >= |L|^2 / s,  s the largest eigenvalue of sum_i g_i g_i^T, and
 *     A L:a:L <= A |L|^2 a,   a = 2 mu/J + lambda (1/J - J) + 2 lambda J + max(principal stress, 0),
 * a being the tangent modulus of the law above with its geometric part.  A sheet's energy is the least over
 * l_3, so its tangent lies below that of the law with l_3 held: J^2 becomes (J l_3)^2 in 1/J (2 mu + lambda
 * ...). */
typedef struct {
  double stiffness; /* omega^2, 1/s2 */
  double damping;   /* 2 xi omega, 1/s */
} ElementRates;

static inline ElementRates ElementRatesOf(Tensor edges, Tensor f, double density, ElementLaw law)
{
  const double j = TensorDeterminant(f);
  const Tensor g = TensorInverse(edges); /* rows: gradients of N_b and N_c */
  const Point a = {-g.xx - g.yx, -g.xy - g.yy};
  const double xx = g.xx * g.xx + g.yx * g.yx + a.x * a.x, yy = g.xy * g.xy + g.yy * g.yy + a.y * a.y;
  const double xy = g.xx * g.xy + g.yx * g.yy + a.x * a.y;
  const double s = 0.5 * (xx + yy + sqrt((xx - yy) * (xx - yy) + 4.0 * xy * xy));
  const ElementStress t = law.sheet ? ElementSheetStress(f, j, law.mu, law.lambda)
                                    : ElementElasticStress(f, j, law.mu, law.lambda);
  const double principal = 0.5 * (t.xx + t.yy + sqrt((t.xx - t.yy) * (t.xx - t.yy) + 4.0 * t.xy * t.xy));
  const double volume = j * (law.sheet ? ElementThinning(j, law.mu, law.lambda) : 1.0); /* J l_3^2 */
  const double shear = 2.0 * law.mu / j + law.lambda * (1.0 / j - volume);
  const double modulus = fmax(shear, 0.0) + 2.0 * law.lambda * volume + fmax(principal, 0.0);
  const double per_mass = 3.0 * j * s / density; /* lumped: rho0 A0 / 3 a node */
  return (ElementRates){per_mass * modulus, per_mass * law.eta};
}

/* Largest stable step of semi-implicit Euler with the viscous force taken at the old velocity:
 * h^2 omega^2 + 2 h (2 xi omega) <= 4;  undamped this is 2/omega. */
static inline double ElementStableStep(ElementRates r)
{
  return 4.0 / (r.damping + sqrt(r.damping * r.damping + 4.0 * r.stiffness));
}
#endif
