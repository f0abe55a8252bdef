/* One element, all laws: rotation gives no force, an affine map its exact stress, forces are -dW/dx, the
 * viscous force dissipates, and the bounds of its frequencies hold. */
#include "solid/element.h"
#include "tests/solid/build.h"

static const Point REST[3] = {{0.1, -0.2}, {1.3, 0.1}, {0.4, 0.9}};

static Tensor Edges(const Point x[3])
{
  return TensorOfEdges(x[0], x[1], x[2]);
}

static Tensor Gradient(const Point x[3])
{
  return TensorProduct(Edges(x), TensorInverse(Edges(REST)));
}

static void Map(Tensor f, Point x[3])
{
  for (int i = 0; i < 3; i++)
    x[i] = (Point){f.xx * REST[i].x + f.xy * REST[i].y + 3.0, f.yx * REST[i].x + f.yy * REST[i].y - 2.0};
}

static ElementForces Forces(const Point x[3], ElementLaw law)
{
  const Tensor f = Gradient(x);
  const double j = TensorDeterminant(f);
  return ElementForcesOf(Edges(x), ElementElasticStress(f, j, law));
}

static double Energy(const Point x[3], ElementLaw law)
{
  const Tensor f = Gradient(x);
  return 0.5 * TensorDeterminant(Edges(REST)) * ElementEnergy(f, law);
}

static void Rotation(ElementLaw law)
{
  const double angle = 73.0 * M_PI / 180.0;
  Point x[3];
  Map((Tensor){cos(angle), -sin(angle), sin(angle), cos(angle)}, x);
  const ElementForces f = Forces(x, law);
  const double largest = fmax(fmax(hypot(f.a.x, f.a.y), hypot(f.b.x, f.b.y)), hypot(f.c.x, f.c.y));
  CHECK(largest < 1e-14 * law.mu, "force %g after a rotation", largest);
}

/* F = diag(2, 0.5 + ...): stress written out by hand. */
static void Affine(ElementLaw law)
{
  const Tensor f = {1.3, 0.2, -0.1, 0.8};
  const double j = 1.3 * 0.8 + 0.2 * 0.1, volumetric = 0.5 * law.lambda * (j - 1.0 / j);
  const double xx = law.mu / j * (1.3 * 1.3 + 0.2 * 0.2 - 1.0) + volumetric;
  const double yy = law.mu / j * (0.1 * 0.1 + 0.8 * 0.8 - 1.0) + volumetric;
  const double xy = law.mu / j * (1.3 * -0.1 + 0.2 * 0.8);
  const ElementStress t = ElementElasticStress(f, j, law);
  CHECK(fabs(t.xx - xx) + fabs(t.yy - yy) + fabs(t.xy - xy) < 1e-14 * law.mu, "%g %g %g", t.xx, t.yy, t.xy);
  /* small strains: Hooke's law in plane strain, sigma = E/((1+nu)(1-2nu)) [(1-nu) e_xx + nu e_yy] ... */
  const ElementStress s =
      ElementElasticStress((Tensor){1.0 + 1e-6, 0.0, 0.0, 1.0 - 2e-6}, (1.0 + 1e-6) * (1.0 - 2e-6), law);
  const double hooke = (law.lambda + 2.0 * law.mu) * 1e-6 - law.lambda * 2e-6;
  CHECK(fabs(s.xx - hooke) < 1e-5 * law.mu * 1e-6 * 10.0, "%g, Hooke %g", s.xx, hooke);
}

/* Plane stress: a pull along x with the strain across for which nothing acts across has sigma = E eps, and at
 * any stretch the full law's stress across the plane vanishes. */
static void PlaneStress(double young, double poisson)
{
  ElementLaw law = ElementLawOf(young, poisson, 0.0);
  law.plane_stress = 1;
  const double eps = 1e-7;
  const Tensor tension = {1.0 + eps, 0.0, 0.0, 1.0 - poisson * eps};
  const ElementStress s = ElementElasticStress(tension, TensorDeterminant(tension), law);
  CHECK(fabs(s.xx / (young * eps) - 1.0) < 1e-5, "sigma_xx %g, E eps %g", s.xx, young * eps);
  CHECK(fabs(s.yy) < 1e-5 * young * eps, "sigma_yy %g", s.yy);
  const double j = 1.7, thickness_stretch = ElementThinning(j, law.mu, law.lambda);
  const double zz = law.mu * (thickness_stretch - 1.0) + 0.5 * law.lambda * (j * j * thickness_stretch - 1.0);
  CHECK(fabs(zz) < 1e-14 * young, "stress across %g", zz);
}

/* The rotation of F = R U by Higham's iteration R <- (R + R^-T)/2, not by the kernel's closed form. */
static Tensor RotationOf(Tensor f)
{
  for (int k = 0; k < 60; k++) {
    const Tensor i = TensorInverse(f);
    f = (Tensor){0.5 * (f.xx + i.xx), 0.5 * (f.xy + i.yx), 0.5 * (f.yx + i.xy), 0.5 * (f.yy + i.yy)};
  }
  return f;
}

/* The corotated law as it is defined: P = 2 mu (F - R) + lambda (tr R^T F - 2) R, T = P F^T/J. */
static void Biot(ElementLaw law, Tensor f)
{
  const double j = TensorDeterminant(f), mu = law.mu;
  const double lambda = law.plane_stress ? 2.0 * law.lambda * mu / (law.lambda + 2.0 * mu) : law.lambda;
  const Tensor r = RotationOf(f);
  const double volumetric = lambda * (r.xx * f.xx + r.xy * f.xy + r.yx * f.yx + r.yy * f.yy - 2.0);
  const Tensor p = {
      2.0 * mu * (f.xx - r.xx) + volumetric * r.xx, 2.0 * mu * (f.xy - r.xy) + volumetric * r.xy,
      2.0 * mu * (f.yx - r.yx) + volumetric * r.yx, 2.0 * mu * (f.yy - r.yy) + volumetric * r.yy};
  const Tensor t = TensorProduct(p, (Tensor){f.xx, f.yx, f.xy, f.yy});
  const ElementStress s = ElementElasticStress(f, j, law);
  const double off = fmax(fmax(fabs(s.xx - t.xx / j), fabs(s.yy - t.yy / j)),
                          fmax(fabs(s.xy - t.xy / j), fabs(s.xy - t.yx / j)));
  CHECK(off < 1e-14 * mu * fmax(1.0, 1.0 / j), "corotated stress off by %g of mu", off / mu);
}

/* Poisson's ratio 0: pulled along x, turned by an angle, T = E (l - 1) along the turned axis and 0 across. */
static void Membrane(double young, double length)
{
  const double angle = 0.7, c = cos(angle), s = sin(angle);
  ElementLaw law = ElementLawOf(young, 0.0, 0.0);
  law.kind = LAW_COROTATED;
  for (law.plane_stress = 0; law.plane_stress < 2; law.plane_stress++) {
    const Tensor f = {c * length, -s, s * length, c};
    const ElementStress t = ElementElasticStress(f, TensorDeterminant(f), law);
    const double along = c * c * t.xx + 2.0 * c * s * t.xy + s * s * t.yy;
    const double thickness_stretch = s * s * t.xx - 2.0 * c * s * t.xy + c * c * t.yy;
    const double shear = c * s * (t.yy - t.xx) + (c * c - s * s) * t.xy;
    CHECK(fabs(along - young * (length - 1.0)) + fabs(thickness_stretch) + fabs(shear) <
              4e-15 * young * (1.0 + 1.0 / length),
          "stretch %g: T = %.16g E, across %g, shear %g", length, along / young, thickness_stretch / young,
          shear / young);
  }
}

/* Plane stress's thickness: with it the law in space, T_33 = 2 mu (l_3 - 1) + lambda (tr U + l_3 - 3), is free. */
static void CorotatedSheet(ElementLaw law, Tensor f)
{
  const double thickness_stretch = ElementThicknessStretch(f, TensorDeterminant(f), law);
  const Tensor r = RotationOf(f);
  const double trace = r.xx * f.xx + r.xy * f.xy + r.yx * f.yx + r.yy * f.yy;
  const double free_stress =
      2.0 * law.mu * (thickness_stretch - 1.0) + law.lambda * (trace + thickness_stretch - 3.0);
  CHECK(fabs(free_stress) < 1e-14 * law.mu, "stress across the plane %g", free_stress);
}

/* The stretch across a wall with free faces: nothing acts across, whatever acts along. St. Venant's law leaves no wall from 1.8 on. */
static void FreeWall(ElementLaw law)
{
  for (double along = 0.6; along < (law.kind == LAW_ST_VENANT_KIRCHHOFF ? 1.7 : 2.5); along += 0.3) {
    const Tensor f = {along, 0.0, 0.0, ElementFreeStretch(along, law)};
    const ElementStress t = ElementElasticStress(f, TensorDeterminant(f), law);
    CHECK(fabs(t.yy) < 1e-14 * law.mu, "stress across the wall %g, along it %g", t.yy, t.xx);
  }
}

static void EnergyGradient(ElementLaw law)
{
  Point x[3];
  Map((Tensor){1.2, 0.5, -0.3, 0.7}, x);
  const ElementForces f = Forces(x, law);
  const double *force = &f.a.x;
  double *coordinate = &x[0].x;
  for (int k = 0; k < 6; k++) {
    const double h = 1e-5, kept = coordinate[k];
    coordinate[k] = kept + h;
    const double up = Energy(x, law);
    coordinate[k] = kept - h;
    const double down = Energy(x, law);
    coordinate[k] = kept;
    const double expected = -(up - down) / (2.0 * h);
    CHECK(fabs(force[k] - expected) < 1e-8 * law.mu, "force %d is %.12g, -dW/dx %.12g", k, force[k],
          expected);
  }
}

/* Small strains keep their digits: Hooke's energy mu e:e + lambda/2 (tr e)^2. */
static void SmallEnergy(ElementLaw law)
{
  const double e = 1e-9, lambda = law.plane_stress ? 2.0 * law.lambda * law.mu / (law.lambda + 2.0 * law.mu)
                                                   : law.lambda;
  const double hooke = law.mu * (1.0 + 4.0 + 2.0 * 2.25) * e * e + 0.5 * lambda * e * e;
  const double w = ElementEnergy((Tensor){1.0 + 2.0 * e, 1.5 * e, 1.5 * e, 1.0 - e}, law);
  CHECK(fabs(w / hooke - 1.0) < 1e-6, "energy %g, Hooke %g", w, hooke);
}

/* The viscous power is eta |sym grad v|^2 A. */
static void Dissipation(void)
{
  const double eta = 3.0;
  const Point v[3] = {{0.3, -0.7}, {1.1, 0.2}, {-0.4, 0.5}};
  const Tensor l = TensorProduct(Edges(v), TensorInverse(Edges(REST)));
  const ElementForces f = ElementForcesOf(Edges(REST), ElementViscousStress(Edges(REST), Edges(v), eta));
  const double power =
      f.a.x * v[0].x + f.a.y * v[0].y + f.b.x * v[1].x + f.b.y * v[1].y + f.c.x * v[2].x + f.c.y * v[2].y;
  const double shear = 0.5 * (l.xy + l.yx);
  const double expected =
      -0.5 * TensorDeterminant(Edges(REST)) * eta * (l.xx * l.xx + l.yy * l.yy + 2.0 * shear * shear);
  CHECK(fabs(power / expected - 1.0) < 1e-13, "power %g, expected %g", power, expected);
}

/* Rayleigh quotients d.K.d/(m d.d) of the tangent stiffness, by differences of forces, in many directions:
 * none is above the bound and the best found by power iteration comes near it; shifted, for a compressed
 * element has negative ones that are larger. */
static double Quotient(const Point x[3], ElementLaw law, double mass, double shift, double d[6])
{
  const double h = 1e-6;
  double quotient = 0.0, norm = 0.0, image[6];
  Point up[3], down[3];
  for (int k = 0; k < 6; k++) {
    (&up[0].x)[k] = (&x[0].x)[k] + h * d[k];
    (&down[0].x)[k] = (&x[0].x)[k] - h * d[k];
  }
  const ElementForces fu = Forces(up, law), fd = Forces(down, law);
  for (int k = 0; k < 6; k++) {
    image[k] = -((&fu.a.x)[k] - (&fd.a.x)[k]) / (2.0 * h * mass);
    quotient += d[k] * image[k];
    image[k] += shift * d[k];
    norm += image[k] * image[k];
  }
  for (int k = 0; k < 6; k++) d[k] = image[k] / sqrt(norm);
  return quotient;
}

static void Bound(ElementLaw law, Tensor f, double shift, double least)
{
  const double density = 1000.0, mass = density * TensorDeterminant(Edges(REST)) / 6.0;
  double d[6] = {0.5, -0.3, 0.4, 0.3, -0.4, 0.5}, largest = 0.0;
  Point x[3];
  Map(f, x);
  const ElementRates rates = ElementRatesOf(Edges(x), f, density, law);
  for (int k = 0; k < 200 * (1 + 10 * (int)shift); k++)
    largest = fmax(largest, Quotient(x, law, mass, shift * rates.stiffness, d));
  if (getenv("VERBOSE")) printf("omega^2 is %.3f of its bound\n", largest / rates.stiffness);
  CHECK(largest <= rates.stiffness * (1.0 + 1e-6), "omega^2 %g is above its bound %g", largest,
        rates.stiffness);
  CHECK(largest >= least * rates.stiffness, "omega^2 %g is far below its bound %g", largest, rates.stiffness);
}

/* St. Venant's law as it is defined: T = F (2 mu E + lambda tr E I) F^T/J, E = (F^T F - I)/2. */
static void Green(ElementLaw law, Tensor f)
{
  const double j = TensorDeterminant(f), mu = law.mu;
  const double lambda = law.plane_stress ? 2.0 * law.lambda * mu / (law.lambda + 2.0 * mu) : law.lambda;
  const double xx = 0.5 * (f.xx * f.xx + f.yx * f.yx - 1.0), yy = 0.5 * (f.xy * f.xy + f.yy * f.yy - 1.0),
               xy = 0.5 * (f.xx * f.xy + f.yx * f.yy), volumetric = lambda * (xx + yy);
  const Tensor second = {2.0 * mu * xx + volumetric, 2.0 * mu * xy, 2.0 * mu * xy,
                         2.0 * mu * yy + volumetric};
  const Tensor t = TensorProduct(TensorProduct(f, second), (Tensor){f.xx, f.yx, f.xy, f.yy});
  const ElementStress s = ElementElasticStress(f, j, law);
  const double off = fmax(fabs(s.xx - t.xx / j), fmax(fabs(s.yy - t.yy / j), fabs(s.xy - t.xy / j)));
  CHECK(off < 2e-14 * mu * fmax(1.0, 1.0 / j), "St. Venant's stress off by %g of mu", off / mu);
  if (!law.plane_stress || !ElementAdmissible(f, j, law)) return;
  const double thickness_stretch = ElementThicknessStretch(f, j, law),
               strain = 0.5 * (thickness_stretch * thickness_stretch - 1.0);
  const double free_stress = 2.0 * mu * strain + law.lambda * (xx + yy + strain);
  CHECK(fabs(free_stress) < 1e-14 * mu, "stress across the plane %g", free_stress);
}

static void StVenant(ElementLaw law)
{
  static const Tensor MAPS[] = {{1.0, 0.0, 0.0, 1.0}, {1.4, 0.3, -0.2, 0.9},  {0.5, 0.1, 0.3, 0.7},
                                {2.0, 0.0, 0.0, 0.9}, {-1.2, 0.3, 0.1, -0.8}, {0.6, -0.5, 0.4, 0.9}};
  law.kind = LAW_ST_VENANT_KIRCHHOFF;
  for (law.plane_stress = 0; law.plane_stress < 2; law.plane_stress++) {
    Rotation(law);
    EnergyGradient(law);
    SmallEnergy(law);
    for (size_t k = 0; k < sizeof MAPS / sizeof *MAPS; k++) {
      Green(law, MAPS[k]);
      Bound(law, MAPS[k], 20.0, 0.5);
    }
  }
  law.plane_stress = 0;
  FreeWall(law);
}

static void Corotated(ElementLaw law)
{
  static const Tensor MAPS[] = {{1.0, 0.0, 0.0, 1.0},  {1.4, 0.3, -0.2, 0.9},  {0.5, 0.1, 0.3, 0.7},
                                {0.05, 0.0, 0.0, 0.1}, {-1.2, 0.3, 0.1, -0.8}, {0.1, -1.5, 0.4, 0.2},
                                {0.01, 0.0, 0.0, 2.0}};
  law.kind = LAW_COROTATED;
  for (law.plane_stress = 0; law.plane_stress < 2; law.plane_stress++) {
    Rotation(law);
    EnergyGradient(law);
    SmallEnergy(law);
    FreeWall(law);
    for (size_t k = 0; k < sizeof MAPS / sizeof *MAPS; k++) {
      Biot(law, MAPS[k]);
      Bound(law, MAPS[k], 20.0, 0.5);
      if (law.plane_stress) CorotatedSheet(law, MAPS[k]);
    }
  }
  for (double length = 0.1; length < 6.0; length *= 1.5) Membrane(1.0e6, length);
}

int main(void)
{
  const ElementLaw law = ElementLawOf(1.0e6, 0.3, 0.0);
  ElementLaw plane_stress = law;
  plane_stress.plane_stress = 1;
  CHECK(fabs(law.mu / 384615.384615384615 - 1.0) < 1e-14 &&
            fabs(law.lambda / 576923.076923076923 - 1.0) < 1e-14,
        "Lame constants %g %g", law.mu, law.lambda);
  Rotation(law);
  Affine(law);
  EnergyGradient(law);
  Dissipation();
  Rotation(plane_stress);
  EnergyGradient(plane_stress);
  PlaneStress(1.0e6, 0.3);
  SmallEnergy(law);
  SmallEnergy(plane_stress);
  FreeWall(law);
  FreeWall(plane_stress);
  Corotated(law);
  StVenant(law);
  Bound(plane_stress, (Tensor){1.0, 0.0, 0.0, 1.0}, 0.0, 0.3);
  Bound(plane_stress, (Tensor){1.4, 0.3, -0.2, 0.9}, 0.0, 0.2);
  Bound(plane_stress, (Tensor){0.5, 0.1, 0.3, 0.7}, 0.0, 0.2);
  Bound(law, (Tensor){1.0, 0.0, 0.0, 1.0}, 0.0, 0.5);
  Bound(law, (Tensor){1.4, 0.3, -0.2, 0.9}, 0.0, 0.3);
  Bound(law, (Tensor){0.5, 0.1, 0.3, 0.7}, 0.0, 0.3);
  return 0;
}
