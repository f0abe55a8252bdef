/* Pair integrals against quadrature, partition of unity, and Galerkin projection between random meshes. */
#include "common/supermesh/projection.h"
#include "common/supermesh/supermesh.h"
#include "tests/quadrature.h"
#include "tests/supermesh/random_mesh.h"

enum { NA = 13, NB = 21 };

static double (*a)[3][2], (*b)[3][2];
static int na, nb;
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
    PolygonFan((const double(*)[2])polygon, k, x);
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
    const SupermeshBasis of_a = SupermeshBasisOf((const double(*)[2])a[pair->a]),
                         of_b = SupermeshBasisOf((const double(*)[2])b[pair->b]);
    double product[3][3], sum = 0.0;
    SupermeshProduct(pair, &of_a, &of_b, product);
    for (int i = 0; i < 3; i++) {
      for (int j = 0; j < 3; j++) {
        sum += product[i][j];
        CHECK(fabs(product[i][j] - QuadratureAB(pair, i, j)) < 1e-16, "pair %d, %d %d", p, i, j);
      }
    }
    CHECK(fabs(sum - pair->area) < 1e-16, "pair %d: functions do not sum to 1", p);
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

/* Finds and checks the pairs of a and b. */
static void CheckMeshes(void)
{
  Search search;
  CHECK(SearchCreateTriangles(nb, (const double(*)[3][2])b, &search) == 0, "no memory");
  CHECK(SupermeshIntersect(na, (const double(*)[3][2])a, search, (const double(*)[3][2])b, &pairs) == 0,
        "no memory");
  CheckPairs();
  SearchDestroy(&search);
}

/* Edges and vertices lie on each other: a mesh meets itself in its own triangles alone; two of them share the square's sides. */
static void CheckTouching(void)
{
  na = nb = 2 * NA * NA;
  a = RandomMesh(NA, 1);
  b = RandomMesh(NA, 1);
  CheckMeshes();
  CHECK(pairs.n == na, "%d pairs of %d triangles with themselves", pairs.n, na);
  free(b);
  nb = 2;
  b = RandomMesh(1, 1);
  CheckMeshes();
  free(a);
  free(b);
}

/* Columns and rows of a hundredth of their length and less, which cross (their projections: tests/transfer). */
static void CheckSlender(void)
{
  na = 2 * NA * NA;
  nb = 2 * NB * NB;
  a = RandomMesh(NA, 1);
  b = RandomMesh(NB, 2);
  for (int k = 0; k < 3 * na; k++) a[k / 3][k % 3][0] = pow(a[k / 3][k % 3][0], 3.0);
  for (int k = 0; k < 3 * nb; k++) b[k / 3][k % 3][1] = pow(b[k / 3][k % 3][1], 3.0);
  CheckMeshes();
  free(a);
  free(b);
}

int main(void)
{
  CheckTouching();
  CheckSlender();
  na = 2 * NA * NA;
  nb = 2 * NB * NB;
  a = RandomMesh(NA, 1);
  b = RandomMesh(NB, 2);
  CheckMeshes();
  CheckProjection(na, (const double(*)[3][2])a, nb, (const double(*)[3][2])b);
  CheckProjection(nb, (const double(*)[3][2])b, na, (const double(*)[3][2])a);
  SupermeshPairsDestroy(&pairs);
  free(a);
  free(b);
  return 0;
}
