// ranks: 1 2 3
/* Surface tension: with the exact curvature a drop is in balance to round-off; with the computed one it nearly stays at rest, and
 * its pressure is Laplace's; a capillary wave decays as Prosperetti (1981) says.
 * surface_tension drop n ratio laplace steps, surface_tension wave n: print. */
#include "fluid/flow/fluid_impl.h"
#include "fluid/phases/phases_impl.h"
#include "tests/fluid/drop.h"
#include <complex.h>
#include <string.h>

#define RADIUS 0.2

static PetscErrorCode StaticDrop(int n, double ratio, double laplace, Drop *d)
{
  const double mu = sqrt(2.0 * RADIUS / laplace); /* laplace = rho D sigma/mu^2 */
  const DropSetup setup = {.n = n,
                           .seed = 1u,
                           .ratio = ratio,
                           .viscosity = {mu, ratio > 1.0 ? 0.01 * mu : mu},
                           .tension = 1.0,
                           .wall = BOUNDARY_FREE_SLIP};
  const Region region[2] = {{.shape = REGION_BOX, .phase = 1, .a = {-1, -1}, .b = {2, 2}},
                            {.shape = REGION_DISC, .phase = 0, .a = {0.509, 0.506}, .radius = RADIUS}};
  PetscFunctionBeginUser;
  PetscCall(DropCreate(&setup, 2, region, d));
  PetscFunctionReturn(0);
}

/* --- exact curvature ------------------------------------------------------------------------------------ */

/* R^-1 kappa grad H in place of the weights that the computed curvatures make; returns the largest one. */
static double SetExactTension(Fluid f)
{
  InverseDensity *r = (InverseDensity *)PhaseTransportInverseDensity(f->phases);
  const Phases phases = PhaseTransportPhases(f->phases);
  double largest = 0.0;
  for (int e = 0; e < f->domain.mesh->ne; e++) {
    const ElementGeometry *g = f->domain.geometry + e;
    double force[2] = {0.0, 0.0}, inside;
    for (int i = 0; i < 3; i++) {
      (void)PhasesDistance(phases, 0, phases->stars->vertex[e][i], &inside);
      for (int c = 0; c < 2; c++) force[c] += inside * g->g[i][c] / RADIUS;
    }
    for (int c = 0; c < 2; c++) {
      r[e].weight[c] = r[e].inverse[c] * force[0] + r[e].inverse[c + 1] * force[1];
      largest = fmax(largest, fabs(r[e].weight[c]));
    }
  }
  MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_DOUBLE, MPI_MAX, f->domain.mesh->comm);
  return largest;
}

/* The largest acceleration weight - R^-1 grad p. */
static double LargestAcceleration(Fluid f)
{
  const InverseDensity *r = PhaseTransportInverseDensity(f->phases);
  const double *p = FluidPressure(f);
  double largest = 0.0;
  for (int e = 0; e < f->domain.mesh->ne; e++) {
    double pe[6], grad[3][2];
    for (int k = 0; k < 6; k++) pe[k] = p[f->domain.p2->node[6 * e + k]];
    P2Gradient((const double(*)[2])f->domain.geometry[e].g, pe, grad);
    for (int i = 0; i < 3; i++)
      for (int c = 0; c < 2; c++)
        largest = fmax(
            largest, fabs(r[e].weight[c] - r[e].inverse[c] * grad[i][0] - r[e].inverse[c + 1] * grad[i][1]));
  }
  MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_DOUBLE, MPI_MAX, f->domain.mesh->comm);
  return largest;
}

static PetscErrorCode Balance(double ratio)
{
  Drop d;
  PetscFunctionBeginUser;
  PetscCall(StaticDrop(16, ratio, 120.0, &d));
  const double weight = SetExactTension(d.fluid);
  PetscCall(FluidBalancePressure(d.fluid));
  const double left = LargestAcceleration(d.fluid);
  CHECK(weight > 1.0 && left < 1e-7 * weight, "ratio %g: %g of %g m/s2 is not balanced", ratio, left, weight);
  PetscCall(DropDestroy(&d));
  PetscFunctionReturn(0);
}

/* --- a drop at rest ------------------------------------------------------------------------------------- */

/* capillary: mu |u|/sigma at most; pressure: of its jump, relative. */
static PetscErrorCode Rest(int n, double ratio, double laplace, int steps, double capillary, double pressure,
                           int print)
{
  const double mu = sqrt(2.0 * RADIUS / laplace);
  double worst = 0.0;
  Drop d;
  PetscFunctionBeginUser;
  PetscCall(StaticDrop(n, ratio, laplace, &d));
  for (int k = 1; k <= steps; k++) {
    PetscCall(FluidStep(d.fluid, d.dt));
    worst = fmax(worst, mu * DropSpeed(&d));
    if (print && k % (steps / 10) == 0)
      PetscCall(PetscPrintf(PETSC_COMM_WORLD, "t %.3f: mu |u|/sigma %.2e, jump of pressure %.2e too large\n",
                            k * d.dt / sqrt(pow(2.0 * RADIUS, 3.0)), mu * DropSpeed(&d),
                            (DropPressure(&d, 0) - DropPressure(&d, 1)) * RADIUS - 1.0));
  }
  const double error = (DropPressure(&d, 0) - DropPressure(&d, 1)) * RADIUS - 1.0;
  CHECK(worst < capillary, "ratio %g, Laplace number %g: mu |u|/sigma up to %g", ratio, laplace, worst);
  CHECK(fabs(error) < pressure, "ratio %g, Laplace number %g: the jump of pressure is wrong by %g", ratio,
        laplace, error);
  PetscCall(DropDestroy(&d));
  PetscFunctionReturn(0);
}

/* --- a capillary wave ----------------------------------------------------------------------------------- */

/* exp(z^2) erfc(z), Re z >= 0: the series of erf, or its continued fraction. */
static double complex ScaledErfc(double complex z)
{
  double complex sum = z, term = z, fraction = 0.0;
  if (creal(z) < 0.0) return 2.0 * cexp(z * z) - ScaledErfc(-z);
  if (cabs(z) > 4.0) {
    for (int n = 60; n > 0; n--) fraction = 0.5 * n / (z + fraction);
    return 1.0 / (sqrt(M_PI) * (z + fraction));
  }
  for (int n = 1; n < 200 && cabs(term) > 1e-18 * cabs(sum); n++) {
    term *= -z * z / n;
    sum += term / (2 * n + 1);
  }
  return cexp(z * z) * (1.0 - 2.0 / sqrt(M_PI) * sum);
}

/* Two deep fluids of the same kinematic viscosity: damping = nu k^2, frequency w0 without viscosity, both 1/s; product: of the
 * densities over the square of their sum.  Amplitude at t over that of the start, at rest (Prosperetti 1981). */
typedef struct {
  double damping, frequency, product;
} Prosperetti;

static double ProsperettiAmplitude(const Prosperetti *w, double t)
{
  const double d = w->damping, b = w->product, w2 = w->frequency * w->frequency, s = sqrt(w->frequency);
  const double c[4] = {(1.0 - 6.0 * b) * d * d + w2, 4.0 * (1.0 - 3.0 * b) * pow(d, 1.5),
                       2.0 * (1.0 - 6.0 * b) * d, -4.0 * b * sqrt(d)};
  double complex z[4],
      sum = 4.0 * (1.0 - 4.0 * b) * d * d / (8.0 * (1.0 - 4.0 * b) * d * d + w2) * erfc(sqrt(d * t));
  for (int i = 0; i < 4; i++) z[i] = s * cpow(0.4 + 0.9 * I, i);
  for (int round = 0; round < 500; round++) /* the roots of z^4 + c[3] z^3 + ... by Durand and Kerner */
    for (int i = 0; i < 4; i++) {
      double complex p = 1.0, q = 1.0;
      for (int j = 3; j >= 0; j--) p = p * z[i] + c[j];
      for (int j = 0; j < 4; j++) q *= j == i ? 1.0 : z[i] - z[j];
      z[i] -= p / q;
    }
  for (int i = 0; i < 4; i++) {
    double complex q = 1.0;
    for (int j = 0; j < 4; j++) q *= j == i ? 1.0 : z[j] - z[i];
    sum += z[i] / q * w2 / (z[i] * z[i] - d) * ScaledErfc(z[i] * sqrt(t)) * exp(-d * t);
  }
  return creal(sum);
}

/* The coefficient of cos(k x) in the interface: from the first moment of the volume below. */
static double Amplitude(const Drop *d, double k)
{
  double sum = 0.0;
  for (int e = 0; e < d->mesh->ne; e++) {
    Polygon part;
    (void)PhasesGetPolygon(DropPhases(d), e, 0, &part);
    for (int i = 1; i + 1 < part.n; i++)
      sum += GeometryTurn(part.x[0], part.x[i], part.x[i + 1]) / 6.0 *
             (cos(k * part.x[0][0]) + cos(k * part.x[i][0]) + cos(k * part.x[i + 1][0]));
  }
  MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, d->mesh->comm);
  return 2.0 * sum;
}

enum { CREST = 200 };

static PetscErrorCode WaveCreate(int n, double k, double a, double nu, Drop *d)
{
  const DropSetup setup = {
      .n = n, .seed = 3u, .ratio = 1.0, .viscosity = {nu, nu}, .tension = 1.0, .wall = BOUNDARY_FREE_SLIP};
  double x[CREST + 3][2] = {{0}};
  Region region[2] = {{.shape = REGION_BOX, .phase = 1, .a = {-1, -1}, .b = {2, 2}}};
  PetscFunctionBeginUser;
  for (int i = 0; i <= CREST; i++) {
    x[i][0] = 1.0 - (double)i / CREST;
    x[i][1] = 0.5 + a * cos(k * x[i][0]);
  }
  x[CREST + 1][1] = x[CREST + 2][1] = -1.0;
  x[CREST + 2][0] = 1.0;
  region[1] = (Region){.shape = REGION_POLYGON, .phase = 0, .n = CREST + 3, .x = (const double(*)[2])x};
  PetscCall(DropCreate(&setup, 2, region, d));
  PetscFunctionReturn(0);
}

/* One wave length across, nu k^2/w0 = 0.0647, until w0 t = end; rms: of the amplitude's error, over the first amplitude. */
static PetscErrorCode Wave(int n, double end, double rms, int print)
{
  const double k = 2.0 * M_PI, a = 0.01, w0 = sqrt(0.5 * k * k * k), nu = 0.0647 * w0 / (k * k);
  const Prosperetti theory = {nu * k * k, w0, 0.25};
  double square = 0.0;
  int steps = 0;
  Drop d;
  PetscFunctionBeginUser;
  PetscCall(WaveCreate(n, k, a, nu, &d));
  for (; steps * d.dt * w0 < end; steps++) {
    PetscCall(FluidStep(d.fluid, d.dt));
    const double t = (steps + 1) * d.dt, now = Amplitude(&d, k) / a, exact = ProsperettiAmplitude(&theory, t);
    square += (now - exact) * (now - exact);
    if (print && steps % 50 == 0)
      PetscCall(PetscPrintf(PETSC_COMM_WORLD, "w0 t %.3f: %.4f, theory %.4f\n", w0 * t, now, exact));
  }
  if (print)
    PetscCall(
        PetscPrintf(PETSC_COMM_WORLD, "n %d, %d steps: rms error %.4f\n", n, steps, sqrt(square / steps)));
  CHECK(sqrt(square / steps) < rms, "n = %d: the amplitude is wrong by %g of the first one", n,
        sqrt(square / steps));
  PetscCall(DropDestroy(&d));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  if (argc > 5 && !strcmp(argv[1], "drop")) {
    PetscCall(Rest(atoi(argv[2]), atof(argv[3]), atof(argv[4]), atoi(argv[5]), 1e-4, 1e-2, 1));
  } else if (argc > 2 && !strcmp(argv[1], "wave")) {
    PetscCall(Wave(atoi(argv[2]), 25.0, 0.02, 1));
  } else {
    PetscCall(Balance(1.0));
    PetscCall(Balance(1000.0));
    PetscCall(Rest(20, 1.0, 120.0, 30, 5e-5, 3e-3, 0));
    PetscCall(Rest(32, 1000.0, 12000.0, 30, 1e-4, 3e-3, 0));
    PetscCall(Wave(16, 4.0, 0.1, 0));
  }
  return PetscFinalize();
}
