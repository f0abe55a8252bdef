/* First bending frequency of a clamped plate strip (plane strain) against Timoshenko's beam, within 1 %; with two six-node triangles
 * through it within 0.3 %, as extrapolated with three-node ones. */
#include "tests/solid/build.h"

static const double LENGTH = 1.6, HEIGHT = 0.1, DENSITY = 1000.0, YOUNG = 1.0e6, POISSON = 0.3;

/* Slopes of deflection, rotation, moment and shear force of a Timoshenko beam that vibrates with w; plane
 * strain: E' = E/(1 - nu^2), shear factor 5/6. */
static void Slopes(double w, const double y[4], double slope[4])
{
  const double inertia = HEIGHT * HEIGHT * HEIGHT / 12.0,
               shear = 5.0 / 6.0 * YOUNG / (2.0 * (1.0 + POISSON)) * HEIGHT;
  slope[0] = y[1] + y[3] / shear;
  slope[1] = y[2] * (1.0 - POISSON * POISSON) / (YOUNG * inertia);
  slope[2] = -y[3] - DENSITY * inertia * w * w * y[1];
  slope[3] = -DENSITY * HEIGHT * w * w * y[0];
}

/* Clamped at 0 with unit moment or unit shear: moment and shear at the free end, whose determinant is 0 at a
 * natural frequency.  y[1] and y[0] along the way are the mode. */
static double EndDeterminant(double w)
{
  enum { STEPS = 400 };
  const double h = LENGTH / STEPS;
  double end[2][4];
  for (int column = 0; column < 2; column++) {
    double y[4] = {0.0, 0.0, column == 0, column == 1}, k[4][4], z[4];
    for (int n = 0; n < STEPS; n++) { /* Runge-Kutta 4 */
      Slopes(w, y, k[0]);
      for (int stage = 1; stage < 4; stage++) {
        for (int i = 0; i < 4; i++) z[i] = y[i] + (stage == 3 ? 1.0 : 0.5) * h * k[stage - 1][i];
        Slopes(w, z, k[stage]);
      }
      for (int i = 0; i < 4; i++) y[i] += h / 6.0 * (k[0][i] + 2.0 * k[1][i] + 2.0 * k[2][i] + k[3][i]);
    }
    memcpy(end[column], y, sizeof y);
  }
  return end[0][2] * end[1][3] - end[1][2] * end[0][3];
}

static double TimoshenkoFrequency(double euler)
{
  double low = 0.8 * euler, high = 1.05 * euler;
  const double sign = EndDeterminant(low);
  for (int k = 0; k < 60; k++) {
    const double middle = 0.5 * (low + high);
    *(EndDeterminant(middle) * sign > 0.0 ? &low : &high) = middle;
  }
  return low;
}

/* First mode of Euler's cantilever. */
static double Mode(double x)
{
  const double beta = 1.8751040687, s = (cos(beta) + cosh(beta)) / (sin(beta) + sinh(beta)),
               z = beta * x / LENGTH;
  return cosh(z) - cos(z) - s * (sinh(z) - sin(z));
}

/* How much of the mode is in the deflection. */
static double Deflection(const SolidView *v, const double mode[])
{
  double sum = 0.0;
  for (int n = 0; n < v->nnodes; n++) sum += mode[n] * (v->x[2 * n + 1] - v->rest[2 * n + 1]);
  return sum;
}

/* Starts straight with the mode's velocity, 1e-4 of the length in amplitude: straight again after half a
 * period. */
static PetscErrorCode Frequency(int through, int six_node, double euler, double *omega)
{
  static const char *const LEFT[] = {"left"};
  const SolidSetup options = {.courant = 0.9};
  BodySetup setup = BodyAtRest(MaterialOf(DENSITY, YOUNG, POISSON, 0.0));
  Model a = {0};
  Solid s;
  double *velocity, h, before = 0.0, now = 0.0;
  setup.nfixed = 1;
  setup.fixed_name = LEFT;
  setup.six_node = six_node;
  AddRectangle(&a, 0.0, 0.0, LENGTH, HEIGHT, 0.0, HEIGHT / through, 0, &setup);
  PetscCall(SolidCreate(PETSC_COMM_SELF, &a, &options, &s));
  SolidView v = ViewOf(s, NULL, &velocity);
  double *mode = calloc((size_t)v.nnodes, sizeof *mode);
  for (int n = 0; n < v.nnodes; n++) {
    mode[n] = Mode(v.rest[2 * n] + 0.5 * LENGTH);
    velocity[2 * n + 1] = 0.5e-4 * LENGTH * euler * mode[n];
  }
  PetscCall(SolidStart(s, 4.0 / euler, NULL));
  while (SolidRemaining(s)) {
    PetscCall(SolidSubstep(s, &h));
    before = now;
    now = Deflection(&v, mode);
    if (SolidGetStats(s)->total > 100 && now <= 0.0) break;
  }
  CHECK(now <= 0.0 && before > 0.0, "no half period within 4/omega");
  *omega = M_PI / (SolidGetStats(s)->t - h * now / (now - before));
  free(mode);
  PetscCall(ModelDestroy(&a));
  return SolidDestroy(&s);
}

int main(int argc, char **argv)
{
  const double euler =
      3.5160152685 * sqrt(YOUNG / (1.0 - POISSON * POISSON) / DENSITY / 12.0) * HEIGHT / (LENGTH * LENGTH);
  const double timoshenko = TimoshenkoFrequency(euler);
  double coarse, fine;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(Frequency(8, 0, euler, &coarse));
  PetscCall(Frequency(16, 0, euler, &fine));
  const double coarse_error = coarse / timoshenko - 1.0, fine_error = fine / timoshenko - 1.0;
  if (getenv("VERBOSE"))
    printf("Timoshenko %.5f, Euler %.5f; cells through the thickness, error: 8 %+.4f, 16 %+.4f\n", timoshenko,
           euler, coarse_error, fine_error);
  CHECK(timoshenko < euler && timoshenko > 0.99 * euler, "reference %g, Euler %g", timoshenko, euler);
  CHECK(fabs(fine_error) < 0.01, "omega %g, expected %g", fine, timoshenko);
  /* linear triangles are too stiff in bending, by O(h^2): without that the beam is left (and what the clamp's
   * hold on the strip's thickness adds) */
  const double extrapolated = (4.0 * fine_error - coarse_error) / 3.0;
  CHECK(coarse_error > 2.8 * fine_error && fabs(extrapolated) < 0.003, "errors %g and %g, extrapolated %g",
        coarse_error, fine_error, extrapolated);
  PetscCall(Frequency(2, 1, euler, &coarse));
  if (getenv("VERBOSE")) printf("two six-node triangles: %+.4f\n", coarse / timoshenko - 1.0);
  CHECK(fabs(coarse / timoshenko - 1.0) < 0.003, "omega %g, expected %g", coarse, timoshenko);
  return PetscFinalize();
}
