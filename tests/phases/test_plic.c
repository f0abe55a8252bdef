// ranks: 1 2 3
/* Lines in cut elements: straight interfaces, layers and a T-junction of three phases are found to round-off
 * on random and on stretched meshes; a circle with order 2. */
#include "tests/phases/flows.h"

/* |current polygons - those of the lines|: largest distance of a vertex of phase p's polygon in a cut element
 * from the lines listed: each vertex must lie on one of them or on the element's outline. */
typedef struct {
  int n;
  HalfPlane line[3];
} Lines;

static double Outline(const double x[3][2], const double p[2])
{
  double least = HUGE_VAL;
  for (int i = 0; i < 3; i++) {
    const double *a = x[i], *b = x[(i + 1) % 3];
    least = fmin(least, fabs(GeometryTurn(a, b, p)) / hypot(b[0] - a[0], b[1] - a[1]));
  }
  return least;
}

/* Largest distance of the ends of the interface from the lines, in cut elements. */
static double Deviation(Phases f, const Stars *s, int np, const Lines *lines, int *cut)
{
  double worst = 0.0;
  *cut = 0;
  for (int e = 0; e < s->ne; e++) {
    if (PhasesSingle(f, e) >= 0) continue;
    (*cut)++;
    for (int p = 0; p < np; p++) {
      Polygon part;
      PhasesGetPolygon(f, e, p, &part);
      for (int k = 0; k < part.n; k++) {
        const double *a = part.x[k], *b = part.x[(k + 1) % part.n];
        const double middle[2] = {0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])};
        double least = Outline((const double(*)[2])s->element[e].x, middle);
        for (int l = 0; l < lines->n; l++) {
          const HalfPlane *h = &lines->line[l];
          const double da = fabs(h->n[0] * a[0] + h->n[1] * a[1] - h->d);
          const double db = fabs(h->n[0] * b[0] + h->n[1] * b[1] - h->d);
          least = fmin(least, fmax(da, db));
        }
        if (hypot(b[0] - a[0], b[1] - a[1]) > 1e-8) worst = fmax(worst, least);
      }
    }
  }
  MPI_Allreduce(MPI_IN_PLACE, &worst, 1, MPI_DOUBLE, MPI_MAX, s->mesh->comm);
  MPI_Allreduce(MPI_IN_PLACE, cut, 1, MPI_INT, MPI_SUM, s->mesh->comm);
  return worst;
}

static HalfPlane Line(double angle, double x, double y)
{
  HalfPlane h = {{cos(angle), sin(angle)}, 0.0};
  h.d = h.n[0] * x + h.n[1] * y;
  return h;
}

static Region HalfPlaneRegion(int phase, double angle, double x, double y)
{
  return (Region){.shape = REGION_HALF_PLANE, .phase = phase, .a = {x, y}, .b = {cos(angle), sin(angle)}};
}

/* Shaken mesh, squeezed by the power of its columns. */
static PetscErrorCode Straight(int kind, unsigned seed, double power)
{
  const Shaken shaken = {.n = 12, .seed = seed, .radius = 1.0, .power = {power, 0.0}};
  const double angle = 2.0 * M_PI * Chance(seed, 1, 1), x = 0.5 + 0.1 * Chance(seed, 2, 1);
  const int np = kind == 0 ? 2 : 3;
  Lines lines = {.n = np - 1, .line = {Line(angle, x, 0.5)}};
  Region region[3] = {HalfPlaneRegion(np - 1, 0.0, 9.0, 0.0)};
  Mesh *mesh;
  Stars *stars;
  Phases f;
  int cut;
  PetscFunctionBeginUser;
  if (kind == 1) { /* layers 0.3 apart, so thin that some elements have all three */
    lines.line[1] = Line(angle, x + 0.06 * cos(angle), 0.5 + 0.06 * sin(angle));
    region[1] = HalfPlaneRegion(1, angle, x + 0.06 * cos(angle), 0.5 + 0.06 * sin(angle));
    region[2] = HalfPlaneRegion(0, angle, x, 0.5);
  } else if (kind == 2) { /* T-junction */
    lines.line[1] = Line(angle + 1.1, x, 0.5);
    region[1] = HalfPlaneRegion(1, angle + 1.1, x, 0.5);
    region[2] = HalfPlaneRegion(0, angle, x, 0.5);
  } else {
    region[1] = HalfPlaneRegion(0, angle, x, 0.5);
  }
  PetscCall(ShakenMesh(PETSC_COMM_WORLD, &shaken, &mesh));
  PetscCall(StarsCreate(mesh, &stars));
  PetscCall(PhasesCreate(stars, np, &f));
  PetscCall(PhasesFill(f, np, region));
  PetscCall(PhasesReconstruct(f));
  const double worst = Deviation(f, stars, np, &lines, &cut);
  CHECK(cut > 8 && worst < 1e-10, "kind %d, seed %u, stretched by power %g: %d cut elements off by %g m",
        kind, seed, power, cut, worst);
  PetscCall(PhasesDestroy(&f));
  PetscCall(StarsDestroy(&stars));
  PetscCall(MeshDestroy(&mesh));
  PetscFunctionReturn(0);
}

/* Mean distance of the lines' ends from a circle, m. */
static PetscErrorCode Circle(int n, double *distance)
{
  const Shaken shaken = {.n = n, .seed = 5u, .radius = 1.0};
  double sum[2] = {0.0};
  Region region[BODY_REGIONS];
  Mesh *mesh;
  Stars *stars;
  Phases f;
  PetscFunctionBeginUser;
  PetscCall(ShakenMesh(PETSC_COMM_WORLD, &shaken, &mesh));
  PetscCall(StarsCreate(mesh, &stars));
  PetscCall(PhasesCreate(stars, 2, &f));
  DiscRegions(region);
  region[1] = (Region){.shape = REGION_DISC, .phase = 0, .a = {0.5, 0.5}, .radius = 0.3};
  PetscCall(PhasesFill(f, 2, region));
  PetscCall(PhasesReconstruct(f));
  for (int e = 0; e < mesh->ne; e++) {
    Polygon part;
    if (PhasesSingle(f, e) >= 0) continue;
    PetscCall(PhasesGetPolygon(f, e, 0, &part));
    for (int k = 0; k < part.n; k++) {
      const double *a = part.x[k], *b = part.x[(k + 1) % part.n];
      const double middle[2] = {0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])};
      if (Outline((const double(*)[2])stars->element[e].x, middle) < 1e-10) continue;
      sum[0] += fabs(hypot(a[0] - 0.5, a[1] - 0.5) - 0.3) * hypot(b[0] - a[0], b[1] - a[1]);
      sum[1] += hypot(b[0] - a[0], b[1] - a[1]);
    }
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sum, 2, MPI_DOUBLE, MPI_SUM, mesh->comm));
  *distance = sum[0] / sum[1];
  /* where the circle bulges over an edge, both elements have a line */
  CHECK(fabs(sum[1] - 0.6 * M_PI) < 0.06, "the lines are %g m long", sum[1]);
  PetscCall(PhasesDestroy(&f));
  PetscCall(StarsDestroy(&stars));
  PetscCall(MeshDestroy(&mesh));
  PetscFunctionReturn(0);
}

/* Drops, each with a bubble in it, that are small beside elements: pieces of elements are filled one by one. */
static PetscErrorCode Drops(void)
{
  enum { ROWS = 8, WATER = 0, BUBBLE = 1, AROUND = 2 };
  const Shaken shaken = {.n = 2, .seed = 3u, .radius = 1.0};
  const double radius[2] = {0.04, 0.02};
  Region region[1 + 2 * ROWS * ROWS] = {HalfPlaneRegion(AROUND, 0.0, 9.0, 0.0)};
  double all[3] = {0.0}, expected[2];
  const double *volume;
  int n = 1;
  Mesh *mesh;
  Stars *stars;
  Phases f;
  PetscFunctionBeginUser;
  for (int k = 0; k < 2 * ROWS * ROWS; k++)
    region[n++] = (Region){.shape = REGION_DISC,
                           .phase = k % 2 ? BUBBLE : WATER,
                           .a = {(k / 2 % ROWS + 0.5) / ROWS, (k / 2 / ROWS + 0.5) / ROWS},
                           .radius = radius[k % 2]};
  PetscCall(ShakenMesh(PETSC_COMM_WORLD, &shaken, &mesh));
  PetscCall(StarsCreate(mesh, &stars));
  PetscCall(PhasesCreate(stars, 3, &f));
  PetscCall(PhasesFill(f, n, region));
  PetscCall(PhasesGetVolumes(f, &volume));
  for (int e = 0; e < mesh->ne; e++)
    for (int p = 0; p < 3; p++) all[p] += volume[3 * e + p];
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, all, 3, MPI_DOUBLE, MPI_SUM, mesh->comm));
  expected[BUBBLE] = ROWS * ROWS * M_PI * radius[1] * radius[1];
  expected[WATER] = ROWS * ROWS * M_PI * radius[0] * radius[0] - expected[BUBBLE];
  for (int p = 0; p < 2; p++)
    CHECK(fabs(all[p] - expected[p]) < 1e-12, "phase %d has %.15g m2, not %.15g", p, all[p], expected[p]);
  PetscCall(PhasesDestroy(&f));
  PetscCall(StarsDestroy(&stars));
  PetscCall(MeshDestroy(&mesh));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  double d[2];
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  for (unsigned seed = 1; seed <= 12; seed++) {
    for (int kind = 0; kind < 3; kind++) {
      PetscCall(Straight(kind, seed, 1.0));
      PetscCall(Straight(kind, seed, 2.0));
    }
  }
  PetscCall(Drops());
  PetscCall(Circle(24, &d[0]));
  PetscCall(Circle(48, &d[1]));
  if (argc > 1) PetscCall(PetscPrintf(PETSC_COMM_WORLD, "circle: %g, %g m\n", d[0], d[1]));
  CHECK(d[0] < 7e-4 && d[1] < d[0] / 3.2, "ends of the lines lie %g and %g m off the circle", d[0], d[1]);
  return PetscFinalize();
}
