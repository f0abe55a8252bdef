/* Stress and energy of the elastic laws, per metre of depth (or of rest thickness: what has a thickness has its constants multiplied by
 * it).  Pointwise; F the gradient of the position, J = det F, B = F F^T, C = F^T F; all Cauchy stresses have the form b B + c I.
 *
 * All laws have an energy W per unit of rest volume, T = dW/dF F^T/J, so that nodal forces are -d(sum W A0)/dx.
 *
 * Neo-Hookean:
 *     W = mu/2 (tr B - 2 - 2 ln J) + lambda/4 (J^2 - 1 - 2 ln J),    T = mu/J (B - I) + lambda/2 (J - 1/J) I
 * (B_33 = 1).  In plane stress the thickness stretch l_3 is such that T_33 = 0:
 *     mu (l_3^2 - 1) + lambda/2 (J^2 l_3^2 - 1) = 0,   l_3^2 = (mu + lambda/2)/(mu + lambda/2 J^2),
 * J the in-plane determinant as above, and the stress times l_3 (per unit of rest thickness) becomes
 *     l_3 T = mu/J (B - l_3^2 I),   the derivative of   W = mu/2 (tr B + l_3^2 - 3 - 2 ln J l_3)
 *                                                         + lambda/4 (J^2 l_3^2 - 1 - 2 ln J l_3).
 *
 * Corotated, linear in the Biot strain U - I, F = R U with R a rotation:
 *     W = mu |F - R|^2 + lambda/2 (tr U - 2)^2,    dW/dF = 2 mu (F - R) + lambda (tr U - 2) R.
 * In the plane q = tr U is the length of (F_xx + F_yy, F_yx - F_xy), and with V = F R^T = (B + J I)/q
 *     T = (2 mu + w)/J B + w I,    w = (lambda (q - 2) - 2 mu)/q.
 * Pulled along x alone, with Poisson's ratio 0, T_xx = E (l_x - 1), a line membrane's law.  It is meant for what is stretched:
 * squeezed below q = 2 (mu + lambda)/(2 mu + lambda) its shear waves have no real speed any more,
 * rho c^2 = mu + (mu + lambda)(1 - 2/q) < 0, and it wrinkles.
 *
 * St. Venant and Kirchhoff, linear in Green's strain E = (C - I)/2:
 *     W = mu E:E + lambda/2 (tr E)^2,    T = F (2 mu E + lambda tr E I) F^T/J = (2 mu (tr E + 1/2) + lambda tr E)/J B - mu J I
 * (B B = tr B B - J^2 I in the plane).  For large turns and small strains; squeezed to less than 0.58 of a length it is unstable.
 *
 * Plane stress of the last two: T_33 = 0 makes l_3 = 1 - lambda (q - 2)/(lambda + 2 mu), l_3^2 = 1 - 2 lambda tr E/(lambda + 2 mu),
 * and l_3 T and W have 2 lambda mu/(lambda + 2 mu) for lambda. */
#ifndef SOLID_ELEMENT_LAW_H
#define SOLID_ELEMENT_LAW_H
#include "solid/plane.h"
#include <math.h>

typedef enum { LAW_NEO_HOOKEAN, LAW_COROTATED, LAW_ST_VENANT_KIRCHHOFF } ElementLawKind;

typedef struct {
  double mu, lambda; /* Lame constants, Pa */
  double eta;        /* viscosity, Pa s */
  int plane_stress;  /* else plane strain */
  int kind;          /* ElementLawKind */
} ElementLaw;

typedef struct {
  double xx, yy, xy; /* Pa */
} ElementStress;

/* Lame constants from Young's modulus (Pa) and Poisson's ratio. */
static inline ElementLaw ElementLawOf(double youngs_modulus, double poisson_ratio, double eta)
{
  return (ElementLaw){youngs_modulus / (2.0 * (1.0 + poisson_ratio)),
                      youngs_modulus * poisson_ratio / ((1.0 + poisson_ratio) * (1.0 - 2.0 * poisson_ratio)),
                      eta, 0, LAW_NEO_HOOKEAN};
}

/* Which laws a loop must know, each with those before it; the first: the neo-Hookean in plane strain. */
typedef enum { STRAIN_ONLY, WITH_PLANE_STRESS, ALL_LAWS } ElementLaws;

static inline ElementLaws ElementLawsWith(ElementLaw law)
{
  if (law.kind != LAW_NEO_HOOKEAN) return ALL_LAWS;
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

/* tr E: 0 at rest */
static inline double ElementTraceGreen(Tensor f)
{
  return 0.5 * (f.xx * f.xx + f.xy * f.xy + f.yx * f.yx + f.yy * f.yy - 2.0);
}

/* lambda of the corotated law and St. Venant's. */
static inline double ElementPlaneLambda(ElementLaw law)
{
  return law.plane_stress ? 2.0 * law.lambda * law.mu / (law.lambda + 2.0 * law.mu) : law.lambda;
}

static inline ElementCoefficients ElementCorotated(Tensor f, double j, ElementLaw law)
{
  const double q = ElementTraceU(f), w = (ElementPlaneLambda(law) * (q - 2.0) - 2.0 * law.mu) / q;
  return (ElementCoefficients){(2.0 * law.mu + w) * (1.0 / j), w}; /* 1/j: the other law needs it too */
}

static inline ElementCoefficients ElementStVenant(Tensor f, double j, ElementLaw law)
{
  const double trace = ElementTraceGreen(f);
  return (ElementCoefficients){(2.0 * law.mu * (trace + 0.5) + ElementPlaneLambda(law) * trace) * (1.0 / j),
                               -law.mu * j};
}

/* What plane stress leaves of the thickness, 1 at rest: l_3^2 of St. Venant's law, l_3 of the corotated one, not > 0 where there is
 * none; not of the neo-Hookean law, whose thickness does not vanish. */
static inline double ElementThicknessLeft(Tensor f, ElementLaw law)
{
  const double strain = law.kind == LAW_COROTATED ? ElementTraceU(f) - 2.0 : 2.0 * ElementTraceGreen(f);
  return 1.0 - law.lambda * strain / (law.lambda + 2.0 * law.mu);
}

/* Not inside out; in plane stress the thickness of laws that are linear in a strain may fall to 0 too. */
static inline int ElementAdmissible(Tensor f, double j, ElementLaw law)
{
  const int thick = ElementThicknessLeft(f, law) > 0.0;
  return (j > 0.0) & (thick | !law.plane_stress | (law.kind == LAW_NEO_HOOKEAN));
}

/* l_3: 1 in plane strain. */
static inline double ElementThicknessStretch(Tensor f, double j, ElementLaw law)
{
  if (!law.plane_stress) return 1.0;
  if (law.kind == LAW_NEO_HOOKEAN) return sqrt(ElementThinning(j, law.mu, law.lambda));
  const double left = ElementThicknessLeft(f, law);
  return law.kind == LAW_COROTATED ? left : sqrt(left);
}

/* l_3 T of the elastic law.  No branches: the element loop selects per lane, and drops what a constant law
 * does not need. */
static inline ElementStress ElementElasticStress(Tensor f, double j, ElementLaw law)
{
  const ElementCoefficients neo = ElementNeoHookean(j, law.mu, law.lambda),
                            biot = ElementCorotated(f, j, law), green = ElementStVenant(f, j, law);
  const double plane = -neo.b * ElementThinning(j, law.mu, law.lambda);
  const double one = law.plane_stress ? plane : neo.one;
  const double b = law.kind == LAW_COROTATED ? biot.b : green.b,
               c = law.kind == LAW_COROTATED ? biot.one : green.one;
  return ElementStressFrom(f, (ElementCoefficients){law.kind == LAW_NEO_HOOKEAN ? neo.b : b,
                                                    law.kind == LAW_NEO_HOOKEAN ? one : c});
}

/* l_n: the stretch across a wall whose faces are free of stress (T_nn = 0; plane stress's T_33 too), stretched by
 * `along`.  Not > 0 where a law that is linear in a strain leaves no wall. */
static inline double ElementFreeStretch(double along, ElementLaw law)
{
  const double mu = law.mu, lambda = law.lambda, half = mu + 0.5 * lambda, square = along * along;
  const double ratio = ElementPlaneLambda(law) / (2.0 * mu + ElementPlaneLambda(law));
  if (law.kind == LAW_COROTATED) return 1.0 - ratio * (along - 1.0);
  if (law.kind == LAW_ST_VENANT_KIRCHHOFF) return sqrt(1.0 - ratio * (square - 1.0));
  if (law.plane_stress) /* l_n = l_3: lambda/2 l_t^2 l_n^4 + mu l_n^2 = mu + lambda/2 */
    return sqrt(2.0 * half / (mu + sqrt(mu * mu + 2.0 * lambda * half * square)));
  return sqrt(half / (mu + 0.5 * lambda * square));
}

/* With g = q - 2, d the difference of U's eigenvalues and |U - I|^2 = (g^2 + d^2)/2. */
static inline double ElementCorotatedEnergy(Tensor e, ElementLaw law)
{
  const double trace = e.xx + e.yy, turn = e.yx - e.xy, stretch = e.xx - e.yy, shear = e.xy + e.yx;
  const double q = sqrt((2.0 + trace) * (2.0 + trace) + turn * turn);
  const double g = ((4.0 + trace) * trace + turn * turn) / (q + 2.0);
  return 0.5 * law.mu * (g * g + stretch * stretch + shear * shear) + 0.5 * ElementPlaneLambda(law) * g * g;
}

/* In e = F - I. */
static inline double ElementStVenantEnergy(Tensor e, ElementLaw law)
{
  const double xx = e.xx + 0.5 * (e.xx * e.xx + e.yx * e.yx), yy = e.yy + 0.5 * (e.xy * e.xy + e.yy * e.yy);
  const double xy = 0.5 * (e.xy + e.yx + e.xx * e.xy + e.yx * e.yy);
  return law.mu * (xx * xx + yy * yy + 2.0 * xy * xy) + 0.5 * ElementPlaneLambda(law) * (xx + yy) * (xx + yy);
}

/* W: strain energy per unit of rest area, J/m3; written in F - I so that small strains keep their digits. */
static inline double ElementEnergy(Tensor f, ElementLaw law)
{
  const Tensor e = {f.xx - 1.0, f.xy, f.yx, f.yy - 1.0};
  const double trace = e.xx + e.yy, growth = trace + TensorDeterminant(e); /* J - 1 */
  if (law.kind == LAW_COROTATED) return ElementCorotatedEnergy(e, law);
  if (law.kind == LAW_ST_VENANT_KIRCHHOFF) return ElementStVenantEnergy(e, law);
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
#endif
