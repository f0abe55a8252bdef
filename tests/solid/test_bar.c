/* A step of velocity at the end of a slender bar (a prescribed boundary) travels with sqrt(E/rho) in plane stress
 * and sqrt(E/(1 - nu^2)/rho) in plane strain, within 1 %; a boundary can be let go. */
#include "tests/solid/build.h"

static const double YOUNG = 1.0e6, DENSITY = 1000.0, POISSON = 0.3, SPEED = 1e-3;

/* Mean velocity along the bar of the nodes of one cross section. */
static double Section(const SolidView *v, double x)
{
  double sum = 0.0;
  int n = 0;
  for (int i = 0; i < v->nnodes; i++) {
    if (fabs(v->rest[2 * i] - x) > 1e-6) continue;
    sum += v->v[2 * i];
    n++;
  }
  return sum / n;
}

static PetscErrorCode WaveSpeed(int plane_stress, double *speed)
{
  const SolidSetup options = {.courant = 0.8};
  const double row[3] = {0.0, SPEED, 0.0}, at[2] = {0.3, 0.7};
  const BoundaryMotion motion = {"left", {{1, 0}, 1, row, 0.0, 0.0, 0.0, 0.0, {0.0, 0.0}, {0}, ""}};
  BodySetup setup = BodyAtRest(MaterialOf(DENSITY, YOUNG, POISSON, 0.0));
  Model a = {0};
  double passed[2] = {0.0, 0.0}, before[2] = {0.0, 0.0}, h;
  Solid s;
  setup.material.plane_stress = plane_stress;
  setup.material.thickness = 0.02;
  setup.nprescribed = 1;
  setup.prescribed = &motion;
  AddRectangle(&a, 0.5, 0.0, 1.0, 0.01, 0.0, 0.0025, 0, &setup);
  PetscCall(SolidCreate(PETSC_COMM_SELF, &a, &options, &s));
  SolidView v = ViewOf(s, NULL, NULL);
  PetscCall(SolidStart(s, 0.03, NULL));
  while (SolidRemaining(s) && passed[1] == 0.0) {
    PetscCall(SolidSubstep(s, &h));
    for (int k = 0; k < 2; k++) { /* when half of the step has arrived */
      const double now = Section(&v, at[k]);
      if (passed[k] == 0.0 && now > 0.5 * SPEED)
        passed[k] = SolidGetStats(s)->t - h * (now - 0.5 * SPEED) / (now - before[k]);
      before[k] = now;
    }
  }
  CHECK(passed[1] > 0.0, "the wave has not arrived");
  *speed = (at[1] - at[0]) / (passed[1] - passed[0]);
  double prescribed = 0.0;
  for (int i = 0; i < v.nnodes; i++)
    if (v.rest[2 * i] < 1e-9) prescribed = v.x[2 * i] - v.rest[2 * i];
  CHECK(fabs(prescribed - SPEED * SolidGetStats(s)->t) < 1e-15, "the end has gone %g", prescribed);
  PetscCall(ModelDestroy(&a));
  return SolidDestroy(&s);
}

/* A disc with a prescribed motion up to a speed and free from then on flies on; the prescribed motion has given momentum and energy.
 */
static PetscErrorCode Thrown(void)
{
  const SolidSetup options = {.courant = 0.8, .gravity = {0.0, -10.0}};
  const double row[6] = {0.1, 0.0, 0.0, 0.2, 3.0, 0.0};
  const BoundaryMotion motion = {"boundary", {{1, 1}, 2, row, 0.2, 0.0, 0.0, 0.0, {0.0, 0.0}, {0}, ""}};
  BodySetup setup = BodyAtRest(MaterialOf(DENSITY, 1e8, POISSON, 0.3));
  Model a = {0};
  double impulse[2] = {0.0, 0.0}, work = 0.0;
  BodyState b;
  SolidBudget budget;
  Solid s;
  PetscFunctionBeginUser;
  setup.nprescribed = 1;
  setup.prescribed = &motion;
  AddDisc(&a, 0.0, 0.0, 0.05, 0.02, &setup);
  PetscCall(SolidCreate(PETSC_COMM_SELF, &a, &options, &s));
  for (int k = 0; k < 30; k++) {
    PetscCall(RunStep(s, 0.01, NULL));
    PetscCall(SolidGetBudget(s, &budget));
    for (int c = 0; c < 2; c++) impulse[c] += budget.reaction[c];
    work += budget.reaction_work;
  }
  PetscCall(SolidBodies(s, 1, &b));
  CHECK(fabs(b.v[0] - 3.0) < 0.01 && fabs(b.v[1] + 1.0) < 0.01, "flies at %g, %g m/s", b.v[0], b.v[1]);
  CHECK(fabs(b.x[0] - 0.45) < 0.002 && fabs(b.x[1] + 0.05) < 0.002, "is at %g, %g m", b.x[0], b.x[1]);
  CHECK(fabs(impulse[0] / (b.mass * b.v[0]) - 1.0) < 1e-12, "%.15g N s of %.15g", impulse[0],
        b.mass * b.v[0]);
  CHECK(fabs((impulse[1] - 10.0 * 0.3 * b.mass) / (b.mass * b.v[1]) - 1.0) < 1e-12, "%.15g N s upwards",
        impulse[1]);
  CHECK(fabs(work / (4.5 * b.mass) - 1.0) < 0.01, "%g J of work, %g wanted", work, 4.5 * b.mass);
  PetscCall(ModelDestroy(&a));
  PetscCall(SolidDestroy(&s));
  PetscFunctionReturn(0);
}

/* A block whose left side, or all of it where it is rigid, is pushed from rest against a force on its nodes: its kinetic energy is not negative, and
 * with that of its strain it is what force and prescribed motion have given. */
static PetscErrorCode Pushed(int rigid)
{
  const SolidSetup options = {.courant = 0.8, .gravity = {0.0, -10.0}};
  const double row[9] = {0.0, 0.3, 0.1, 0.02, 0.3, 0.1, 0.05, 0.6, -0.2}, width = 0.1;
  const BoundaryMotion motion = {rigid ? NULL : "left", {.prescribed = {1, 1}, .nrows = 3, .row = row}};
  BodySetup setup = BodyAtRest(MaterialOf(DENSITY, 1e7, POISSON, 0.0));
  double work = 0.0, given = 0.0, before = 0.0, first = 0.0, *load;
  Model a = {0};
  BodyState b;
  SolidBudget budget;
  Solid s;
  PetscFunctionBeginUser;
  if (rigid) setup.material.rigid = 1;
  setup.nprescribed = 1;
  setup.prescribed = &motion;
  AddRectangle(&a, 0.0, 0.0, width, width, 0.0, 0.02, 0, &setup);
  PetscCall(SolidCreate(PETSC_COMM_SELF, &a, &options, &s));
  const SolidView v = ViewOf(s, NULL, NULL);
  PetscCall(PetscCalloc1(2 * (size_t)v.nnodes, &load));
  for (int k = 0; k < v.nnodes; k++) load[2 * k] = -1e4 / v.nnodes;
  for (int k = 0; k < 50; k++) {
    PetscCall(RunStep(s, 1e-3, load));
    PetscCall(SolidGetBudget(s, &budget));
    PetscCall(SolidBodies(s, 1, &b));
    work += budget.reaction_work;
    given += budget.work - 10.0 * b.mass * (b.x[1] - before);
    before = b.x[1];
    const double square = b.v[0] * b.v[0] + b.v[1] * b.v[1];
    CHECK(b.kinetic > 0.0 && (!rigid || fabs(b.kinetic - 0.5 * b.mass * square) < 1e-12 * b.kinetic),
          "kinetic energy %g J at %g, %g m/s", b.kinetic, b.v[0], b.v[1]);
    const double excess = b.kinetic + b.strain - work - given;
    if (k == 0) first = excess; /* what it began with, and of a force that begins at once */
    CHECK(fabs(excess - first) < 2e-5 * work,
          "energy %g J of kinetic, %g of strain; %g of work, %g of the force: %g J more", b.kinetic, b.strain,
          work, given, excess - first);
  }
  PetscCall(PetscFree(load));
  PetscCall(ModelDestroy(&a));
  PetscCall(SolidDestroy(&s));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(Thrown());
  for (int rigid = 0; rigid < 2; rigid++) PetscCall(Pushed(rigid));
  for (int stress = 0; stress < 2; stress++) {
    const double modulus = stress ? YOUNG : YOUNG / (1.0 - POISSON * POISSON),
                 exact = sqrt(modulus / DENSITY);
    double speed;
    PetscCall(WaveSpeed(stress, &speed));
    if (getenv("VERBOSE"))
      printf("plane %s: %.4f m/s, exact %.4f, %+.2f %%\n", stress ? "stress" : "strain", speed, exact,
             100.0 * (speed / exact - 1.0));
    CHECK(fabs(speed / exact - 1.0) < 0.01, "wave speed %g, exact %g", speed, exact);
  }
  return PetscFinalize();
}
