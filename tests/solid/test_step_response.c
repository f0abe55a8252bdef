// ranks: 1 2 3
/* The response of one implicit step, w = S d: w + dt^2/4 M^-1 K w = d, with K w from the forces of displaced nodes, also
 * where stiff springs act. */
#include "solid/step_response.h"
#include "tests/solid/build.h"

#define STEP 0.05
#define MOVED 1e-6 /* m, at most, for the differences */

static PetscErrorCode Largest(double *value)
{
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, value, 1, MPI_DOUBLE, MPI_MAX, PETSC_COMM_WORLD));
  return 0;
}

/* A disc of density 1 and radius 0.5 m about the origin, with springs in its middle, after a step in which nothing happens. */
static PetscErrorCode Disc(int nsprings, const Spring spring[], Solid *s)
{
  SolidSetup setup = {.courant = 0.8, .nsprings = nsprings};
  const BodySetup body = BodyAtRest(MaterialOf(1.0, 2e5, 0.3, 0.0));
  Model a = {0};
  AddDisc(&a, 0.0, 0.0, 0.5, 0.1, &body);
  for (int k = 0; k < nsprings; k++) {
    setup.spring[k] = spring[k];
    setup.spring[k].element = a.nelements / 2;
    for (int i = 0; i < 3; i++) setup.spring[k].weight[i] = 1.0 / 3.0;
  }
  PetscCall(SolidCreate(PETSC_COMM_WORLD, &a, &setup, s));
  PetscCall(ModelDestroy(&a));
  (*s)->dt = STEP;
  return 0;
}

/* A field of which every vibration has a part. */
static double Rough(const double rest[2], int c)
{
  return sin(1e4 * rest[0] + 3e3 * rest[1] + c);
}

/* kw: the change of the forces, with the opposite sign, per displacement w[nnodes][2]. */
static PetscErrorCode Stiffness(Solid s, const double w[], double kw[])
{
  const double *force;
  const int n = 2 * s->nnodes;
  double *x;
  PetscCall(PetscMalloc1(n, &x));
  PetscCall(PetscArraycpy(x, s->x, n));
  PetscCall(PetscArrayzero(kw, n));
  for (int side = -1; side <= 1; side += 2) {
    for (int k = 0; k < n; k++) s->x[k] = x[k] + side * MOVED * w[k];
    s->force_valid = PETSC_FALSE;
    PetscCall(SolidForces(s, &force));
    for (int k = 0; k < n; k++) kw[k] -= side * force[k] / (2.0 * MOVED);
  }
  PetscCall(PetscArraycpy(s->x, x, n));
  s->force_valid = PETSC_FALSE;
  PetscCall(PetscFree(x));
  return 0;
}

/* How far w + dt^2/4 M^-1 K w is from d at most; components that are held keep theirs. */
static PetscErrorCode CheckResponse(Solid s, const char *what)
{
  const int n = 2 * s->nnodes;
  const long long before = s->stats.response_iterations;
  double *w, *kw, off = 0.0;
  PetscCall(PetscMalloc2(n, &w, n, &kw));
  for (int k = 0; k < n; k++) w[k] = Rough(s->rest + k / 2 * 2, k % 2);
  PetscCall(StepResponseUpdate(s));
  PetscCall(StepResponseApply(s, w));
  PetscCall(Stiffness(s, w, kw));
  for (int k = 0; k < n; k++)
    off = fmax(off, fabs(w[k] + 0.25 * STEP * STEP * kw[k] * s->inverse_mass[k / 2] -
                         Rough(s->rest + k / 2 * 2, k % 2)));
  PetscCall(Largest(&off));
  if (getenv("VERBOSE"))
    printf("%s: off by %g, %lld iterations\n", what, off, s->stats.response_iterations - before);
  /* K w M^-1 dt^2/4 is some (omega dt/2)^2 = 1e4 times what is small in w */
  CHECK(off < 1e-4, "%s: the response is %g off", what, off);
  CHECK(s->size > 1 || s->stats.response_iterations - before < 20, "%s: %lld iterations", what,
        s->stats.response_iterations - before);
  PetscCall(PetscFree2(w, kw));
  return 0;
}

/* Springs with omega dt of 4 and more: of length 0, pulling to one side, pushing to nowhere, and slack. */
static PetscErrorCode Springs(void)
{
  static const Spring SPRING[] = {{.anchor = {0.0, 0.0}, .stiffness = 2e4},
                                  {.anchor = {1.5, 1.0}, .stiffness = 1e5, .length = 0.8},
                                  {.anchor = {-2.0, 0.5}, .stiffness = 1e6, .length = 3.0, .slack = 1}};
  Solid s;
  PetscCall(Disc(0, NULL, &s));
  PetscCall(CheckResponse(s, "no spring"));
  PetscCall(SolidDestroy(&s));
  for (int k = 0; k < 3; k++) {
    PetscCall(Disc(1, SPRING + k, &s));
    PetscCall(CheckResponse(s, k == 0   ? "a spring of length 0"
                               : k == 1 ? "a taut spring"
                                        : "a slack spring"));
    PetscCall(SolidDestroy(&s));
  }
  PetscCall(Disc(3, SPRING, &s));
  PetscCall(CheckResponse(s, "three springs"));
  PetscCall(SolidDestroy(&s));
  return 0;
}

int main(int argc, char **argv)
{
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(Springs());
  return PetscFinalize();
}
