/* Pair integrals against quadrature, partition of unity, and Galerkin projection between random meshes. */
#include "common/space/quadrature.h"
#include "common/supermesh/projection.h"
#include "common/supermesh/supermesh.h"
#include "tests/supermesh/random_mesh.h"

enum { NA = 13, NB = 21 };

static double (*a)[3][2], (*b)[3][2];
static const int na = 2 * NA * NA, nb = 2 * NB * NB;
static SupermeshPairs pairs;

/* The same integral by a degree-2 rule on the fan. */
static double QuadratureAB(const SupermeshPair *pair, int i, int j)
{
  const Quadrature *rule = QuadratureOf(2);
  const double(*ta)[2] = (const double(*)[2])a[pair->a], (*tb)[2] = (const double(*)[2])b[pair->b];
  double polygon[GEOMETRY_CLIP_MAX][2], sum = 0.0;
  const int n = GeometryClip(ta, tb, polygon);
  for (int k = 0; k + 2 < n; k++) {
    double x[3][2];
    GeometryFan((const double(*)[2])polygon, k, x);
    for (int q = 0; q < rule->n; q++) {
      double p[2] = {0, 0}, fa[3], fb[3];
      for (int v = 0; v < 3; v++) {
        for (int c = 0; c < 2; c++) p[c] += rule->point[q][v] * x[v][c];
      }
      GeometryBarycentric(ta, p, fa);
      GeometryBarycentric(tb, p, fb);
      sum += rule->weight[q] * GeometryArea((const double(*)[2])x) * fa[i] * fb[j];
    }
  }
  return sum;
}

static void CheckPairs(void)
{
  double total = 0.0, *covered = calloc((size_t)na, sizeof *covered);
  for (int p = 0; p < pairs.n; p++) {
    const SupermeshPair *pair = &pairs.pair[p];
    double aa = 0, ab = 0, bb = 0;
    for (int i = 0; i < 3; i++) {
      for (int j = 0; j < 3; j++) {
        aa += pair->aa[i][j];
        ab += pair->ab[i][j];
        bb += pair->bb[i][j];
        CHECK(fabs(pair->ab[i][j] - QuadratureAB(pair, i, j)) < 1e-16, "pair %d, %d %d", p, i, j);
      }
    }
    CHECK(fabs(aa - pair->area) < 1e-16 && fabs(ab - pair->area) < 1e-16 && fabs(bb - pair->area) < 1e-16,
          "pair %d: functions do not sum to 1", p);
    covered[pair->a] += pair->area;
    total += pair->area;
  }
  CHECK(fabs(total - 1.0) < 1e-13, "areas sum to %.16g, not 1", total);
  for (int i = 0; i < na; i++) {
    CHECK(fabs(covered[i] - GeometryArea((const double(*)[2])a[i])) < 1e-16, "triangle %d is not covered", i);
  }
  free(covered);
}

static double Linear(const double x[2])
{
  return 3.0 - 2.0 * x[0] + 7.0 * x[1];
}

static double Integral(int n, const double x[][3][2], int comp, const double f[][2][3])
{
  double sum = 0.0;
  for (int t = 0; t < n; t++)
    sum += GeometryArea(x[t]) * (f[t][comp][0] + f[t][comp][1] + f[t][comp][2]) / 3.0;
  return sum;
}

/* Component 0 is a P1 field, component 1 random values. */
static void CheckProjection(int ns, const double xs[][3][2], int nt, const double xt[][3][2])
{
  Search search;
  Projection projection;
  double(*source)[2][3] = malloc(sizeof(double[2][3]) * (size_t)ns), (*target)[2][3];
  target = malloc(sizeof(double[2][3]) * (size_t)nt);
  for (int s = 0; s < ns; s++) {
    for (int v = 0; v < 3; v++) {
      source[s][0][v] = Linear(xs[s][v]);
      source[s][1][v] = Random(-1.0, 1.0);
    }
  }
  CHECK(SearchCreateTriangles(ns, xs, &search) == 0, "no memory");
  CHECK(ProjectionCreate(nt, xt, search, xs, &projection) == 0, "no memory");
  CHECK(ProjectionPairs(projection) == pairs.n, "%d pairs, not %d", ProjectionPairs(projection), pairs.n);
  ProjectionApply(projection, 2, &source[0][0][0], NULL, &target[0][0][0]);
  for (int t = 0; t < nt; t++) {
    for (int v = 0; v < 3; v++) {
      CHECK(fabs(target[t][0][v] - Linear(xt[t][v])) < 1e-11, "a P1 field is not reproduced: error %g",
            target[t][0][v] - Linear(xt[t][v]));
    }
  }
  for (int c = 0; c < 2; c++) {
    const double before = Integral(ns, xs, c, (const double(*)[2][3])source);
    const double after = Integral(nt, xt, c, (const double(*)[2][3])target);
    CHECK(fabs(after - before) < 1e-12, "integral %d changes by %g", c, after - before);
  }
  ProjectionDestroy(&projection);
  SearchDestroy(&search);
  free(source);
  free(target);
}

int main(void)
{
  Search search;
  a = RandomMesh(NA, 1);
  b = RandomMesh(NB, 2);
  const double(*xa)[3][2] = (const double(*)[3][2])a, (*xb)[3][2] = (const double(*)[3][2])b;
  CHECK(SearchCreateTriangles(nb, xb, &search) == 0, "no memory");
  CHECK(SupermeshIntersect(na, xa, search, xb, &pairs) == 0, "no memory");
  CheckPairs();
  CheckProjection(na, xa, nb, xb);
  CheckProjection(nb, xb, na, xa);
  SearchDestroy(&search);
  SupermeshPairsDestroy(&pairs);
  free(a);
  free(b);
  return 0;
}
