/* Metric algebra and fields: logarithm and exponential, lengths against quadrature, intersection contains
 * both, bounds, gradation, count of triangles. */
#include "tests/adapt/kept.h"

typedef unsigned long long Seed;

static void RandomTensor(Seed *seed, double m[3])
{
  const double h = pow(10.0, 4.0 * Random(seed) - 3.0), ratio = pow(10.0, 3.0 * Random(seed));
  MetricOf(h, h / ratio, M_PI * Random(seed), m);
}

/* Smallest eigenvalue of A - factor B relative to B: at least 0 where A >= factor B. */
static double Excess(const double a[3], const double b[3], double factor)
{
  double least = INFINITY;
  for (int k = 0; k < 720; k++) {
    const double angle = M_PI * k / 720.0, c = cos(angle), s = sin(angle);
    const double of_b = factor * MetricSquare(b, c, s);
    least = fmin(least, (MetricSquare(a, c, s) - of_b) / of_b);
  }
  return least;
}

/* By how much B exceeds A in some direction, relative to A's largest eigenvalue.  Round-off leaves 1e-16
 * times the condition number, 1e6 here. */
static double Deficit(const double a[3], const double b[3])
{
  double lambda[2], axis[2], most = -INFINITY;
  MetricEigen(a, lambda, axis);
  for (int k = 0; k < 720; k++) {
    const double c = cos(M_PI * k / 720.0), s = sin(M_PI * k / 720.0);
    most = fmax(most, (MetricSquare(b, c, s) - MetricSquare(a, c, s)) / lambda[0]);
  }
  return most;
}

static void CheckTensors(void)
{
  Seed seed = 7;
  for (int k = 0; k < 2000; k++) {
    double m[3], n[3], log_m[3], back[3], both[3], lambda[2], axis[2];
    RandomTensor(&seed, m);
    RandomTensor(&seed, n);
    MetricLog(m, log_m);
    MetricExp(log_m, back);
    MetricEigen(m, lambda, axis);
    for (int i = 0; i < 3; i++)
      CHECK(fabs(back[i] - m[i]) < 1e-9 * lambda[0], "exp log M is %g, M %g", back[i], m[i]);
    memcpy(both, m, sizeof both);
    MetricIntersectTensor(n, 0.0, both);
    CHECK(Deficit(both, m) < 1e-10, "intersection leaves the first by %g", Deficit(both, m));
    CHECK(Deficit(both, n) < 1e-10, "intersection leaves the second by %g", Deficit(both, n));
    /* and is not smaller than needed: its ball touches both, or is one of the two */
    const double touch = fmin(fabs(Excess(both, m, 1.0)), fabs(Excess(both, n, 1.0)));
    CHECK(touch < 1e-2, "intersection is finer than both by %g", touch);
  }
}

/* Where sqrt(e^T M e) changes geometrically, Simpson's rule on 1000 points gives the length. */
static void CheckLengths(void)
{
  const double p[2] = {0.3, -0.2}, q[2] = {0.7, 0.1}, size = 0.5;
  for (double ratio = 1.0; ratio < 200.0; ratio *= 1.07) {
    double mp[3], mq[3], exact = 0.0;
    MetricOf(0.1, 0.1, 0.0, mp);
    MetricOf(0.1 * ratio, 0.1 * ratio, 0.0, mq);
    for (int k = 0; k <= 1000; k++) {
      const double weight = (k == 0 || k == 1000 ? 1.0 : k % 2 ? 4.0 : 2.0) / 3000.0;
      exact += weight * size / 0.1 * pow(ratio, -k / 1000.0);
    }
    const double length = MetricLength(p, q, mp, mq), back = MetricLength(q, p, mq, mp);
    CHECK(fabs(length - exact) < 1e-9 * exact, "ratio %g: length %.12g, exact %.12g", ratio, length, exact);
    CHECK(fabs(length - back) < 1e-13 * exact, "ratio %g: %.17g there, %.17g back", ratio, length, back);
  }
}

static void CheckBounds(void)
{
  Seed seed = 11;
  for (int k = 0; k < 1000; k++) {
    double m[3], lambda[2], axis[2];
    RandomTensor(&seed, m);
    CHECK(!MetricBound(1, 0.01, 0.5, 20.0, m), "not bounded");
    MetricEigen(m, lambda, axis);
    const double h0 = 1.0 / sqrt(lambda[0]), h1 = 1.0 / sqrt(lambda[1]);
    CHECK(h0 > 0.01 * (1 - 1e-9) && h1 < 0.5 * (1 + 1e-9), "sizes %g, %g", h0, h1);
    CHECK(h1 < 20.0 * h0 * (1 + 1e-9), "anisotropy %g", h1 / h0);
  }
}

/* Two spots of small size in a coarse field, one of them stretched. */
static void Spots(const void *context, const double x[2], double m[3])
{
  const int first = hypot(x[0] - 0.25, x[1] - 0.25) < 0.03, second = hypot(x[0] - 0.75, x[1] - 0.75) < 0.03;
  MetricOf(first ? 0.002 : 0.3, first ? 0.002 : second ? 0.001 : 0.3, 0.4, m);
}

static void CheckGradation(void)
{
  const double lower[2] = {0.0, 0.0}, upper[2] = {1.0, 1.0}, growth = 1.5;
  MeshSerial mesh;
  double worst = INFINITY, count;
  Box(lower, upper, 0.03, &mesh);
  double *before = SampleMetric(&mesh, Spots, NULL), *after = SampleMetric(&mesh, Spots, NULL);
  CHECK(!MetricGrade(&mesh, growth, after), "not graded");
  for (int c = 0; c < 3 * mesh.ne; c++) {
    const int p = mesh.vertex[c], q = mesh.vertex[c - c % 3 + (c + 1) % 3];
    const double ex = mesh.x[2 * q] - mesh.x[2 * p], ey = mesh.x[2 * q + 1] - mesh.x[2 * p + 1];
    const double lp = sqrt(MetricSquare(&after[3 * p], ex, ey)),
                 lq = sqrt(MetricSquare(&after[3 * q], ex, ey));
    worst = fmin(worst, Excess(&after[3 * q], &after[3 * p], pow(1.0 + lp * log(growth), -2.0)));
    worst = fmin(worst, Excess(&after[3 * p], &after[3 * q], pow(1.0 + lq * log(growth), -2.0)));
  }
  CHECK(worst > -1.1e-3, "sizes grow faster than given: %g", worst);
  for (int v = 0; v < mesh.nv; v++) {
    CHECK(Excess(&after[3 * v], &before[3 * v], 1.0) > -1e-9, "graded metric is coarser at vertex %d", v);
  }
  ScaleTo(&mesh, 5000.0, after);
  CHECK(!MetricCount(&mesh, after, &count), "not counted");
  CHECK(fabs(count - 5000.0) < 1e-6, "%g triangles", count);
  free(before);
  free(after);
  MeshSerialDestroy(&mesh);
}

/* As many triangles as are asked for come out, within a quarter: triangles are not equilateral, nor edges 1 long on average.
 */
static void CheckCount(void)
{
  const double lower[2] = {0.0, 0.0}, upper[2] = {1.0, 1.0};
  MeshSerial mesh;
  AdaptResult result;
  Box(lower, upper, 0.015, &mesh);
  double *metric = SampleMetric(&mesh, Spots, NULL);
  CHECK(!MetricGrade(&mesh, 1.5, metric), "not graded");
  ScaleTo(&mesh, 4000.0, metric);
  CHECK(!MeshAdapt(&mesh, metric, NULL, &result), "not adapted");
  CHECK(abs(result.mesh.ne - 4000) < 1000, "%d triangles, 4000 wanted", result.mesh.ne);
  free(metric);
  AdaptResultDestroy(&result);
  MeshSerialDestroy(&mesh);
}

int main(int argc, char **argv)
{
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  CheckTensors();
  CheckLengths();
  CheckBounds();
  CheckGradation();
  CheckCount();
  return PetscFinalize();
}
