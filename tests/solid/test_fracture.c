/* Bodies that break: energies per new surface in tension and in shear, the balance of energy without damping,
 * no healing, momentum and angular momentum to round-off through breaking, and intact bodies that feel no
 * joints. */
#include "tests/solid/crack.h"

static const char *const SIDES[] = {"left", "right"};

/* A bar from -length/2 to length/2 whose ends are fixed, with joints about the line x = 0. */
static BodySetup Bar(Material m, const double (*box)[4])
{
  BodySetup setup = BodyAtRest(m);
  setup.nfixed = 2;
  setup.fixed_name = SIDES;
  setup.joints = (JointSetup){.nboxes = 1, .box = box};
  return setup;
}

/* The force on the nodes that are fixed at x > 0. */
static PetscErrorCode Reaction(Solid s, const Model *a, int axis, double *sum)
{
  const SolidView v = ViewOf(s, NULL, NULL);
  const double *force;
  PetscCall(SolidForces(s, &force));
  *sum = 0.0;
  for (int n = 0; n < v.nnodes; n++)
    if (v.gid[n] < a->nnodes && a->fixed[v.gid[n]] && v.rest[2 * n] > 0.0) *sum -= force[2 * n + axis];
  return 0;
}

/* Drawn apart at its ends, along the bar (axis 0) or across (1), until it is in two. */
static PetscErrorCode Energy(int axis, int corotated, double length, double width, double speed, double time)
{
  const double size = 0.01, box[1][4] = {{-1.01 * size, -1.0, 1.01 * size, 1.0}};
  const SolidSetup options = {.courant = 0.8};
  Material m = axis ? RockOf(3e7, 3e6, 30.0, 0.2) : RockOf(3e6, 9e6, 30.0, 0.2);
  m.fracture_energy[1] = 60.0;
  m.law = corotated;
  const BodySetup setup = Bar(m, box);
  const double expected = m.fracture_energy[axis] * width;
  Model a = {0};
  FractureState f;
  Solid s;
  AddRectangle(&a, 0.0, 0.0, length, width, 0.0, size, 0, &setup);
  PetscCall(SolidCreate(PETSC_COMM_WORLD, &a, &options, &s));
  Draw(s, &a, axis, 0.0, speed);
  PetscCall(Run(s, time, 1e-4));
  int *fragment = malloc((size_t)a.nelements * sizeof *fragment), n;
  double *damage = malloc((size_t)a.nelements * sizeof *damage), most = 0.0;
  PetscCall(SolidFragments(s, fragment, &n));
  PetscCall(SolidFracture(s, &f));
  SolidDamage(s, damage);
  for (int e = 0; e < a.nelements; e++) most = fmax(most, damage[e]);
  if (getenv("VERBOSE"))
    printf("axis %d, law %d: %g J/m of %g, %d broken, %d live, %lld substeps\n", axis, corotated, f.energy,
           expected, f.broken, f.active, SolidGetStats(s)->total);
  CHECK(n == 2 && f.broken == lround(width / size) && fabs(f.length - width) < 1e-12,
        "%d pieces, %d broken, %g m", n, f.broken, f.length);
  CHECK(most == 1.0, "damage %g", most);
  CHECK(fabs(f.energy / expected - 1.0) < 0.02, "%g J/m instead of %g", f.energy, expected);
  free(fragment);
  free(damage);
  PetscCall(ModelDestroy(&a));
  return SolidDestroy(&s);
}

/* Drawn apart, pushed back, drawn again: the second climb goes straight to where the first was left, not
 * higher. */
static PetscErrorCode NoHealing(void)
{
  const double size = 0.01, box[1][4] = {{-1.01 * size, -1.0, 1.01 * size, 1.0}};
  const BodySetup setup = Bar(RockOf(3e6, 9e6, 30.0, 0.4), box);
  const SolidSetup options = {.courant = 0.8};
  Model a = {0};
  FractureState f;
  Solid s;
  double peak = 0.0, again = 0.0, left = 0.0, now = 0.0, before;
  AddRectangle(&a, 0.0, 0.0, 0.04, 0.04, 0.0, size, 0, &setup);
  PetscCall(SolidCreate(PETSC_COMM_WORLD, &a, &options, &s));
  for (int leg = 0; leg < 3; leg++) {
    Draw(s, &a, 0, 0.0, leg == 1 ? -0.01 : 0.01);
    PetscCall(SolidFracture(s, &f));
    before = f.energy;
    for (int k = 0; k < 60; k++) {
      PetscCall(Run(s, 1e-5, 1e-5));
      PetscCall(Reaction(s, &a, 0, &now));
      if (leg == 0) peak = fmax(peak, now);
      if (leg == 0) left = now;
      if (leg == 2) again = fmax(again, now);
    }
    PetscCall(SolidFracture(s, &f));
    if (getenv("VERBOSE")) printf("leg %d: %g N, energy %g\n", leg, now, f.energy);
    CHECK(f.broken == 0 && f.active == 4, "%d broken, %d live", f.broken, f.active);
    CHECK(leg != 1 || (f.energy < before && f.energy > 0.0), "pushing back: energy from %g to %g", before,
          f.energy);
  }
  CHECK(fabs(peak / (3e6 * 0.04) - 1.0) < 0.03, "peak %g N", peak);
  CHECK(left < 0.8 * peak && fabs(again / left - 1.0) < 0.03, "left at %g N, later %g N at most", left,
        again);
  PetscCall(ModelDestroy(&a));
  return SolidDestroy(&s);
}

/* A free bar that flies apart: what motion and strain lose, its cracks have; the rest is the substeps (7e-3
 * at a courant of 0.8). */
static PetscErrorCode Balance(void)
{
  BodySetup setup = BodyAtRest(RockOf(3e6, 9e6, 30.0, 0.0));
  const SolidSetup options = {.courant = 0.1};
  Model a = {0};
  FractureState f;
  Solid s;
  double *v, first, last;
  setup.joints.all = 1;
  AddRectangle(&a, 0.0, 0.0, 0.2, 0.05, 0.3, 0.01, 1, &setup);
  PetscCall(SolidCreate(PETSC_COMM_WORLD, &a, &options, &s));
  const SolidView view = ViewOf(s, NULL, &v);
  for (int n = 0; n < view.nnodes; n++)
    for (int c = 0; c < 2; c++) v[2 * n + c] = 40.0 * view.rest[2 * n + c];
  PetscCall(TotalEnergy(s, 1, &first));
  PetscCall(Run(s, 2e-4, 2e-5));
  PetscCall(TotalEnergy(s, 1, &last));
  PetscCall(SolidFracture(s, &f));
  if (getenv("VERBOSE"))
    printf("energy %g, then %g and %g in %d broken and %d active joints: off by %.2e\n", first, last,
           f.energy, f.broken, f.active, (last + f.energy) / first - 1.0);
  CHECK(f.broken > 20 && f.energy > 0.05 * first, "%d broken, %g J/m of %g", f.broken, f.energy, first);
  CHECK(fabs((last + f.energy) / first - 1.0) < 2e-3, "energy off by %g", (last + f.energy) / first - 1.0);
  PetscCall(ModelDestroy(&a));
  return SolidDestroy(&s);
}

/* Plane stress, 0.4 m thick, one side prescribed along the bar only: it breaks there too, and all parts of
 * the prescribed nodes follow; a bar's energy is G_f times width and thickness. */
static PetscErrorCode PulledSheet(void)
{
  static const double row[3] = {0.0, -3.0, 0.0};
  const BoundaryMotion prescribed = {"left", {{1, 0}, 1, row, 0.0, 0.0, 0.0, 0.0, {0.0, 0.0}, {0}, ""}};
  BodySetup setup = BodyAtRest(RockOf(3e6, 9e6, 10.0, 0.0));
  const SolidSetup options = {.courant = 0.8};
  Model a = {0};
  FractureState f;
  Solid s;
  double *v;
  int parts = 0;
  setup.material.plane_stress = 1;
  setup.material.thickness = 0.4;
  setup.joints.all = 1;
  setup.nprescribed = 1;
  setup.prescribed = &prescribed;
  AddRectangle(&a, 0.0, 0.0, 0.1, 0.05, 0.0, 0.01, 1, &setup);
  PetscCall(SolidCreate(PETSC_COMM_WORLD, &a, &options, &s));
  SolidView view = ViewOf(s, NULL, &v);
  for (int n = 0; n < view.nnodes; n++) v[2 * n + 1] = 60.0 * view.rest[2 * n + 1];
  PetscCall(Run(s, 1e-4, 1e-5));
  view = ViewOf(s, NULL, &v);
  for (int n = 0; n < view.nnodes; n++) {
    if (view.rest[2 * n] > -0.0499) continue;
    parts += view.gid[n] >= a.nnodes;
    CHECK(v[2 * n] == -3.0 && fabs(view.x[2 * n] - view.rest[2 * n] + 3e-4) < 1e-12, "node %d at %g m/s", n,
          v[2 * n]);
  }
  PetscCall(SolidFracture(s, &f));
  if (getenv("VERBOSE"))
    printf("plane stress: %d new prescribed nodes, %d broken, %g J of %g in %g m\n", parts, f.broken,
           f.energy, 10.0 * 0.4 * f.length, f.length);
  CHECK(parts > 0 && f.broken > 10, "%d parts, %d broken", parts, f.broken);
  CHECK(f.energy > 10.0 * 0.4 * f.length * 0.98 && f.energy < 10.0 * 0.4 * 2.0 * f.length,
        "%g J in %g m of crack", f.energy, f.length);
  PetscCall(ModelDestroy(&a));
  return SolidDestroy(&s);
}

typedef struct {
  double p[2], spin;
} Momentum;

static PetscErrorCode MomentumOf(Solid s, Momentum *m)
{
  BodyState b[2];
  PetscCall(SolidBodies(s, 2, b));
  *m = (Momentum){{0.0, 0.0}, 0.0};
  for (int k = 0; k < 2; k++) {
    for (int c = 0; c < 2; c++) m->p[c] += b[k].mass * b[k].v[c];
    m->spin +=
        b[k].mass * (b[k].x[0] * b[k].v[1] - b[k].x[1] * b[k].v[0]) + b[k].inertia * b[k].angular_velocity;
  }
  return 0;
}

/* Two discs smash each other. */
static PetscErrorCode Collision(void)
{
  BodySetup left = BodyAtRest(RockOf(3e6, 9e6, 20.0, 0.1)), right = left;
  const SolidSetup options = {.courant = 0.8};
  Model a = {0};
  Momentum before, now;
  FractureState f;
  Solid s;
  left.joints.all = right.joints.all = 1;
  left.velocity[0] = 8.0;
  right.velocity[0] = -4.0;
  AddDisc(&a, -0.0501, 0.0, 0.05, 0.01, &left);
  AddDisc(&a, 0.0501, 0.01, 0.05, 0.01, &right);
  PetscCall(SolidCreate(PETSC_COMM_WORLD, &a, &options, &s));
  PetscCall(MomentumOf(s, &before));
  const double scale = 2500.0 * M_PI * 0.05 * 0.05 * 12.0;
  for (int k = 0; k < 15; k++) {
    PetscCall(Run(s, 2e-5, 2e-5));
    PetscCall(MomentumOf(s, &now));
    for (int c = 0; c < 2; c++)
      CHECK(fabs(now.p[c] - before.p[c]) < 1e-12 * scale, "momentum %d off by %g", c, now.p[c] - before.p[c]);
    CHECK(fabs(now.spin - before.spin) < 1e-12 * scale * 0.1, "angular momentum off by %g",
          now.spin - before.spin);
  }
  PetscCall(SolidFracture(s, &f));
  if (getenv("VERBOSE")) printf("collision: %d broken, %d live\n", f.broken, f.active);
  CHECK(f.broken > 30, "%d broken", f.broken);
  PetscCall(ModelDestroy(&a));
  return SolidDestroy(&s);
}

/* Below its strength a body with joints has the same limit and moves with the same bits as one without. */
static PetscErrorCode Intact(void)
{
  Solid s[2];
  SolidView v[2];
  double limit[2];
  for (int k = 0; k < 2; k++) {
    BodySetup setup = BodyAtRest(RockOf(3e6, 9e6, 30.0, 0.0));
    const SolidSetup options = {.courant = 0.8};
    Model a = {0};
    setup.joints.all = k;
    setup.stretch[0] = 1.0 + 5e-5;
    AddRectangle(&a, 0.0, 0.0, 0.1, 0.05, 0.3, 0.01, 1, &setup);
    PetscCall(SolidCreate(PETSC_COMM_WORLD, &a, &options, &s[k]));
    PetscCall(SolidLimit(s[k], &limit[k]));
    PetscCall(Run(s[k], 1e-4, 1e-5));
    v[k] = ViewOf(s[k], NULL, NULL);
    PetscCall(ModelDestroy(&a));
  }
  CHECK(limit[0] == limit[1] && v[0].nnodes == v[1].nnodes, "limits %g %g", limit[0], limit[1]);
  for (int n = 0; n < 2 * v[0].nnodes; n++)
    CHECK(v[0].x[n] == v[1].x[n] && v[0].v[n] == v[1].v[n], "node %d: %.17g and %.17g", n / 2, v[0].x[n],
          v[1].x[n]);
  for (int k = 0; k < 2; k++) PetscCall(SolidDestroy(&s[k]));
  return 0;
}

/* What a sheet becomes that is torn at its left side, which stood still as prescribed until nothing had moved yet, or was always free. */
static PetscErrorCode Torn(int held, FractureState *f, double *sum)
{
  static const double ROW[3] = {0.0, 0.0, 0.0};
  static const BoundaryMotion HELD = {"left",
                                      {.prescribed = {1, 1}, .nrows = 1, .row = ROW, .release = 1e-5}};
  const SolidSetup options = {.courant = 0.8};
  BodySetup setup = BodyAtRest(RockOf(3e6, 9e6, 20.0, 0.1));
  Model a = {0};
  Solid s;
  setup.joints.all = 1;
  setup.nprescribed = held;
  setup.prescribed = &HELD;
  AddRectangle(&a, 0.0, 0.0, 0.1, 0.1, 0.0, 0.01, 1, &setup);
  PetscCall(SolidCreate(PETSC_COMM_WORLD, &a, &options, &s));
  PetscCall(RunStep(s, 1e-5, NULL));
  for (int step = 0; step < 30; step++) {
    const SolidView v = ViewOf(s, NULL, NULL);
    double *load = calloc(2 * (size_t)v.nnodes + 1, sizeof *load);
    for (int k = 0; k < 2 * v.nfacets; k++)
      if (v.rest[2 * v.facet[k]] < -0.0499)
        load[2 * v.facet[k]] -= 3e4 * (1.0 + v.rest[2 * v.facet[k] + 1] / 0.05);
    PetscCall(RunStep(s, 1e-5, load));
    free(load);
  }
  PetscCall(SolidFracture(s, f));
  *sum = 0.0;
  const SolidView v = ViewOf(s, NULL, NULL);
  for (int k = 0; k < 2 * v.nnodes; k++) *sum += v.x[k] * v.x[k];
  PetscCall(ModelDestroy(&a));
  return SolidDestroy(&s);
}

/* A side that has been let go cracks as one that was never held. */
static PetscErrorCode Released(void)
{
  FractureState f[2];
  double sum[2];
  for (int held = 0; held < 2; held++) PetscCall(Torn(held, &f[held], &sum[held]));
  if (getenv("VERBOSE"))
    printf("free: %d broken, %d active, %g J/m; let go: %d, %d, %g J/m\n", f[0].broken, f[0].active,
           f[0].energy, f[1].broken, f[1].active, f[1].energy);
  CHECK(f[0].broken > 3 && f[0].broken == f[1].broken && f[0].active == f[1].active &&
            fabs(f[0].energy / f[1].energy - 1.0) < 1e-9 && fabs(sum[0] / sum[1] - 1.0) < 1e-12,
        "free: %d broken, %d active, %.15g J/m; let go: %d, %d, %.15g J/m", f[0].broken, f[0].active,
        f[0].energy, f[1].broken, f[1].active, f[1].energy);
  return 0;
}

int main(int argc, char **argv)
{
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(Energy(0, 0, 0.2, 0.05, 0.02, 1.2e-3));
  PetscCall(Energy(0, 1, 0.2, 0.05, 0.02, 1.2e-3));
  PetscCall(Energy(1, 0, 0.04, 0.2, 0.05, 3e-3));
  PetscCall(NoHealing());
  PetscCall(Balance());
  PetscCall(Collision());
  PetscCall(Intact());
  PetscCall(Released());
  PetscCall(PulledSheet());
  return PetscFinalize();
}
