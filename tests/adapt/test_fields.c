/* Analytic metrics: a ring as of a moving solid, a shear layer stretched 1000 times, a boundary layer, a
 * curved front: more than 95 % unit edges, in the analytic metric too, worst quality above 0.2, everything
 * kept. */
#include "tests/adapt/kept.h"

typedef struct {
  const char *name;
  MetricAt at;
  double lower[2], upper[2], start;
  int times;
} Field;

/* Isotropic, 0.004 on a circle, growing by 0.2 m/m. */
static void Ring(const void *context, const double x[2], double m[3])
{
  const double h = 0.004 + 0.2 * fabs(hypot(x[0] - 0.5, x[1] - 0.4) - 0.2);
  MetricOf(h, h, 0.0, m);
}

/* 1e-4 across the inclined line y = 0.35 + 0.3 x, 0.1 along it. */
static void Shear(const void *context, const double x[2], double m[3])
{
  const double d = fabs(x[1] - 0.35 - 0.3 * x[0]) / hypot(1.0, 0.3);
  MetricOf(0.1, fmin(0.1, 1e-4 + 0.2 * d), atan(0.3), m);
}

/* 1e-3 at the wall y = 0, growing by 0.15 m/m, at most 50 times as long as high. */
static void Layer(const void *context, const double x[2], double m[3])
{
  const double h = fmin(0.05, 1e-3 + 0.15 * x[1]);
  MetricOf(0.05, h, 0.0, m);
}

/* 5e-4 across a circle, 0.02 along it, as at a curved front. */
static void Front(const void *context, const double x[2], double m[3])
{
  const double dx = x[0] + 0.2, dy = x[1] + 0.2, d = fabs(hypot(dx, dy) - 0.8);
  MetricOf(0.02 + 0.2 * d, fmin(0.1, 5e-4 + 0.2 * d), atan2(dy, dx) + 0.5 * M_PI, m);
}

static int print;

static void CheckFit(const char *name, const AdaptReport *r, const char *which)
{
  const double share = (double)r->edges_unit / r->edges;
  if (print)
    printf("%-6s %-8s %7d edges, %.2f %% unit, in [%.3f, %.3f], quality worst %.3f mean %.3f\n", name, which,
           r->edges, 100.0 * share, r->shortest, r->longest, r->quality_worst, r->quality_mean);
  CHECK(share > 0.95, "%s: %.2f %% of the edges are unit in the %s metric", name, 100.0 * share, which);
  CHECK(r->shortest > 0.3 && r->longest < 1.6, "%s: edges from %g to %g in the %s metric", name, r->shortest,
        r->longest, which);
  CHECK(r->quality_worst > 0.2, "%s: worst quality %g in the %s metric", name, r->quality_worst, which);
}

static void Run(const Field *f)
{
  MeshSerial start;
  AdaptResult result;
  AdaptReport analytic = {0};
  Box(f->lower, f->upper, f->start, &start);
  AdaptTo(&start, f->at, NULL, f->times, &result);
  CheckFit(f->name, &result.report, "given");
  double *metric = SampleMetric(&result.mesh, f->at, NULL);
  CHECK(!AdaptMeasure(&result.mesh, metric, &analytic), "not measured");
  CheckFit(f->name, &analytic, "analytic");
  free(metric);
  AdaptResultDestroy(&result);
  MeshSerialDestroy(&start);
}

int main(int argc, char **argv)
{
  const Field field[] = {{"ring", Ring, {0.0, 0.0}, {1.0, 1.0}, 0.05, 4},
                         {"shear", Shear, {0.0, 0.0}, {1.0, 1.0}, 0.05, 10},
                         {"layer", Layer, {0.0, 0.0}, {2.0, 1.0}, 0.1, 6},
                         {"front", Front, {0.0, 0.0}, {1.0, 1.0}, 0.05, 8}};
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  print = argc > 1;
  for (size_t k = 0; k < sizeof field / sizeof field[0]; k++) Run(&field[k]);
  return PetscFinalize();
}
