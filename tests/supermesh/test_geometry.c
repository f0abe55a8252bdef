/* Clipping neither makes nor loses area, also when edges and vertices coincide. */
#include "tests/quadrature.h"
#include "tests/supermesh/random_mesh.h"

static void RandomTriangle(double x[3][2])
{
  do {
    for (int i = 0; i < 3; i++) {
      for (int c = 0; c < 2; c++) x[i][c] = Random(0.0, 1.0);
    }
  } while (GeometryArea((const double(*)[2])x) < 0.01);
}

static double ClipArea(const double a[3][2], const double b[3][2])
{
  double polygon[GEOMETRY_CLIP_MAX][2], x[3][2], area = 0.0;
  const int n = GeometryClip(a, b, polygon);
  for (int k = 0; k + 2 < n; k++) {
    PolygonFan((const double(*)[2])polygon, k, x);
    area += GeometryArea((const double(*)[2])x);
  }
  return area;
}

/* Cut b by a in the four parts that the lines from a point of b to its vertices make of it: parts sum to the
 * whole. */
static void CheckSplit(void)
{
  for (int trial = 0; trial < 20000; trial++) {
    double a[3][2], b[3][2], n[3], centre[2], sum = 0.0;
    RandomTriangle(a);
    RandomTriangle(b);
    n[1] = Random(0.1, 0.4);
    n[2] = Random(0.1, 0.4);
    n[0] = 1.0 - n[1] - n[2];
    for (int c = 0; c < 2; c++) centre[c] = n[0] * b[0][c] + n[1] * b[1][c] + n[2] * b[2][c];
    for (int k = 0; k < 3; k++) {
      double part[3][2];
      memcpy(part, b, sizeof part);
      memcpy(part[k], centre, sizeof centre);
      sum += ClipArea((const double(*)[2])a, (const double(*)[2])part);
    }
    const double ab = ClipArea((const double(*)[2])a, (const double(*)[2])b);
    const double ba = ClipArea((const double(*)[2])b, (const double(*)[2])a);
    CHECK(fabs(ab - ba) < 1e-15 && fabs(sum - ab) < 2e-15, "trial %d: %.17g %.17g %.17g", trial, ab, ba, sum);
  }
}

static void CheckDegenerate(void)
{
  const double unit[3][2] = {{0, 0}, {1, 0}, {0, 1}};
  const double across[3][2] = {{1, 0}, {1, 1}, {0, 1}}; /* shares the long edge */
  const double corner[3][2] = {{1, 0}, {2, 0}, {1, 1}}; /* shares one vertex */
  const double half[3][2] = {{0, 0}, {0.5, 0}, {0, 1}}; /* vertex on an edge, two edges in common */
  const double inner[3][2] = {{0.25, 0.25}, {0.5, 0.25}, {0.25, 0.5}};
  const double far[3][2] = {{5, 5}, {6, 5}, {5, 6}};
  const double below[3][2] = {{-1, -1}, {2, -1}, {0.25, 0}}; /* touches an edge with a vertex */
  CHECK(ClipArea(unit, unit) == 0.5, "itself");
  CHECK(ClipArea(unit, across) == 0.0 && ClipArea(across, unit) == 0.0, "shared edge");
  CHECK(ClipArea(unit, corner) == 0.0, "shared vertex");
  CHECK(ClipArea(unit, half) == 0.25 && ClipArea(half, unit) == 0.25, "part");
  CHECK(ClipArea(unit, inner) == 0.03125 && ClipArea(inner, unit) == 0.03125, "inside");
  CHECK(ClipArea(unit, far) == 0.0, "far");
  CHECK(ClipArea(unit, below) == 0.0, "vertex on edge");
}

static void CheckBarycentric(void)
{
  for (int trial = 0; trial < 1000; trial++) {
    double x[3][2], n[3];
    const double p[2] = {Random(0, 1), Random(0, 1)};
    RandomTriangle(x);
    GeometryBarycentric((const double(*)[2])x, p, n);
    CHECK(fabs(n[0] + n[1] + n[2] - 1.0) < 1e-14, "partition of unity");
    for (int c = 0; c < 2; c++) {
      CHECK(fabs(n[0] * x[0][c] + n[1] * x[1][c] + n[2] * x[2][c] - p[c]) < 1e-12, "position is reproduced");
    }
  }
}

int main(void)
{
  srand(1);
  CheckSplit();
  CheckDegenerate();
  CheckBarycentric();
  return 0;
}
