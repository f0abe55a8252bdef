/* Element kernels against exact integrals: quadratures to their degree, P1 mass, P2 gradients and
 * projections. */
#include "common/space/element.h"
#include "common/space/p1.h"
#include "common/space/p2.h"
#include "tests/check.h"
#include "tests/quadrature.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static double Random(void)
{
  return rand() / (double)RAND_MAX;
}

static void RandomTriangle(double x[3][2])
{
  double area;
  do {
    for (int i = 0; i < 6; i++) x[i / 2][i % 2] = Random();
    area = 0.5 * ((x[1][0] - x[0][0]) * (x[2][1] - x[0][1]) - (x[2][0] - x[0][0]) * (x[1][1] - x[0][1]));
  } while (area < 0.01);
}

/* int over the unit triangle of x^p y^q = p! q! / (p + q + 2)! */
static void CheckQuadrature(void)
{
  const double factorial[] = {1, 1, 2, 6, 24, 120, 720};
  for (int degree = 2; degree <= 4; degree++) {
    const Quadrature *rule = QuadratureOf(degree);
    for (int p = 0; p <= degree; p++) {
      for (int q = 0; p + q <= degree; q++) {
        double sum = 0.0;
        for (int k = 0; k < rule->n; k++) {
          sum += 0.5 * rule->weight[k] * pow(rule->point[k][1], p) * pow(rule->point[k][2], q);
        }
        const double exact = factorial[p] * factorial[q] / factorial[p + q + 2];
        CHECK(fabs(sum - exact) < 1e-15, "degree %d, x^%d y^%d: %.17g, not %.17g", degree, p, q, sum, exact);
      }
    }
  }
}

/* Any P2 function: value and gradient at x. */
typedef struct {
  double c[6];
} Quadratic;

static double At(const Quadratic *q, const double x[2])
{
  const double *c = q->c;
  return c[0] + c[1] * x[0] + c[2] * x[1] + c[3] * x[0] * x[0] + c[4] * x[0] * x[1] + c[5] * x[1] * x[1];
}

static void GradientAt(const Quadratic *q, const double x[2], double g[2])
{
  g[0] = q->c[1] + 2.0 * q->c[3] * x[0] + q->c[4] * x[1];
  g[1] = q->c[2] + q->c[4] * x[0] + 2.0 * q->c[5] * x[1];
}

static void Nodes(const double x[3][2], const Quadratic *q, double p[6])
{
  for (int i = 0; i < 3; i++) {
    const double *a = x[(i + 1) % 3], *b = x[(i + 2) % 3];
    const double mid[2] = {0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])};
    p[i] = At(q, x[i]);
    p[3 + i] = At(q, mid);
  }
}

static Quadratic RandomQuadratic(void)
{
  Quadratic q;
  for (int k = 0; k < 6; k++) q.c[k] = Random() - 0.5;
  return q;
}

static void Point(const double x[3][2], const double n[3], double at[2])
{
  for (int c = 0; c < 2; c++) at[c] = n[0] * x[0][c] + n[1] * x[1][c] + n[2] * x[2][c];
}

/* Both ways of computing gradients agree; they are those of the barycentric coordinates. */
static void CheckGradients(const double x[3][2], const ElementGeometry *e)
{
  double g[3][2], d[2][2];
  const double u[2][3] = {{x[0][0], x[1][0], x[2][0]}, {x[0][1], x[1][1], x[2][1]}};
  CHECK(fabs(P1Gradients(x, g) - e->area) < 1e-16 + 1e-14 * e->area, "area");
  P1VelocityGradient((const double(*)[2])g, u, d);
  for (int k = 0; k < 4; k++) CHECK(fabs(d[k / 2][k % 2] - (k % 3 == 0)) < 1e-12, "gradient of x is 1");
  for (int k = 0; k < 6; k++) CHECK(fabs(g[k / 2][k % 2] - e->g[k / 2][k % 2]) < 1e-12, "gradients differ");
}

/* int_K N_i q and back. */
static void CheckMass(const ElementGeometry *e)
{
  const double q[3] = {Random(), Random(), Random()};
  const Quadrature *rule = QuadratureOf(2);
  double m[3], back[3];
  P1MassApply(e->area, q, m);
  P1MassSolve(e->area, m, back);
  for (int i = 0; i < 3; i++) {
    double sum = 0.0;
    for (int k = 0; k < rule->n; k++) {
      const double *n = rule->point[k];
      sum += e->area * rule->weight[k] * n[i] * (n[0] * q[0] + n[1] * q[1] + n[2] * q[2]);
    }
    CHECK(fabs(m[i] - sum) < 1e-15 && fabs(back[i] - q[i]) < 1e-14, "mass: %.17g, not %.17g", m[i], sum);
  }
}

/* Values, gradients and projection of a P2 function; the transpose of the gradient; the stiffness matrix. */
static void CheckQuadratic(const double x[3][2], const ElementGeometry *e)
{
  const Quadratic a = RandomQuadratic(), b = RandomQuadratic();
  const Quadrature *rule = QuadratureOf(4);
  double p[6], r[6], grad[3][2], p1[3], s[6][6], moment[3] = {0.0}, mp[3], transpose[6] = {0.0};
  double mv[2][3], product = 0.0, exact = 0.0, volume = 0.0, weak = 0.0;
  Nodes(x, &a, p);
  Nodes(x, &b, r);
  P2Gradient(e->g, p, grad);
  for (int c = 0; c < 2; c++) P1MassApply(e->area, (double[3]){grad[0][c], grad[1][c], grad[2][c]}, mv[c]);
  P2GradientTranspose(e->g, (const double(*)[3])mv, transpose);
  P2Stiffness(e->area, e->g, 1.0, s);
  P2ProjectP1(p, p1);
  P1MassApply(e->area, p1, mp);
  for (int k = 0; k < 36; k++) product += r[k / 6] * s[k / 6][k % 6] * p[k % 6];
  for (int k = 0; k < 6; k++) weak += transpose[k] * r[k];
  for (int k = 0; k < rule->n; k++) {
    const double *n = rule->point[k], w = e->area * rule->weight[k];
    double at[2], ga[2], gb[2];
    Point(x, n, at);
    GradientAt(&a, at, ga);
    GradientAt(&b, at, gb);
    CHECK(fabs(P2Evaluate(p, n) - At(&a, at)) < 1e-14, "value");
    exact += w * (ga[0] * gb[0] + ga[1] * gb[1]);
    for (int i = 0; i < 3; i++) moment[i] += w * n[i] * At(&a, at);
    volume += w;
  }
  CHECK(fabs(volume - e->area) < 1e-15, "weights");
  CHECK(fabs(product - exact) < 1e-13 && fabs(weak - exact) < 1e-13, "%.17g %.17g, not %.17g", product, weak,
        exact);
  for (int i = 0; i < 3; i++) {
    double g[2];
    GradientAt(&a, x[i], g);
    CHECK(hypot(grad[i][0] - g[0], grad[i][1] - g[1]) < 1e-11, "gradient at vertex %d", i);
    CHECK(fabs(mp[i] - moment[i]) < 1e-15, "projection: %.17g, not %.17g", mp[i], moment[i]);
  }
}

int main(void)
{
  srand(1);
  CheckQuadrature();
  for (int trial = 0; trial < 1000; trial++) {
    double x[3][2];
    ElementGeometry e;
    RandomTriangle(x);
    ElementGeometryCompute(x[0], x[1], x[2], &e);
    CheckGradients((const double(*)[2])x, &e);
    CheckMass(&e);
    CheckQuadratic((const double(*)[2])x, &e);
  }
  return 0;
}
