/* The stability limit of all laws, three and six nodes: at it, 1e5 substeps of free vibration keep the energy, with and without
 * damping; the bound is not idle, two and a half times as long ones (three times, damped) blow up, though they are shortened as the disc deforms; SolidStepFailure
 * names the element that turns inside out. */
#include "tests/solid/build.h"

typedef struct {
  int law, six_node;
} Kind;

/* A disc that vibrates in many modes, with substeps of factor times the limit. */
static PetscErrorCode Vibrating(Kind kind, double factor, double damping, double amplitude, Model *a,
                                Solid *s)
{
  const SolidSetup options = {.courant = factor};
  BodySetup setup = BodyAtRest(MaterialOf(1000.0, 1.0e6, 0.3, damping));
  double *x;
  setup.material.law = kind.law;
  setup.six_node = kind.six_node;
  memset(a, 0, sizeof *a);
  AddDisc(a, 0.0, 0.0, 0.1, 0.03, &setup);
  PetscCall(SolidCreate(PETSC_COMM_SELF, a, &options, s));
  SolidView v = ViewOf(*s, &x, NULL);
  for (int k = 0; k < 2 * v.nnodes; k++) x[k] += amplitude * sin(12.9898 * k + 4.1);
  return 0;
}

static PetscErrorCode Conserves(Kind kind)
{
  double limit, before = 0.0, now = 0.0, worst = 0.0;
  Model a;
  Solid s;
  PetscCall(Vibrating(kind, 1.0, 0.0, 1e-6, &a, &s));
  PetscCall(SolidLimit(s, &limit));
  const double interval =
      999.0 *
      limit; /* of equal substeps: what the scheme keeps depends on the substep, limit on the strain */
  PetscCall(Run(s, interval, interval));
  PetscCall(TotalEnergy(s, 1, &before));
  for (int k = 0; k < 100; k++) {
    PetscCall(Run(s, interval, interval));
    PetscCall(TotalEnergy(s, 1, &now));
    worst = fmax(worst, fabs(now / before - 1.0));
  }
  CHECK(SolidGetStats(s)->total >= 100000, "%lld substeps", SolidGetStats(s)->total);
  if (getenv("VERBOSE"))
    printf("law %d: energy within %.2e over %lld substeps\n", kind.law, worst, SolidGetStats(s)->total);
  /* the bound of six-node triangles is nearly the highest frequency: what the scheme keeps differs more from the energy */
  CHECK(worst < (kind.six_node ? 4e-3 : 1e-3), "energy off by %g", worst);
  PetscCall(ModelDestroy(&a));
  return SolidDestroy(&s);
}

/* Energy of the damped disc only falls. */
static PetscErrorCode Decays(Kind kind, double damping)
{
  double limit, start = 0.0, before, now = 0.0;
  Model a;
  Solid s;
  PetscCall(Vibrating(kind, 1.0, damping, 1e-5, &a, &s));
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
  PetscCall(ModelDestroy(&a));
  return SolidDestroy(&s);
}

/* The corotated law at finite strain: a disc given as 1.1 x 0.95 of its circle swings for 2e4 substeps at the
 * limit, which does not change. */
static PetscErrorCode Swings(int plane_stress)
{
  const SolidSetup options = {.courant = 1.0};
  BodySetup setup = BodyAtRest(MaterialOf(1000.0, 1.0e6, 0.3, 0.0));
  Model a = {0};
  Solid s;
  double limit, now_limit, before = 0.0, now = 0.0, worst = 0.0;
  setup.material.law = 1;
  setup.material.plane_stress = plane_stress;
  setup.stretch[0] = 1.1;
  setup.stretch[1] = 0.95;
  AddDisc(&a, 0.0, 0.0, 0.1, 0.03, &setup);
  PetscCall(SolidCreate(PETSC_COMM_SELF, &a, &options, &s));
  PetscCall(SolidLimit(s, &limit));
  PetscCall(TotalEnergy(s, 1, &before));
  for (int k = 0; k < 200; k++) {
    PetscCall(Run(s, 99.9 * limit, 99.9 * limit));
    PetscCall(TotalEnergy(s, 1, &now));
    PetscCall(SolidLimit(s, &now_limit));
    worst = fmax(worst, fabs(now / before - 1.0));
    CHECK(fabs(now_limit / limit - 1.0) < 1e-12, "the limit went from %g to %g", limit, now_limit);
  }
  if (getenv("VERBOSE"))
    printf("corotated, plane stress %d: energy within %.2e over %lld substeps\n", plane_stress, worst,
           SolidGetStats(s)->total);
  CHECK(worst < 0.02, "energy off by %g", worst);
  PetscCall(ModelDestroy(&a));
  return SolidDestroy(&s);
}

static PetscErrorCode Explodes(Kind kind, double factor, double damping)
{
  Model a;
  Solid s;
  double limit;
  const char *why = NULL;
  PetscCall(Vibrating(kind, factor, damping, 1e-5, &a, &s));
  PetscCall(SolidLimit(s, &limit));
  for (int k = 0; k < 100 && !why; k++) PetscCall(TryStep(s, 50.0 * limit, NULL, &why));
  CHECK(why && strstr(why, "body 0: element") && strstr(why, "inside out at t ="), "above the limit: '%s'",
        why ? why : "");
  PetscCall(ModelDestroy(&a));
  return SolidDestroy(&s);
}

int main(int argc, char **argv)
{
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  for (int k = 0; k < 6; k++) {
    const Kind kind = {k / 2, k % 2};
    PetscCall(Conserves(kind));
    PetscCall(Decays(kind, 0.05));
    PetscCall(Decays(kind, 0.9));
    PetscCall(Explodes(kind, 2.5, 0.0));
    PetscCall(Explodes(kind, 3.0, 0.5));
  }
  PetscCall(Swings(0));
  PetscCall(Swings(1));
  return PetscFinalize();
}
