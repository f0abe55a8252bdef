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
 * That is plane strain.  In plane stress the thickness stretch l_3 is such that T_33 = 0 for the same solid law:
 *     mu (l_3^2 - 1) + lambda/2 (J^2 l_3^2 - 1) = 0,   l_3^2 = (mu + lambda/2)/(mu + lambda/2 J^2),
 * J the in-plane determinant as above, and the stress times l_3 (per unit of rest thickness) becomes
 *     l_3 T = mu/J (B - l_3^2 I),   the derivative of   W = mu/2 (tr B + l_3^2 - 3 - 2 ln J l_3)
 *                                                         + lambda/4 (J^2 l_3^2 - 1 - 2 ln J l_3).
 *
 * A second law, corotated, is linear in the Biot strain U - I, F = R U with R a rotation:
 *     W = mu |F - R|^2 + lambda/2 (tr U - 2)^2,    dW/dF = 2 mu (F - R) + lambda (tr U - 2) R.
 * In the plane q = tr U is the length of (F_xx + F_yy, F_yx - F_xy), and with V = F R^T = (B + J I)/q
 *     T = (2 mu + w)/J B + w I,    w = (lambda (q - 2) - 2 mu)/q.
 * Pulled along x alone, with Poisson's ratio 0, T_xx = E (l_x - 1), a line membrane's law.  In plane stress
 * T_33 = 0 makes l_3 = 1 - lambda (q - 2)/(lambda + 2 mu), and l_3 T, W have 2 lambda mu/(lambda + 2 mu) for
 * lambda.  It is meant for what is stretched: squeezed below q = 2 (mu + lambda)/(2 mu + lambda) its shear
 * waves have no real speed any more, rho c^2 = mu + (mu + lambda)(1 - 2/q) < 0, and it wrinkles. */
#ifndef SOLID_ELEMENT_H
#define SOLID_ELEMENT_H
#include "solid/plane.h"
#include <math.h>

typedef enum { LAW_NEO_HOOKEAN, LAW_COROTATED } ElementLawKind;

typedef struct {
  double mu, lambda; /* Lame constants, Pa */
  double eta;        /* viscosity, Pa s */
  int plane_stress;  /* else plane strain */
  int kind;          /* ElementLawKind */
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
                      eta, 0, LAW_NEO_HOOKEAN};
}

/* Which laws a loop must know, each with those before it; the first: the neo-Hookean in plane strain. */
typedef enum { STRAIN_ONLY, WITH_PLANE_STRESS, WITH_COROTATED } ElementLaws;

static inline ElementLaws ElementLawsWith(ElementLaw law)
{
  if (law.kind == LAW_COROTATED) return WITH_COROTATED;
  return law.plane_stress ? WITH_PLANE_STRESS : STRAIN_ONLY;
}

/* Of a stress T = b B + one I. */
typedef struct {
  double b, one; /* Pa */
} ElementCoefficients;

static inline ElementStress ElementStressFrom(Tensor f, ElementCoefficients c)
{
  return (ElementStress){c.b * (f.xx * f.xx + f.xy * f.xy) + c.one, c.b * (f.yx * f.yx + f.yy * f.yy) + c.one,
                         c.b * (f.xx * f.yx + f.xy * f.yy)};
}

/* Neo-Hookean, plane strain. */
static inline ElementCoefficients ElementNeoHookean(double j, double mu, double lambda)
{
  const double r = 1.0 / j, m = mu * r;
  return (ElementCoefficients){m, 0.5 * lambda * (j - r) - m};
}

/* l_3^2: the square of a neo-Hookean element's thickness stretch in plane stress. */
static inline double ElementThinning(double j, double mu, double lambda)
{
  return (mu + 0.5 * lambda) / (mu + 0.5 * lambda * j * j);
}

/* q = tr U: 2 at rest */
static inline double ElementTraceU(Tensor f)
{
  const double sum = f.xx + f.yy, turn = f.yx - f.xy;
  return sqrt(sum * sum + turn * turn);
}

/* The corotated law's lambda. */
static inline double ElementPlaneLambda(ElementLaw law)
{
  return law.plane_stress ? 2.0 * law.lambda * law.mu / (law.lambda + 2.0 * law.mu) : law.lambda;
}

static inline ElementCoefficients ElementCorotated(Tensor f, double j, ElementLaw law)
{
  const double q = ElementTraceU(f), w = (ElementPlaneLambda(law) * (q - 2.0) - 2.0 * law.mu) / q;
  return (ElementCoefficients){(2.0 * law.mu + w) * (1.0 / j), w}; /* 1/j: the other law needs it too */
}

/* Not inside out; in plane stress a corotated element's l_3, linear in U, may fall to 0 too. */
static inline int ElementAdmissible(Tensor f, double j, ElementLaw law)
{
  const int thick = law.lambda * (ElementTraceU(f) - 2.0) < law.lambda + 2.0 * law.mu;
  return (j > 0.0) & (thick | !law.plane_stress | (law.kind != LAW_COROTATED));
}

/* l_3: 1 in plane strain. */
static inline double ElementThicknessStretch(Tensor f, double j, ElementLaw law)
{
  const double linear = 1.0 - law.lambda * (ElementTraceU(f) - 2.0) / (law.lambda + 2.0 * law.mu);
  const double thickness_stretch =
      law.kind == LAW_COROTATED ? linear : sqrt(ElementThinning(j, law.mu, law.lambda));
  return law.plane_stress ? thickness_stretch : 1.0;
}

/* l_3 T of the elastic law.  No branches: the element loop selects per lane, and drops what a constant law
 * does not need. */
static inline ElementStress ElementElasticStress(Tensor f, double j, ElementLaw law)
{
  const ElementCoefficients neo = ElementNeoHookean(j, law.mu, law.lambda),
                            linear = ElementCorotated(f, j, law);
  const double plane = -neo.b * ElementThinning(j, law.mu, law.lambda);
  const double one = law.plane_stress ? plane : neo.one;
  return ElementStressFrom(f, (ElementCoefficients){law.kind == LAW_COROTATED ? linear.b : neo.b,
                                                    law.kind == LAW_COROTATED ? linear.one : one});
}

/* l_n: the stretch across a wall whose faces are free of stress (T_nn = 0; plane stress's T_33 too), stretched by
 * `along`.  Not > 0 where the corotated law leaves no wall. */
static inline double ElementFreeStretch(double along, ElementLaw law)
{
  const double mu = law.mu, lambda = law.lambda, half = mu + 0.5 * lambda, square = along * along;
  if (law.kind == LAW_COROTATED)
    return 1.0 - ElementPlaneLambda(law) * (along - 1.0) / (2.0 * mu + ElementPlaneLambda(law));
  if (law.plane_stress) /* l_n = l_3: lambda/2 l_t^2 l_n^4 + mu l_n^2 = mu + lambda/2 */
    return sqrt(2.0 * half / (mu + sqrt(mu * mu + 2.0 * lambda * half * square)));
  return sqrt(half / (mu + 0.5 * lambda * square));
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

/* With g = q - 2, d the difference of U's eigenvalues and |U - I|^2 = (g^2 + d^2)/2. */
static inline double ElementCorotatedEnergy(Tensor e, ElementLaw law)
{
  const double trace = e.xx + e.yy, turn = e.yx - e.xy, stretch = e.xx - e.yy, shear = e.xy + e.yx;
  const double q = sqrt((2.0 + trace) * (2.0 + trace) + turn * turn);
  const double g = ((4.0 + trace) * trace + turn * turn) / (q + 2.0);
  return 0.5 * law.mu * (g * g + stretch * stretch + shear * shear) + 0.5 * ElementPlaneLambda(law) * g * g;
}

/* W: strain energy per unit of rest area, J/m3; written in F - I so that small strains keep their digits. */
static inline double ElementEnergy(Tensor f, ElementLaw law)
{
  const Tensor e = {f.xx - 1.0, f.xy, f.yx, f.yy - 1.0};
  const double trace = e.xx + e.yy, growth = trace + TensorDeterminant(e); /* J - 1 */
  if (law.kind == LAW_COROTATED) return ElementCorotatedEnergy(e, law);
  const double square = e.xx * e.xx + e.xy * e.xy + e.yx * e.yx + e.yy * e.yy;
  double thinning = 0.0, squares = growth * (growth + 2.0), logarithm = log1p(growth); /* J^2 - 1, ln J */
  if (law.plane_stress) { /* l_3^2 - 1; then those of J l_3 */
    thinning = -0.5 * law.lambda * squares / (law.mu + 0.5 * law.lambda * (1.0 + squares));
    squares += thinning + squares * thinning;
    logarithm += 0.5 * log1p(thinning);
  }
  return 0.5 * law.mu * (2.0 * trace + square + thinning - 2.0 * logarithm) +
         0.25 * law.lambda * (squares - 2.0 * logarithm);
}

/* Bounds on what the element adds to M^-1 K and M^-1 C (K the tangent stiffness, C the viscous matrix, M the
 * lumped mass).  By Irons' theorem the largest over the elements bounds the whole mesh.  With g_i = grad N_i
 * and L = grad v,  sum_i |v_i|^2 >= |L|^2 / s,  s the largest eigenvalue of sum_i g_i g_i^T, and
 *     A L:a:L <= A |L|^2 a,   a = 2 mu/J + lambda (1/J - J) + 2 lambda J + max(principal stress, 0),
 * a being the tangent modulus of the law above with its geometric part.  Plane stress's energy is the least over
 * l_3, so its tangent lies below that of the law with l_3 fixed: J^2 becomes (J l_3)^2 in 1/J (2 mu + lambda
 * ...).
 *
 * The corotated law's W = mu/2 d^2 + (mu + lambda)/2 (q - 2)^2 (see its energy) is, d being linear in F and q
 * the length of a vector linear in F, a function of F with the second derivatives 2 mu, 2 mu, 2 (mu + lambda)
 * and 2 (mu + lambda)(1 - 2/q) in orthogonal directions: at most a = 2 (mu + lambda), whatever F.  With the
 * gradients at rest in s the bound of a body does not change in time. */
typedef struct {
  double stiffness; /* omega^2, 1/s2 */
  double damping;   /* 2 xi omega, 1/s */
} ElementRates;

/* s; rows of g: gradients of N_b and N_c, 1/m */
static inline double ElementSpread(Tensor g)
{
  const Point a = {-g.xx - g.yx, -g.xy - g.yy};
  const double xx = g.xx * g.xx + g.yx * g.yx + a.x * a.x, yy = g.xy * g.xy + g.yy * g.yy + a.y * a.y;
  const double xy = g.xx * g.xy + g.yx * g.yy + a.x * a.y;
  return 0.5 * (xx + yy + sqrt((xx - yy) * (xx - yy) + 4.0 * xy * xy));
}

/* A bound of A L:a:L / A |L|^2 of the neo-Hookean law */
static inline double ElementModulus(Tensor f, double j, ElementLaw law)
{
  const ElementStress t = ElementElasticStress(f, j, law);
  const double principal = 0.5 * (t.xx + t.yy + sqrt((t.xx - t.yy) * (t.xx - t.yy) + 4.0 * t.xy * t.xy));
  const double volume = j * (law.plane_stress ? ElementThinning(j, law.mu, law.lambda) : 1.0); /* J l_3^2 */
  const double shear = 2.0 * law.mu / j + law.lambda * (1.0 / j - volume);
  return (shear > 0.0 ? shear : 0.0) + 2.0 * law.lambda * volume + (principal > 0.0 ? principal : 0.0);
}

static inline ElementRates ElementRatesOf(Tensor edges, Tensor f, double density, ElementLaw law)
{
  const double j = TensorDeterminant(f);
  const Tensor g = TensorInverse(edges);
  const double per_mass = 3.0 * j * ElementSpread(g) / density; /* lumped: rho0 A0 / 3 a node */
  const double stiffness = law.kind == LAW_COROTATED ? 6.0 * (law.mu + ElementPlaneLambda(law)) *
                                                           ElementSpread(TensorProduct(g, f)) / density
                                                     : per_mass * ElementModulus(f, j, law);
  return (ElementRates){stiffness, per_mass * law.eta};
}

/* Largest stable step of semi-implicit Euler with the viscous force taken at the old velocity:
 * h^2 omega^2 + 2 h (2 xi omega) <= 4;  undamped this is 2/omega. */
static inline double ElementStableStep(ElementRates r)
{
  return 4.0 / (r.damping + sqrt(r.damping * r.damping + 4.0 * r.stiffness));
}
#endif
