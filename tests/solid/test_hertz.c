/* A disc pressed between two walls: the deformable one by Hertz's law of the cylinder, the stiff one by the
 * contact potential's own law, both within 5 %. */
#include "tests/solid/build.h"

static const double RADIUS = 0.05;

/* Disc of modulus E whose walls reach `depth` into it on both sides. */
static PetscErrorCode Pressed(double size, double young, double penalty, double depth, Solid *s)
{
  const SolidSetup options = {
      .courant = 0.8, .walls = PETSC_TRUE, .lower = {-1.0, depth - RADIUS}, .upper = {1.0, RADIUS - depth}};
  BodySetup setup = BodyAtRest(MaterialOf(1000.0, young, 0.3, 0.2));
  Model a = {0};
  setup.material.penalty = penalty;
  AddDisc(&a, 0.0, 0.0, RADIUS, size, &setup);
  PetscCall(SolidCreate(PETSC_COMM_SELF, &a, &options, s));
  PetscCall(SolidStart(*s, 1e-9, NULL));
  return ModelDestroy(&a);
}

/* Forces on the lower half, N/m: the lower wall's when nothing is stressed within. */
static PetscErrorCode LowerForce(Solid s, double *sum)
{
  SolidView v = ViewOf(s, NULL, NULL);
  const double *force;
  PetscCall(SolidForces(s, &force));
  *sum = 0.0;
  for (int n = 0; n < v.nnodes; n++)
    if (v.x[2 * n + 1] < 0.0) *sum += force[2 * n + 1];
  return 0;
}

/* phi = 3 depth/height over the chord of a circle that lies d behind the wall:
 * P = (3 p/height) 4/3 d sqrt(2 R d). */
static PetscErrorCode Potential(void)
{
  const double size = 0.0025, penalty = 1.0e5;
  for (int k = 0; k < 4; k++) {
    const double depth = 1e-3 * (1 << k) / 2.0;
    double force, height = HUGE_VAL;
    Solid s;
    PetscCall(Pressed(size, 1.0e9, penalty, depth, &s));
    SolidView v = ViewOf(s, NULL, NULL);
    for (int e = 0; e < v.nelements; e++) { /* smallest height of the elements on the surface */
      double longest = 0.0, outermost = 0.0;
      const int *n = v.element + 3 * e;
      for (int i = 0; i < 3; i++) {
        const double *p = v.rest + 2 * n[i], *q = v.rest + 2 * n[(i + 1) % 3];
        longest = fmax(longest, hypot(q[0] - p[0], q[1] - p[1]));
        outermost = fmax(outermost, hypot(p[0], p[1]));
      }
      const double *a = v.rest + 2 * n[0], *b = v.rest + 2 * n[1], *c = v.rest + 2 * n[2];
      const double twice = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
      if (outermost > RADIUS) height = fmin(height, twice / longest);
    }
    PetscCall(LowerForce(s, &force));
    const double expected = 4.0 * penalty / height * depth * sqrt(2.0 * RADIUS * depth);
    if (getenv("VERBOSE"))
      printf("stiff: depth %.1e, force %.5g, potential's law %.5g, %+.2f %%\n", depth, force, expected,
             100.0 * (force / expected - 1.0));
    CHECK(fabs(force / expected - 1.0) < 0.05, "depth %g: force %g, expected %g", depth, force, expected);
    PetscCall(SolidDestroy(&s));
  }
  return 0;
}

/* Rest by taking the motion away whenever its energy has begun to fall. */
static PetscErrorCode Relax(Solid s, double dt, int steps)
{
  double *velocity, before = 0.0;
  SolidView v = ViewOf(s, NULL, &velocity);
  BodyState b;
  for (int k = 0; k < steps; k++) {
    PetscCall(Run(s, dt, dt));
    PetscCall(SolidBodies(s, 1, &b));
    if (b.kinetic < before) PetscCall(PetscArrayzero(velocity, 2 * (size_t)v.nnodes));
    before = b.kinetic < before ? 0.0 : b.kinetic;
  }
  return 0;
}

/* Approach of the wall to the centre (Johnson 1985, 5.6): P/(pi E') (2 ln(4 R/b) - 1), b^2 = 4 P R/(pi E'),
 * E' = E/(1 - nu^2). */
static double HertzForce(double approach, double modulus)
{
  double low = 0.0, high = modulus * RADIUS;
  for (int k = 0; k < 200; k++) {
    const double p = 0.5 * (low + high), b = sqrt(4.0 * p * RADIUS / (M_PI * modulus));
    *(p / (M_PI * modulus) * (2.0 * log(4.0 * RADIUS / b) - 1.0) < approach ? &low : &high) = p;
    if (b > RADIUS) high = p;
  }
  return low;
}

static PetscErrorCode Hertz(void)
{
  const double young = 1.0e6, modulus = young / 0.91, depth = 0.012 * RADIUS;
  double force, *x;
  Solid s, soft; /* soft: the same shape and walls with next to no stress, for the walls' force alone */
  PetscCall(Pressed(0.0012, young, 5.0 * young, depth, &s));
  PetscCall(Relax(s, 2e-4, 120));
  PetscCall(Pressed(0.0012, 1e-6 * young, 5.0 * young, depth, &soft));
  SolidView v = ViewOf(s, NULL, NULL);
  (void)ViewOf(soft, &x, NULL);
  PetscCall(PetscArraycpy(x, v.x, 2 * (size_t)v.nnodes));
  PetscCall(SolidStart(soft, 1e-9, NULL));
  PetscCall(LowerForce(soft, &force));
  PetscCall(SolidDestroy(&soft));
  const double expected = HertzForce(depth, modulus);
  if (getenv("VERBOSE"))
    printf("deformable: approach %.3g R, half width %.2f edges, force %.5g, Hertz %.5g, %+.2f %%, %lld "
           "substeps\n",
           depth / RADIUS, sqrt(4.0 * expected * RADIUS / (M_PI * modulus)) / 0.0012, force, expected,
           100.0 * (force / expected - 1.0), SolidGetStats(s)->total);
  CHECK(fabs(force / expected - 1.0) < 0.05, "force %g, Hertz %g", force, expected);
  return SolidDestroy(&s);
}

int main(int argc, char **argv)
{
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(Potential());
  PetscCall(Hertz());
  return PetscFinalize();
}
