/* Random meshes with two regions and random metrics, smooth and rough, stretched up to 1000 times: every
 * result is a valid mesh that kept area, regions, tags and frozen vertices.  random [number, default 1500]
 * [first]. */
#include "tests/adapt/kept.h"

typedef unsigned long long Seed;

static double Between(Seed *seed, double lower, double upper)
{
  return lower + (upper - lower) * Random(seed);
}

/* Left and right of a vertical line, which is an inner boundary without a name. */
static void MakeRegions(MeshSerial *m, double middle)
{
  CHECK(!PetscMalloc1(m->ne, &m->region) && !PetscCalloc1(2, &m->region_name), "no memory");
  m->nregions = 2;
  for (int e = 0; e < m->ne; e++) {
    const int *v = &m->vertex[3 * e];
    m->region[e] = m->x[2 * v[0]] + m->x[2 * v[1]] + m->x[2 * v[2]] > 3.0 * middle;
  }
}

static void MakeMesh(Seed *seed, MeshSerial *m)
{
  const double lower[2] = {Between(seed, -1.0, 1.0), Between(seed, -1.0, 1.0)};
  const double upper[2] = {lower[0] + Between(seed, 0.5, 2.0), lower[1] + Between(seed, 0.5, 2.0)};
  Box(lower, upper, Between(seed, 0.1, 0.5), m);
  /* turned, so that no line lies along an axis */
  const double c = cos(Between(seed, 0.0, 3.0)), s = sqrt(1.0 - c * c);
  MakeRegions(m, 0.5 * (lower[0] + upper[0]));
  for (int v = 0; v < m->nv; v++) {
    const double x = m->x[2 * v], y = m->x[2 * v + 1];
    m->x[2 * v] = c * x - s * y;
    m->x[2 * v + 1] = s * x + c * y;
  }
}

/* Rough: independent tensors; smooth: sizes and direction are waves. */
static double *MakeMetric(Seed *seed, const MeshSerial *m, double triangles)
{
  const int rough = Random(seed) < 0.3, graded = Random(seed) < 0.5;
  const double stretch = pow(10.0, Between(seed, 0.0, 3.0)), kx = Between(seed, -8.0, 8.0);
  const double ky = Between(seed, -8.0, 8.0), size = Between(seed, 0.0, 2.0), turn = Between(seed, 0.0, 3.0);
  double *metric = malloc((size_t)m->nv * 3 * sizeof *metric);
  for (int v = 0; v < m->nv; v++) {
    const double wave = kx * m->x[2 * v] + ky * m->x[2 * v + 1];
    const double h = rough ? exp(Between(seed, -size, size)) : exp(size * sin(wave));
    const double ratio = rough ? pow(stretch, Random(seed)) : pow(stretch, 0.5 + 0.5 * cos(wave + turn));
    MetricOf(h, h / ratio, rough ? Between(seed, 0.0, 3.0) : turn + sin(wave), &metric[3 * v]);
  }
  ScaleTo(m, triangles, metric);
  if (graded) CHECK(!MetricGrade(m, 1.5, metric), "not graded");
  if (graded) ScaleTo(m, triangles, metric);
  return metric;
}

static void CheckFrozen(const MeshSerial *before, const char frozen[], const AdaptResult *r)
{
  int expected = 0, found = 0;
  for (int v = 0; v < before->nv; v++) expected += frozen[v];
  for (int v = 0; v < r->mesh.nv; v++) found += r->origin[v] >= 0 && frozen[r->origin[v]];
  CHECK(found == expected, "%d of %d frozen vertices are left", found, expected);
}

/* Two adaptations in a row: to a budget, then from there to another metric. */
static void CoracleCase(Seed *seed)
{
  MeshSerial start;
  AdaptResult first, second;
  MakeMesh(seed, &start);
  char *frozen = calloc((size_t)start.nv, 1);
  const double share = Random(seed) < 0.5 ? 0.0 : 0.2 * Random(seed);
  for (int v = 0; v < start.nv; v++) frozen[v] = Random(seed) < share;
  const AdaptOptions options = {.frozen = frozen};
  double *metric = MakeMetric(seed, &start, exp(Between(seed, 2.0, 7.0)));
  CHECK(!MeshAdapt(&start, metric, &options, &first), "adaptation failed");
  CheckKept(&start, &first);
  CheckFrozen(&start, frozen, &first);
  free(metric);
  metric = MakeMetric(seed, &first.mesh, exp(Between(seed, 2.0, 7.0)));
  CHECK(!MeshAdapt(&first.mesh, metric, NULL, &second), "adaptation failed");
  CheckKept(&first.mesh, &second);
  free(metric);
  free(frozen);
  AdaptResultDestroy(&first);
  AdaptResultDestroy(&second);
  MeshSerialDestroy(&start);
}

int main(int argc, char **argv)
{
  const int number = argc > 1 ? atoi(argv[1]) : 1000, start = argc > 2 ? atoi(argv[2]) : 0;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  for (int k = start; k < start + number; k++) {
    Seed seed = 0x9E3779B97F4A7C15ULL * (Seed)(k + 1);
    CoracleCase(&seed);
  }
  return PetscFinalize();
}
