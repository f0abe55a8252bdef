/* The stability limit: at it, 1e5 substeps of free vibration keep the energy, with and without damping; the
 * bound is not idle, three quarters above it (twice, damped) the motion blows up; SolidSubstep ends a run
 * whose element turns inside out. */
#include "build.h"
#include <setjmp.h>

static jmp_buf stopped;
static char message[512];

static void Fail(void *context, const char *text)
{
  (void)context;
  (void)snprintf(message, sizeof message, "%s", text);
  longjmp(stopped, 1);
}

/* A disc that vibrates in many modes, with substeps of factor times the limit. */
static PetscErrorCode Vibrating(double factor, double damping, double amplitude, Assembly *a, Solid *s)
{
  const SolidSetup options = {.courant = factor, .fail = Fail};
  const BodySetup setup = BodyAtRest(MaterialOf(1000.0, 1.0e6, 0.3, damping));
  double *x;
  memset(a, 0, sizeof *a);
  AddDisc(a, 0.0, 0.0, 0.1, 0.03, &setup);
  PetscCall(SolidCreate(PETSC_COMM_SELF, a, &options, s));
  SolidView v = ViewOf(*s, &x, NULL);
  for (int k = 0; k < 2 * v.nnodes; k++) x[k] += amplitude * sin(12.9898 * k + 4.1);
  return 0;
}

static PetscErrorCode Conserves(void)
{
  double limit, before, now = 0.0, worst = 0.0;
  Assembly a;
  Solid s;
  PetscCall(Vibrating(1.0, 0.0, 1e-6, &a, &s));
  PetscCall(SolidLimit(s, &limit));
  PetscCall(Run(s, 999.9 * limit, 999.9 * limit)); /* what the scheme keeps depends on its substep */
  PetscCall(TotalEnergy(s, 1, &before));
  for (int k = 0; k < 100; k++) {
    PetscCall(Run(s, 999.9 * limit, 999.9 * limit));
    PetscCall(TotalEnergy(s, 1, &now));
    worst = fmax(worst, fabs(now / before - 1.0));
  }
  CHECK(SolidGetStats(s)->total >= 100000, "%lld substeps", SolidGetStats(s)->total);
  if (getenv("VERBOSE")) printf("energy within %.2e over %lld substeps\n", worst, SolidGetStats(s)->total);
  CHECK(worst < 1e-3, "energy off by %g", worst);
  PetscCall(AssemblyDestroy(&a));
  return SolidDestroy(&s);
}

/* Energy of the damped disc only falls. */
static PetscErrorCode Decays(double damping)
{
  double limit, start, before, now = 0.0;
  Assembly a;
  Solid s;
  PetscCall(Vibrating(1.0, damping, 1e-5, &a, &s));
  PetscCall(SolidLimit(s, &limit));
  PetscCall(TotalEnergy(s, 1, &start));
  before = start;
  for (int k = 0; k < 20; k++) {
    PetscCall(Run(s, 999.9 * limit, 999.9 * limit));
    PetscCall(TotalEnergy(s, 1, &now));
    CHECK(fabs(now) <= fmax(before, 1e-6 * start), "damping %g: energy %g after %g", damping, now, before);
    before = now;
  }
  CHECK(fabs(now) < 1e-6 * start, "damping %g: energy %g of %g is left", damping, now, start);
  PetscCall(AssemblyDestroy(&a));
  return SolidDestroy(&s);
}

static PetscErrorCode Explodes(double factor, double damping)
{
  Assembly a;
  Solid s;
  double limit;
  message[0] = '\0';
  PetscCall(Vibrating(factor, damping, 1e-5, &a, &s));
  PetscCall(SolidLimit(s, &limit));
  if (!setjmp(stopped)) PetscCall(Run(s, 5e3 * limit, 50.0 * limit));
  CHECK(strstr(message, "body 0: element") && strstr(message, "inside out at t ="), "above the limit: '%s'",
        message);
  PetscCall(AssemblyDestroy(&a));
  return SolidDestroy(&s);
}

int main(int argc, char **argv)
{
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(Conserves());
  PetscCall(Decays(0.05));
  PetscCall(Decays(0.9));
  PetscCall(Explodes(1.75, 0.0));
  PetscCall(Explodes(2.0, 0.5));
  return PetscFinalize();
}
