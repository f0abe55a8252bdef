// ranks: 1 2
/* Coulomb friction: a block on a slope sticks below the friction angle and slides above it with
 * g (sin a - mu cos a) within 1 %, on a wall and on another body; a friction pair of discs keeps momentum and
 * angular momentum to round-off while its energy only falls; what friction holds it holds over a redone step;
 * a floor of two materials has the friction of the one that is beneath. */
#include "tests/solid/build.h"
#include <string.h>

static const double G = 9.81, YOUNG = 1.0e7;

static Material Rough(double friction)
{
  Material m = MaterialOf(1000.0, YOUNG, 0.3, 0.3);
  m.friction = friction;
  m.contact_damping = 0.5;
  return m;
}

/* A block on a floor that slopes by `angle`: the floor is level and gravity turned.  *a: its acceleration
 * down the slope between t1 and t2 from the ways made, *slid: the way from t1 to t2. */
static PetscErrorCode Slope(int wall, double angle, double friction, double *acceleration, double *slid)
{
  const SolidSetup options = {.gravity = {G * sin(angle), -G * cos(angle)},
                              .courant = 0.8,
                              .walls = (PetscBool)wall,
                              .lower = {-1.0, 0.0},
                              .upper = {5.0, 1.0}};
  BodySetup block = BodyAtRest(Rough(friction)), floor = block;
  Model a = {0};
  BodyState b[3];
  Solid s;
  AddRectangle(&a, 0.0, 0.05, 0.2, 0.1, 0.0, 0.05, 0, &block);
  floor.fixed = 1;
  if (!wall) AddRectangle(&a, 0.25, -0.05, 1.1, 0.1, 0.0, 0.07, 0, &floor);
  PetscCall(SolidCreate(PETSC_COMM_WORLD, &a, &options, &s));
  for (int k = 0; k < 3; k++) { /* till 0.1: settles; then twice 0.1 */
    PetscCall(Run(s, 0.1, 0.01));
    PetscCall(SolidBodies(s, 1, &b[k]));
  }
  *acceleration = (b[2].v[0] - b[1].v[0]) / 0.1;
  *slid = b[2].x[0] - b[1].x[0];
  if (getenv("VERBOSE"))
    printf("%s, angle %.3f, mu %.2f: slid %.3g, acceleration %.5f, Coulomb %.5f\n", wall ? "wall" : "body",
           angle, friction, *slid, *acceleration, G * (sin(angle) - friction * cos(angle)));
  PetscCall(ModelDestroy(&a));
  return SolidDestroy(&s);
}

static PetscErrorCode Slopes(int wall)
{
  const double friction = 0.4, critical = atan(friction);
  double acceleration, slid;
  PetscCall(Slope(wall, 0.95 * critical, friction, &acceleration, &slid));
  CHECK(fabs(slid) < 1e-6, "below the friction angle it slides by %g", slid);
  PetscCall(Slope(wall, 1.2 * critical, friction, &acceleration, &slid));
  const double coulomb = G * (sin(1.2 * critical) - friction * cos(1.2 * critical));
  CHECK(fabs(acceleration / coulomb - 1.0) < 0.01, "acceleration %g, Coulomb %g", acceleration, coulomb);
  PetscCall(Slope(wall, 0.5, 0.0, &acceleration, &slid));
  CHECK(fabs(acceleration / (G * sin(0.5)) - 1.0) < 1e-4, "without friction %g", acceleration);
  return 0;
}

/* A floor, smooth to the left of x = 0 and rough to the right. */
static void AddFloor(Model *a, Material smooth, Material rough)
{
  const RegionMaterial region[2] = {{"smooth", smooth}, {"rough", rough}};
  const double centre[2] = {0.0, -0.05};
  BodySetup floor = BodyAtRest(smooth);
  MeshSerial mesh;
  floor.fixed = 1;
  floor.nregions = 2;
  floor.region = region;
  (void)ShapeRectangle(centre, 1.2, 0.1, 0.0, 0.05, &mesh);
  mesh.nregions = 2;
  (void)PetscMalloc1((size_t)mesh.ne, &mesh.region);
  (void)PetscMalloc1(2, &mesh.region_name);
  for (int k = 0; k < 2; k++) strcpy(mesh.region_name[k], region[k].region);
  for (int e = 0; e < mesh.ne; e++) {
    const int *v = mesh.vertex + 3 * e;
    mesh.region[e] = mesh.x[2 * v[0]] + mesh.x[2 * v[1]] + mesh.x[2 * v[2]] > 0.0;
  }
  AddMesh(a, &mesh, &floor);
}

/* A block of one edge that slides at x beside the other half: what it loses of its speed, m/s. */
static PetscErrorCode SlideBeside(double x, double *lost)
{
  const SolidSetup options = {.gravity = {0.0, -G}, .courant = 0.8};
  const double speed = 0.2;
  Material smooth = Rough(0.0), rough = Rough(0.5), block = Rough(0.5);
  BodySetup setup;
  Model a = {0};
  BodyState b[2];
  Solid s;
  strcpy(smooth.name, "smooth");
  strcpy(rough.name, "rough");
  block.rigid = 1;
  setup = BodyAtRest(block);
  setup.velocity[0] = speed;
  AddFloor(&a, smooth, rough);
  AddRectangle(&a, x, 0.1, 0.2, 0.2, 0.0, 0.2, 0, &setup);
  PetscCall(SolidCreate(PETSC_COMM_WORLD, &a, &options, &s));
  PetscCall(Run(s, 0.05, 1e-3));
  PetscCall(SolidBodies(s, 2, b));
  *lost = speed - b[1].v[0];
  if (getenv("VERBOSE")) printf("a block at %g loses %.3g m/s\n", x, *lost);
  PetscCall(ModelDestroy(&a));
  return SolidDestroy(&s);
}

static PetscErrorCode Halves(void)
{
  double lost;
  for (int side = -1; side <= 1;
       side += 2) { /* 2 cm from the other half it may touch it before the next search */
    PetscCall(SlideBeside(0.12 * side, &lost));
    CHECK(side < 0 ? fabs(lost) < 1e-4 : lost > 0.19, "beside the %s half a block loses %g m/s",
          side < 0 ? "rough" : "smooth", lost);
  }
  return 0;
}

/* --- discs that rub ----------------------------------------------------------------------------------- */

/* Obliquely, one turning.  *turned: I times the change of the first one's spin over (R times its change of
 * momentum), that is mu when the discs slip all the time; *lost: share of the energy. */
static PetscErrorCode Rub(double friction, double damping, double *turned, double *lost)
{
  BodySetup left = BodyAtRest(MaterialOf(1000.0, 1.0e6, 0.3, 0.0)), right;
  const SolidSetup options = {.courant = 0.5};
  Model a = {0};
  BodyState b[2], first;
  Totals before = {0}, now = {0};
  Solid s;
  left.material.friction = friction;
  left.material.contact_damping = damping;
  right = left;
  left.velocity[0] = 0.5;
  left.angular_velocity = 4.0;
  right.velocity[0] = -0.25;
  AddDisc(&a, -0.105, 0.0, 0.1, 0.02, &left);
  AddDisc(&a, 0.105, 0.05, 0.1, 0.02, &right);
  PetscCall(SolidCreate(PETSC_COMM_WORLD, &a, &options, &s));
  PetscCall(TotalsOf(s, &before, b));
  first = b[0];
  double scale = b[0].mass * 0.75, highest = before.energy;
  for (int k = 0; k < 55; k++) {
    PetscCall(Run(s, 1e-3, 1e-3));
    PetscCall(TotalsOf(s, &now, b));
    highest = fmax(highest, now.energy);
    for (int c = 0; c < 2; c++)
      CHECK(fabs(now.p[c] - before.p[c]) < 1e-12 * scale, "momentum %d off by %g", c, now.p[c] - before.p[c]);
    CHECK(fabs(now.spin - before.spin) < 1e-12 * scale * 0.2, "angular momentum off by %g",
          now.spin - before.spin);
  }
  CHECK(hypot(b[1].x[0] - b[0].x[0], b[1].x[1] - b[0].x[1]) > 0.205, "the discs have not parted");
  *turned = b[0].inertia * (4.0 - b[0].angular_velocity) /
            (0.1 * b[0].mass * hypot(b[0].v[0] - first.v[0], b[0].v[1] - first.v[1]));
  *lost = 1.0 - now.energy / before.energy;
  if (getenv("VERBOSE"))
    printf("mu %.2f, damping %.2f: energy lost %.4f, highest %+.2e, turned by %.4f\n", friction, damping,
           *lost, highest / before.energy - 1.0, *turned);
  CHECK(highest < before.energy * (1.0 + 1e-3), "energy rises by %g", highest / before.energy - 1.0);
  PetscCall(ModelDestroy(&a));
  return SolidDestroy(&s);
}

static PetscErrorCode Rubs(void)
{
  double turned[4], lost[4];
  PetscCall(Rub(0.0, 0.0, &turned[0], &lost[0]));
  PetscCall(Rub(0.03, 0.0, &turned[1], &lost[1]));
  PetscCall(Rub(0.4, 0.0, &turned[2], &lost[2]));
  PetscCall(Rub(0.4, 0.3, &turned[3], &lost[3]));
  /* the discs are polygons, which turn a little when they meet askew without friction */
  CHECK(fabs(turned[0]) < 0.015 && fabs(lost[0]) < 1e-3, "smooth: turned %g, energy %g", turned[0], lost[0]);
  CHECK(fabs(turned[1] - turned[0] - 0.03) < 0.003, "slipping: turned %g, smooth %g", turned[1], turned[0]);
  CHECK(turned[2] > turned[1] && turned[2] < 0.2, "sticking: turned %g", turned[2]);
  CHECK(lost[1] > 0.004 && lost[2] > 0.004 && lost[3] > lost[2] + 0.005, "energy lost %g %g %g", lost[1],
        lost[2], lost[3]);
  return 0;
}

/* --- redone steps ------------------------------------------------------------------------------------- */

/* x of all nodes after 20 steps of a block that sticks and slips between two others; each step tried before
 * with another load when redo is set. */
static PetscErrorCode Squeezed(MPI_Comm comm, int redo, double *all, int *nnodes)
{
  const SolidSetup options = {
      .gravity = {3.0, -G}, .courant = 0.8, .walls = PETSC_TRUE, .lower = {-1.0, 0.0}, .upper = {1.0, 1.0}};
  BodySetup setup = BodyAtRest(Rough(0.3));
  Model a = {0};
  Solid s;
  for (int k = 0; k < 3; k++) {
    setup.velocity[0] = k == 1 ? 0.5 : 0.0;
    AddRectangle(&a, 0.01 * k, 0.05 + 0.1 * k, 0.2, 0.1, 0.0, 0.04, 1, &setup);
  }
  *nnodes = a.nnodes;
  PetscCall(SolidCreate(comm, &a, &options, &s));
  SolidView v = ViewOf(s, NULL, NULL);
  double *load = calloc(2 * (size_t)v.nnodes + 1, sizeof *load);
  for (int k = 0; k < 20; k++)
    for (int try = redo ? 0 : 1; try < 2; try++) {
      for (int i = 0; i < 2 * v.nnodes; i++) load[i] = try ? 0.0 : 0.3 * sin(k + i);
      if (redo) PetscCall(SolidState(s, try == 0));
      PetscCall(RunStep(s, 1e-3, load));
    }
  for (int i = 0; i < 2 * a.nnodes; i++) all[i] = NAN;
  for (int n = 0; n < v.nnodes; n++)
    for (int c = 0; c < 2; c++) all[2 * v.gid[n] + c] = v.x[2 * n + c];
  free(load);
  PetscCall(ModelDestroy(&a));
  return SolidDestroy(&s);
}

static PetscErrorCode History(void)
{
  enum { MOST = 1000 };
  static double serial[MOST], mine[MOST], redone[MOST];
  double largest = 0.0;
  int n;
  PetscCall(Squeezed(PETSC_COMM_SELF, 0, serial, &n));
  CHECK(2 * n <= MOST, "%d nodes", n);
  PetscCall(Squeezed(PETSC_COMM_WORLD, 0, mine, &n));
  PetscCall(Squeezed(PETSC_COMM_WORLD, 1, redone, &n));
  for (int k = 0; k < 2 * n; k++) {
    if (isnan(mine[k])) continue;
    largest = fmax(largest, fabs(mine[k] - serial[k]));
    CHECK(mine[k] == redone[k], "node %d: %.17g, redone %.17g", k / 2, mine[k], redone[k]);
  }
  if (getenv("VERBOSE")) printf("differs from one rank by %.2e\n", largest);
  CHECK(largest < 1e-11, "differs from one rank by %g", largest);
  return 0;
}

int main(int argc, char **argv)
{
  PetscMPIInt size;
  double turned, lost;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCallMPI(MPI_Comm_size(PETSC_COMM_WORLD, &size));
  if (size == 1) {
    PetscCall(Slopes(1));
    PetscCall(Slopes(0));
    PetscCall(Rubs());
  } else {
    PetscCall(Rub(0.4, 0.3, &turned, &lost));
  }
  PetscCall(Halves());
  PetscCall(History());
  return PetscFinalize();
}
