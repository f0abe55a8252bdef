// ranks: 1 2 3
/* Patch test on a shaken mesh, three and six nodes, all laws, plane strain and plane stress: a finite rotation by 73 degrees
 * leaves no force; a pull, a shear and a general affine map a uniform exact stress and no force inside; rest
 * coordinates are kept apart from positions. */
#include "tests/solid/build.h"

static const double E = 2.0e6, NU = 0.3, THICKNESS = 0.25;

static double LargestForce(Solid s, int inside_only)
{
  SolidView v = ViewOf(s, NULL, NULL);
  const double *force;
  char *outer = calloc((size_t)v.nnodes + 1, 1);
  double largest = 0.0;
  (void)SolidForces(s, &force);
  for (int n = 0; n < v.nnodes; n++) /* the unit square's sides, at rest */
    outer[n] = fabs(v.rest[2 * n]) > 0.4999 || fabs(v.rest[2 * n + 1]) > 0.4999;
  for (int n = 0; n < v.nnodes; n++)
    if (!inside_only || !outer[n]) largest = fmax(largest, hypot(force[2 * n], force[2 * n + 1]));
  free(outer);
  return largest;
}

/* BIOT: corotated; GREEN: St. Venant and Kirchhoff */
typedef enum { STRAIN, STRESS, BIOT_STRAIN, BIOT_STRESS, GREEN_STRAIN, GREEN_STRESS, NLAWS } Law;

static PetscErrorCode Mapped(const double f[4], Law law, int six_node, Solid *s)
{
  BodySetup setup = BodyAtRest(MaterialOf(1000.0, E, 0.3, 0.0));
  const SolidSetup options = {.courant = 0.5};
  Model a = {0};
  double *x;
  setup.material.plane_stress = law % 2;
  setup.material.law = law / 2;
  setup.material.thickness = THICKNESS;
  setup.six_node = six_node;
  AddRectangle(&a, 0.0, 0.0, 1.0, 1.0, 0.0, 0.1, 1, &setup);
  PetscCall(SolidCreate(PETSC_COMM_WORLD, &a, &options, s));
  SolidView v = ViewOf(*s, &x, NULL);
  for (int n = 0; n < v.nnodes; n++) {
    x[2 * n] = f[0] * v.rest[2 * n] + f[1] * v.rest[2 * n + 1] + 5.0;
    x[2 * n + 1] = f[2] * v.rest[2 * n] + f[3] * v.rest[2 * n + 1] - 7.0;
  }
  return ModelDestroy(&a);
}

static PetscErrorCode Rotation(Law law, int six_node)
{
  const double angle = 73.0 * M_PI / 180.0, f[4] = {cos(angle), -sin(angle), sin(angle), cos(angle)};
  Solid s;
  PetscCall(Mapped(f, law, six_node, &s));
  const double largest = LargestForce(s, 0);
  CHECK(largest < 1e-13 * E, "a rotation leaves a force of %g, %g of E", largest, largest / E);
  return SolidDestroy(&s);
}

/* Cauchy's stress of the affine map f, neo-Hookean; of plane stress with its stretch across, found by bisection so
 * that nothing acts across. */
static void ExactStress(const double f[4], int plane_stress, double stress[3])
{
  const double mu = E / (2.0 * (1.0 + NU)), lambda = NU * E / ((1.0 + NU) * (1.0 - 2.0 * NU));
  const double plane = f[0] * f[3] - f[1] * f[2];
  double low = 0.1, high = 10.0, thickness_stretch = 1.0;
  while (plane_stress && high - low > 1e-15) {
    thickness_stretch = 0.5 * (low + high);
    const double j = plane * thickness_stretch;
    *(mu / j * (thickness_stretch * thickness_stretch - 1.0) + 0.5 * lambda * (j - 1.0 / j) > 0.0 ? &high
                                                                                                  : &low) =
        thickness_stretch;
    if (thickness_stretch <= low && thickness_stretch >= high) break;
  }
  const double j = plane * thickness_stretch, volumetric = 0.5 * lambda * (j - 1.0 / j);
  stress[0] = mu / j * (f[0] * f[0] + f[1] * f[1] - 1.0) + volumetric;
  stress[1] = mu / j * (f[2] * f[2] + f[3] * f[3] - 1.0) + volumetric;
  stress[2] = mu / j * (f[0] * f[2] + f[1] * f[3]);
}

/* Corotated: the space's law P = 2 mu (F - R) + lambda (tr U - 3) R with U's principal stretches a, b, both
 * from F's invariants, and c across; T = sum of (2 mu (a - 1) + lambda (a + b + c - 3))/(b c) n n^T, n the
 * principal axes of B. */
static void BiotStress(const double f[4], int plane_stress, double stress[3])
{
  const double mu = E / (2.0 * (1.0 + NU)), lambda = NU * E / ((1.0 + NU) * (1.0 - 2.0 * NU));
  const double xx = f[0] * f[0] + f[1] * f[1], yy = f[2] * f[2] + f[3] * f[3];
  const double xy = f[0] * f[2] + f[1] * f[3], angle = 0.5 * atan2(2.0 * xy, xx - yy);
  const double a = sqrt(0.5 * (xx + yy) + hypot(0.5 * (xx - yy), xy)), b = (f[0] * f[3] - f[1] * f[2]) / a;
  const double c = plane_stress ? 1.0 - lambda * (a + b - 2.0) / (lambda + 2.0 * mu) : 1.0;
  const double volumetric = lambda * (a + b + c - 3.0);
  const double first = (2.0 * mu * (a - 1.0) + volumetric) / (b * c),
               second = (2.0 * mu * (b - 1.0) + volumetric) / (a * c);
  stress[0] = first * pow(cos(angle), 2) + second * pow(sin(angle), 2);
  stress[1] = first * pow(sin(angle), 2) + second * pow(cos(angle), 2);
  stress[2] = (first - second) * sin(angle) * cos(angle);
}

/* St. Venant: T = F (2 mu E + lambda tr E I) F^T/det F with E = (F^T F - I)/2 and c^2 - 1 = 2 E_33 across. */
static void GreenStress(const double f[4], int plane_stress, double stress[3])
{
  const double mu = E / (2.0 * (1.0 + NU)), lambda = NU * E / ((1.0 + NU) * (1.0 - 2.0 * NU));
  const double xx = 0.5 * (f[0] * f[0] + f[2] * f[2] - 1.0), yy = 0.5 * (f[1] * f[1] + f[3] * f[3] - 1.0);
  const double xy = 0.5 * (f[0] * f[1] + f[2] * f[3]);
  const double zz = plane_stress ? -lambda * (xx + yy) / (lambda + 2.0 * mu) : 0.0;
  const double volumetric = lambda * (xx + yy + zz), j = (f[0] * f[3] - f[1] * f[2]) * sqrt(1.0 + 2.0 * zz);
  const double s[3] = {2.0 * mu * xx + volumetric, 2.0 * mu * yy + volumetric, 2.0 * mu * xy};
  for (int k = 0; k < 3; k++) {
    const double *a = f + (k == 1 ? 2 : 0), *b = f + (k == 0 ? 0 : 2);
    stress[k] = (s[0] * a[0] * b[0] + s[2] * (a[0] * b[1] + a[1] * b[0]) + s[1] * a[1] * b[1]) / j;
  }
}

static PetscErrorCode Affine(const double f[4], Law law, int six_node)
{
  double exact[3];
  Solid s;
  static void (*const EXACT[])(const double[4], int, double[3]) = {ExactStress, BiotStress, GreenStress};
  EXACT[law / 2](f, law % 2, exact);
  PetscCall(Mapped(f, law, six_node, &s));
  SolidView v = ViewOf(s, NULL, NULL);
  double *stress = calloc(3 * (size_t)v.nelements + 1, sizeof *stress);
  SolidStress(s, stress);
  for (int k = 0; k < 3 * v.nelements; k++)
    CHECK(fabs(stress[k] - exact[k % 3]) < 1e-12 * E, "element %d: stress %.15g, exact %.15g", k / 3,
          stress[k], exact[k % 3]);
  const double largest = LargestForce(s, 1);
  CHECK(largest < 1e-13 * E, "uniform stress leaves a force of %g inside", largest);
  free(stress);
  return SolidDestroy(&s);
}

/* A body that is given stretched has the stress of its stretch, and pulls back. */
static PetscErrorCode Stretched(void)
{
  BodySetup setup = BodyAtRest(MaterialOf(1000.0, E, 0.3, 0.0));
  const SolidSetup options = {.courant = 0.5};
  const double j = 1.5, mu = E / 2.6, lambda = 0.3 * E / (1.3 * 0.4),
               volumetric = 0.5 * lambda * (j - 1.0 / j);
  Model a = {0};
  Solid s;
  setup.stretch[0] = 1.5;
  AddDisc(&a, 2.0, 1.0, 0.5, 0.1, &setup);
  PetscCall(SolidCreate(PETSC_COMM_WORLD, &a, &options, &s));
  SolidView v = ViewOf(s, NULL, NULL);
  double *stress = calloc(3 * (size_t)v.nelements + 1, sizeof *stress);
  SolidStress(s, stress);
  for (int e = 0; e < v.nelements; e++)
    CHECK(fabs(stress[3 * e] - (mu / j * 1.25 + volumetric)) + fabs(stress[3 * e + 1] - volumetric) <
              1e-12 * E,
          "element %d: %g %g", e, stress[3 * e], stress[3 * e + 1]);
  free(stress);
  PetscCall(ModelDestroy(&a));
  return SolidDestroy(&s);
}

int main(int argc, char **argv)
{
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  for (int k = 0; k < 2 * NLAWS; k++) {
    const Law law = (Law)(k / 2);
    const int six_node = k % 2;
    const double tension[4] = {1.2, 0.0, 0.0, 0.93}, shear[4] = {1.0, 0.3, 0.0, 1.0},
                 all[4] = {1.3, 0.4, -0.2, 0.9};
    PetscCall(Rotation(law, six_node));
    PetscCall(Affine(tension, law, six_node));
    PetscCall(Affine(shear, law, six_node));
    PetscCall(Affine(all, law, six_node));
  }
  PetscCall(Stretched());
  return PetscFinalize();
}
