/* Round-off does not decide: a mesh and a metric that differ by 1e-14 are adapted to the same connectivity.
 * Two families: box meshes whose edges and diagonals have the very lengths that thresholds ask about, with
 * sizes that are powers of two of the cells', and random metrics stretched up to 100 times. near_ties
 * [number, default 20] [print]. */
#include "tests/adapt/kept.h"

typedef unsigned long long Seed;

static const double NOISE = 1e-14;

static double Between(Seed *seed, double lower, double upper)
{
  return lower + (upper - lower) * Random(seed);
}

/* Cells of edge 1/8, or finer ones near a corner. */
static double CornerSize(void *context, const double x[2])
{
  const double far = hypot(x[0], x[1]);
  return *(const double *)context > 0.0 && far < 0.4 ? 1.0 / 32.0 : 1.0 / 8.0;
}

static void MakeMesh(Seed *seed, MeshSerial *m)
{
  const double lower[2] = {0.0, 0.0}, upper[2] = {1.0, Random(seed) < 0.5 ? 1.0 : 0.75};
  double graded = Random(seed) - 0.5;
  CHECK(!MeshBox(lower, upper, 0.125, CornerSize, &graded, m), "no box");
}

/* Sizes of 2^-k by bands, of sqrt(2) times these in some cases, maybe stretched 2, 4 or 8 times along an
 * axis. */
static void StructuredMetric(Seed *seed, const MeshSerial *m, double metric[])
{
  const double base =
      0.25 * pow(0.5, floor(Between(seed, 0.0, 4.0))) * (Random(seed) < 0.3 ? sqrt(2.0) : 1.0);
  const double stretch = Random(seed) < 0.5 ? 1.0 : pow(2.0, 1.0 + floor(Between(seed, 0.0, 3.0)));
  const double centre[2] = {0.25 * floor(Between(seed, 0.0, 5.0)), 0.25 * floor(Between(seed, 0.0, 4.0))};
  const double radius = 0.125 * floor(Between(seed, 0.0, 6.0)) + 0.01, ratio = Random(seed) < 0.5 ? 2.0 : 4.0;
  const int graded = Random(seed) < 0.5;
  for (int v = 0; v < m->nv; v++) {
    const double far = fmax(fabs(m->x[2 * v] - centre[0]), fabs(m->x[2 * v + 1] - centre[1]));
    const double h = far < radius ? base / ratio : base;
    MetricOf(h, h / stretch, 0.0, &metric[3 * v]);
  }
  if (graded) CHECK(!MetricGrade(m, 1.5, metric), "not graded");
}

/* Sizes and direction are waves, stretched up to 100 times. */
static void RandomMetric(Seed *seed, const MeshSerial *m, double metric[])
{
  const double stretch = pow(10.0, Between(seed, 0.0, 2.0)), kx = Between(seed, -8.0, 8.0);
  const double ky = Between(seed, -8.0, 8.0), size = Between(seed, 0.0, 1.5), turn = Between(seed, 0.0, 3.0);
  for (int v = 0; v < m->nv; v++) {
    const double wave = kx * m->x[2 * v] + ky * m->x[2 * v + 1], h = exp(size * sin(wave));
    MetricOf(h, h / pow(stretch, 0.5 + 0.5 * cos(wave + turn)), turn + sin(wave), &metric[3 * v]);
  }
  ScaleTo(m, exp(Between(seed, 4.0, 7.5)), metric);
}

static void Shake(Seed *seed, MeshSerial *m, double metric[])
{
  for (int k = 0; k < 2 * m->nv; k++) m->x[k] += NOISE * Between(seed, -1.0, 1.0);
  for (int k = 0; k < 3 * m->nv; k++) metric[k] *= 1.0 + NOISE * Between(seed, -1.0, 1.0);
}

static int IsSame(const MeshSerial *a, const MeshSerial *b)
{
  return a->ne == b->ne && a->nv == b->nv &&
         !memcmp(a->vertex, b->vertex, 3 * (size_t)a->ne * sizeof *a->vertex);
}

/* Adapts the mesh and a shaken copy; *far: the largest distance of vertices where the connectivity is the
 * same. */
static int Adapt(Seed *seed, MeshSerial *mesh, double metric[], double *far, AdaptResult *result)
{
  AdaptResult shaken;
  CHECK(!MeshAdapt(mesh, metric, NULL, result), "adaptation failed");
  double *x = malloc(2 * (size_t)mesh->nv * sizeof *x);
  memcpy(x, mesh->x, 2 * (size_t)mesh->nv * sizeof *x);
  Shake(seed, mesh, metric);
  CHECK(!MeshAdapt(mesh, metric, NULL, &shaken), "adaptation failed");
  memcpy(mesh->x, x, 2 * (size_t)mesh->nv * sizeof *x);
  free(x);
  const int same = IsSame(&result->mesh, &shaken.mesh);
  for (int k = 0; same && k < 2 * shaken.mesh.nv; k++)
    *far = fmax(*far, fabs(shaken.mesh.x[k] - result->mesh.x[k]));
  AdaptResultDestroy(&shaken);
  return same;
}

typedef void (*MakeMetric)(Seed *seed, const MeshSerial *m, double metric[]);

/* Twice in a row, to two metrics; the number of adaptations that part. */
static int AdaptTwice(Seed *seed, MakeMetric make, double *far)
{
  MeshSerial start;
  AdaptResult first, second;
  int parted = 0;
  MakeMesh(seed, &start);
  double *metric = malloc(3 * (size_t)start.nv * sizeof *metric);
  make(seed, &start, metric);
  parted += !Adapt(seed, &start, metric, far, &first);
  metric = realloc(metric, 3 * (size_t)first.mesh.nv * sizeof *metric);
  make(seed, &first.mesh, metric);
  parted += !Adapt(seed, &first.mesh, metric, far, &second);
  free(metric);
  AdaptResultDestroy(&first);
  AdaptResultDestroy(&second);
  MeshSerialDestroy(&start);
  return parted;
}

static int Family(const char *name, int number, MakeMetric make, int print)
{
  double far = 0.0;
  int parted = 0;
  for (int k = 0; k < number; k++) {
    Seed seed = 0x9E3779B97F4A7C15ULL * (Seed)(k + 1);
    parted += AdaptTwice(&seed, make, &far);
  }
  if (print)
    printf("%s: %d of %d adaptations part, vertices of the others within %.1e\n", name, parted, 2 * number,
           far);
  return parted;
}

int main(int argc, char **argv)
{
  const int number = argc > 1 ? atoi(argv[1]) : 20, print = argc > 2;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  const int structured = Family("structured", number, StructuredMetric, print);
  const int random = Family("random", number, RandomMetric, print);
  CHECK(structured == 0 && random == 0, "%d and %d of %d adaptations part", structured, random, 2 * number);
  return PetscFinalize();
}
