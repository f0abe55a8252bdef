// ranks: 1 2
/* A thin ring pinched between two discs of prescribed motion folds until its own walls meet: they stop each other, with and
 * without friction; and a ring whose rest shape is a circle springs back from the ellipse it is given as. */
#include "tests/solid/build.h"

static const double RADIUS = 0.1, WALL = 0.01;

static void AddRing(Model *a, double x, double y, const BodySetup *setup)
{
  const double centre[2] = {x, y};
  MeshSerial mesh;
  (void)ShapeRing(centre, RADIUS - 0.5 * WALL, RADIUS + 0.5 * WALL, 2, 0.008, &mesh);
  AddMesh(a, &mesh, setup);
}

/* *gap: between the inner sides at x = 0, m; *narrowest: of the two walls there, of WALL. */
static PetscErrorCode Gap(Solid s, double *gap, double *narrowest)
{
  double y[4] = {HUGE_VAL, HUGE_VAL, HUGE_VAL, HUGE_VAL}; /* outer and inner above, - those below */
  SolidView v = ViewOf(s, NULL, NULL);
  for (int n = 0; n < v.nnodes; n++) {
    const double *r = v.rest + 2 * n, radius = hypot(r[0], r[1]);
    if (fabs(r[0]) > 1e-9 || radius > RADIUS + WALL || radius < RADIUS - WALL) continue;
    if (fabs(radius - RADIUS) < 0.1 * WALL) continue; /* the wall's middle */
    y[2 * (r[1] < 0.0) + (radius < RADIUS)] = r[1] < 0.0 ? -v.x[2 * n + 1] : v.x[2 * n + 1];
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, y, 4, MPI_DOUBLE, MPI_MIN, PETSC_COMM_WORLD));
  *gap = y[1] + y[3];
  *narrowest = fmin(y[0] - y[1], y[2] - y[3]) / WALL;
  return 0;
}

static PetscErrorCode Pinch(double friction)
{
  const SolidSetup options = {.courant = 0.8};
  const double speed = 1.0, start = 0.002, radius = 0.02, way = RADIUS + 0.5 * WALL + start - 0.9 * WALL;
  BodySetup ring = BodyAtRest(MaterialOf(1000.0, 1.0e5, 0.3, 0.5)), disc;
  Model a = {0};
  Solid s;
  double gap, narrowest;
  ring.material.friction = friction;
  ring.material.contact_damping = 0.3;
  disc = ring;
  disc.nprescribed = 1;
  AddRing(&a, 0.0, 0.0, &ring);
  for (int k = -1; k <= 1; k += 2) { /* both discs go `way` and stop */
    const double row[6] = {way / speed, 0.0, -k * speed, way / speed + 1e-6, 0.0, 0.0};
    const BoundaryMotion motion = {"boundary", {{1, 1}, 2, row, 0.0, 0.0, 0.0, 0.0, {0.0, 0.0}, {0}, ""}};
    disc.prescribed = &motion;
    AddDisc(&a, 0.0, k * (RADIUS + 0.5 * WALL + start + radius), radius, 0.008, &disc);
  }
  PetscCall(SolidCreate(PETSC_COMM_WORLD, &a, &options, &s));
  PetscCall(Gap(s, &gap, &narrowest));
  CHECK(fabs(gap / (2.0 * RADIUS - WALL) - 1.0) < 0.01 && fabs(narrowest - 1.0) < 0.01, "gap %g, wall %g",
        gap, narrowest);
  PetscCall(Run(s, way / speed + 0.01, 5e-3));
  PetscCall(Gap(s, &gap, &narrowest));
  if (getenv("VERBOSE"))
    printf("mu %.1f: gap %+.4f of the wall, wall %.3f of its thickness, %lld substeps\n", friction,
           gap / WALL, narrowest, SolidGetStats(s)->total);
  /* squeezed to 0.9 of their thickness, the walls touch and do not reach into each other */
  CHECK(gap < 0.02 * WALL && gap > -0.15 * WALL, "gap %g", gap);
  CHECK(narrowest < 0.97 && narrowest > 0.8, "the walls are squeezed to %g", narrowest);
  PetscCall(ModelDestroy(&a));
  return SolidDestroy(&s);
}

/* Given as an ellipse of 1.05 x 0.95 of its circular rest shape it swings about the circle and, over thirty
 * swings, keeps its energy. */
static PetscErrorCode Ellipse(void)
{
  enum { SAMPLES = 200 };
  const SolidSetup options = {.courant = 0.8};
  const double circle = 2.0 * RADIUS - WALL;
  BodySetup ring = BodyAtRest(MaterialOf(1000.0, 1.0e5, 0.3, 0.0));
  Model a = {0};
  Solid s;
  double gap, wall, first, energy = 0.0, start = 0.0, mean = 0.0, highest = 0.0, worst = 0.0;
  ring.stretch[0] = 1.05;
  ring.stretch[1] = 0.95;
  AddRing(&a, 0.0, 0.0, &ring);
  PetscCall(SolidCreate(PETSC_COMM_WORLD, &a, &options, &s));
  PetscCall(Gap(s, &first, &wall));
  PetscCall(TotalEnergy(s, 1, &start));
  for (int k = 0; k < SAMPLES; k++) {
    PetscCall(Run(s, 2e-3, 2e-3));
    PetscCall(Gap(s, &gap, &wall));
    PetscCall(TotalEnergy(s, 1, &energy));
    mean += gap / SAMPLES;
    highest = fmax(highest, gap);
    worst = fmax(worst, fabs(energy / start - 1.0));
  }
  if (getenv("VERBOSE"))
    printf("ellipse: height %+.4f at first, mean %+.4f, highest %+.4f of the circle's; energy within %.1e\n",
           first / circle - 1.0, mean / circle - 1.0, highest / circle - 1.0, worst);
  CHECK(fabs(first / circle - 0.95) < 0.002, "height at first %g of the circle's", first / circle);
  CHECK(fabs(mean / circle - 1.0) < 0.02, "mean height %g of the circle's", mean / circle);
  CHECK(highest / circle > 1.03 && highest / circle < 1.2, "highest %g of the circle's", highest / circle);
  /* a disturbance near the limit of stability has 1 - (omega h/2)^2 of its energy: where h becomes shorter the sum jumps */
  CHECK(worst < 0.03, "energy off by %g", worst);
  PetscCall(ModelDestroy(&a));
  return SolidDestroy(&s);
}

int main(int argc, char **argv)
{
  PetscMPIInt size;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCallMPI(MPI_Comm_size(PETSC_COMM_WORLD, &size));
  PetscCall(Pinch(0.5));
  if (size == 1) PetscCall(Pinch(0.0));
  if (size == 1) PetscCall(Ellipse());
  return PetscFinalize();
}
