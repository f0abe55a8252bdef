/* Recovered Hessians: exact for cubics on any mesh, order 2 for a smooth field on shaken meshes; and a mesh
 * adapted to them spreads the interpolation error. */
#include "tests/adapt/kept.h"

static double Cubic(const double x[2])
{
  return 1.0 + x[0] * x[0] * x[1] - 2.0 * x[1] * x[1] * x[1] + x[0] * x[1];
}

static void CubicHessian(const double x[2], double h[3])
{
  h[0] = 2.0 * x[1];
  h[1] = 2.0 * x[0] + 1.0;
  h[2] = -12.0 * x[1];
}

static double Wave(const double x[2])
{
  return sin(3.0 * x[0] + x[1]) * exp(x[1]);
}

static void WaveHessian(const double x[2], double h[3])
{
  const double s = sin(3.0 * x[0] + x[1]) * exp(x[1]), c = cos(3.0 * x[0] + x[1]) * exp(x[1]);
  h[0] = -9.0 * s;
  h[1] = 3.0 * c - 3.0 * s;
  h[2] = 2.0 * c;
}

/* Inner vertices move by up to a fifth of the size. */
static void ShakenBox(double size, MeshSerial *m)
{
  const double lower[2] = {0.0, 0.0}, upper[2] = {1.0, 1.0};
  unsigned long long seed = 5;
  Box(lower, upper, size, m);
  for (int k = 0; k < 2 * m->nv; k++) {
    const double *x = &m->x[k - k % 2], shift = 0.4 * size * (Random(&seed) - 0.5);
    if (fmin(fmin(x[0], 1.0 - x[0]), fmin(x[1], 1.0 - x[1])) > 0.5 * size) m->x[k] += shift;
  }
}

static double Error(double size, double (*field)(const double[2]), void (*exact)(const double[2], double[3]))
{
  MeshSerial m;
  double worst = 0.0;
  ShakenBox(size, &m);
  double *f = malloc((size_t)m.nv * sizeof *f), *h = malloc((size_t)m.nv * 3 * sizeof *h);
  for (int v = 0; v < m.nv; v++) f[v] = field(&m.x[2 * v]);
  CHECK(!HessianRecover(&m, 1, (const double *const[]){f}, (double *const[]){h}), "not recovered");
  for (int v = 0; v < m.nv; v++) {
    double e[3];
    exact(&m.x[2 * v], e);
    for (int k = 0; k < 3; k++) worst = fmax(worst, fabs(h[3 * v + k] - e[k]));
  }
  free(f);
  free(h);
  MeshSerialDestroy(&m);
  return worst;
}

/* A steep front: interpolation error at edge midpoints of a mesh made for 1e-3. */
static double Front(const double x[2])
{
  return tanh(40.0 * (x[0] + 0.4 * x[1] - 0.7));
}

static double FrontError(const MeshSerial *m)
{
  double worst = 0.0;
  for (int c = 0; c < 3 * m->ne; c++) {
    const double *p = &m->x[2 * m->vertex[c]], *q = &m->x[2 * m->vertex[c - c % 3 + (c + 1) % 3]];
    const double middle[2] = {0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1])};
    worst = fmax(worst, fabs(Front(middle) - 0.5 * (Front(p) + Front(q))));
  }
  return worst;
}

static void CheckFront(void)
{
  const double lower[2] = {0.0, 0.0}, upper[2] = {1.0, 1.0};
  AdaptResult result, last = {0};
  MeshSerial start;
  const MeshSerial *from = &start;
  Box(lower, upper, 0.05, &start);
  for (int k = 0; k < 8; k++) {
    double *f = malloc((size_t)from->nv * sizeof *f), *m = malloc((size_t)from->nv * 3 * sizeof *m);
    for (int v = 0; v < from->nv; v++) f[v] = Front(&from->x[2 * v]);
    CHECK(!HessianRecover(from, 1, (const double *const[]){f}, (double *const[]){m}) &&
              !MetricFromHessian(from->nv, m, 1e-3, 0.2, m),
          "no metric");
    CHECK(!MetricBound(from->nv, 1e-4, 0.2, 1000.0, m) && !MetricGrade(from, 2.0, m), "no bounds");
    CHECK(!MeshAdapt(from, m, NULL, &result), "not adapted");
    CheckKept(from, &result);
    AdaptResultDestroy(&last);
    last = result;
    from = &last.mesh;
    free(f);
    free(m);
  }
  const double error = FrontError(from);
  CHECK(error < 2.5e-3, "interpolation error %g with %d triangles, made for 1e-3", error, from->ne);
  CHECK(from->ne < 4000, "%d triangles; equal ones would be 40 000", from->ne);
  AdaptResultDestroy(&last);
  MeshSerialDestroy(&start);
}

int main(int argc, char **argv)
{
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  const double cubic = Error(0.1, Cubic, CubicHessian);
  CHECK(cubic < 1e-8, "error %g of a cubic's Hessian", cubic);
  const double coarse = Error(0.05, Wave, WaveHessian), fine = Error(0.0125, Wave, WaveHessian);
  const double order = 0.5 * log2(coarse / fine);
  CHECK(order > 1.8, "errors %g and %g: order %g", coarse, fine, order);
  CheckFront();
  return PetscFinalize();
}
