// ranks: 1 2 3
/* Gauges follow a disc that is moved, turned and stretched, on any split of its surface; they are found again from a
 * checkpoint and where a node has another id, and one that is not on the surface is found. */
#include "coupler/geometry/gauges.h"
#include "tests/coupler/synthetic.h"
#include <unistd.h>

enum { SECTORS = 24 };
static const double CENTRE[2] = {0.5, 0.6}, RADIUS = 0.2;
static SyntheticSolid all, part;
static int rank, size;

/* The middle of side k of the polygon, less than half a side away from it. */
static GaugesCase Case(void)
{
  GaugesCase c = {.path = "case", .n = 3, .probe = {0, 2, 5}};
  for (int k = 0; k < c.n; k++) {
    const double angle = 2.0 * M_PI * (7 * k + 0.5) / SECTORS;
    c.point[k][0] = CENTRE[0] + RADIUS * cos(angle);
    c.point[k][1] = CENTRE[1] + RADIUS * sin(angle);
  }
  return c;
}

/* To x_centre + F (x - centre): turned by the angle, then stretched along x. */
static void Move(double angle, double stretch, double shift)
{
  for (int i = 0; i < all.nnodes; i++) {
    const double d[2] = {all.x[i][0] - CENTRE[0], all.x[i][1] - CENTRE[1]};
    all.x[i][0] = CENTRE[0] + shift + stretch * (cos(angle) * d[0] - sin(angle) * d[1]);
    all.x[i][1] = CENTRE[1] + sin(angle) * d[0] + cos(angle) * d[1];
  }
  SyntheticSolidPart(&all, rank, size, &part);
}

/* After Move on the disc at rest. */
static void Check(Gauges g, double angle, double stretch, double shift, const char *when)
{
  const double apothem = RADIUS * cos(M_PI / SECTORS);
  int n;
  const CoracleGauge *gauge = GaugesGet(g, &n);
  CHECK(n == 3, "%d gauges", n);
  for (int k = 0; k < n; k++) {
    const double at = 2.0 * M_PI * (7 * k + 0.5) / SECTORS + angle, cosine = cos(at), sine = sin(at);
    const double x = CENTRE[0] + shift + stretch * apothem * cosine, y = CENTRE[1] + apothem * sine;
    const double length = hypot(cosine / stretch, sine);
    CHECK(hypot(gauge[k].x[0] - x, gauge[k].x[1] - y) < 1e-14,
          "%s: gauge %d at (%.17g, %.17g) instead of (%.17g, %.17g)", when, k, gauge[k].x[0], gauge[k].x[1],
          x, y);
    CHECK(hypot(gauge[k].normal[0] - cosine / stretch / length, gauge[k].normal[1] - sine / length) < 1e-13,
          "%s: normal (%g, %g) of gauge %d", when, gauge[k].normal[0], gauge[k].normal[1], k);
  }
}

static void CheckResumed(Gauges g)
{
  const GaugesCase c = Case();
  char folder[64], path[128];
  Checkpoint file;
  Gauges resumed;
  double distance;
  int fault;
  snprintf(folder, sizeof folder, "/tmp/coracle_gauges_%d", (int)getpid());
  MPI_Bcast(folder, sizeof folder, MPI_CHAR, 0, PETSC_COMM_WORLD);
  if (rank == 0) CHECK(!PetscMkdir(folder), "folder");
  MPI_Barrier(PETSC_COMM_WORLD);
  CHECK(!CheckpointCreate(PETSC_COMM_WORLD, folder, "coupler", &file), "create");
  CHECK(!GaugesSave(g, file) && !CheckpointClose(&file), "save");
  CHECK(!CheckpointOpen(PETSC_COMM_WORLD, folder, "coupler", &file), "open");
  CHECK(!GaugesCreate(PETSC_COMM_WORLD, &c, &part.view, file, &resumed, &fault, &distance) && fault == -1,
        "load");
  Check(resumed, 0.7, 1.5, 0.1, "resumed");
  CHECK(!GaugesDestroy(&resumed) && !CheckpointClose(&file), "destroy");
  MPI_Barrier(PETSC_COMM_WORLD);
  snprintf(path, sizeof path, "%s/coupler.h5", folder);
  if (rank == 0) CHECK(!remove(path) && !remove(folder), "remove");
}

int main(int argc, char **argv)
{
  GaugesCase c = Case();
  Gauges g;
  double distance;
  int fault;
  CHECK(!PetscInitialize(&argc, &argv, NULL, NULL), "PETSc");
  MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
  MPI_Comm_size(PETSC_COMM_WORLD, &size);
  SyntheticDisc(&all, CENTRE, RADIUS, 3, SECTORS);
  SyntheticSolidPart(&all, rank, size, &part);
  CHECK(!GaugesCreate(PETSC_COMM_WORLD, &c, &part.view, NULL, &g, &fault, &distance) && fault == -1,
        "create");
  Check(g, 0.0, 1.0, 0.0, "start");
  Move(0.7, 1.5, 0.1);
  CHECK(!GaugesMove(g, &part.view), "move");
  Check(g, 0.7, 1.5, 0.1, "moved");
  CheckResumed(g);
  for (int i = 0; i < all.nnodes; i++)
    all.gid[i] += 1000; /* as if cracks had split every node of the surface */
  SyntheticSolidPart(&all, rank, size, &part);
  CHECK(!GaugesMove(g, &part.view), "move");
  Check(g, 0.7, 1.5, 0.1, "with other ids");
  CHECK(!GaugesDestroy(&g), "destroy");
  SyntheticDisc(&all, CENTRE, RADIUS, 3, SECTORS);
  SyntheticSolidPart(&all, rank, size, &part);
  c.point[1][0] = CENTRE[0];
  c.point[1][1] = CENTRE[1] + 0.5 * RADIUS;
  CHECK(!GaugesCreate(PETSC_COMM_WORLD, &c, &part.view, NULL, &g, &fault, &distance), "create");
  CHECK(fault == 1 && distance > 0.3 * RADIUS && distance < 0.9 * RADIUS, "fault %d, %g m away", fault,
        distance);
  CHECK(!GaugesDestroy(&g), "destroy");
  return PetscFinalize();
}
