#include "fluid/adapt/metric.h"
#include <math.h>
#include <string.h>

enum { MAX_PATCH = 160, CUBIC = 10, QUADRATIC = 6, MAX_RINGS = 5, MAX_FIELDS = HESSIAN_FIELDS };

/* Vertices next to a vertex; those of v are near[start[v] .. start[v + 1] - 1], each listed once or twice. */
typedef struct {
  int *start, *near, *seen; /* seen: the last vertex whose patch took this one */
} Graph;

/* The vertices around one, itself first. */
typedef struct {
  int n, ring_start; /* the last ring is vertex[ring_start .. n - 1] */
  int vertex[MAX_PATCH];
} Patch;

static PetscErrorCode GraphCreate(const MeshSerial *mesh, Graph *g)
{
  PetscFunctionBeginUser;
  PetscCall(PetscCalloc3(mesh->nv + 2, &g->start, 6 * mesh->ne, &g->near, mesh->nv, &g->seen));
  for (int k = 0; k < 3 * mesh->ne; k++) g->start[mesh->vertex[k] + 2] += 2;
  for (int v = 0; v <= mesh->nv; v++) g->start[v + 1] += g->start[v];
  for (int k = 0; k < 3 * mesh->ne; k++) {
    const int v = mesh->vertex[k];
    g->near[g->start[v + 1]++] = mesh->vertex[k - k % 3 + (k + 1) % 3];
    g->near[g->start[v + 1]++] = mesh->vertex[k - k % 3 + (k + 2) % 3];
  }
  for (int v = 0; v < mesh->nv; v++) g->seen[v] = -1;
  PetscFunctionReturn(0);
}

/* Adds the vertices around the last ring; 0 if there were none, or no more room. */
static int AddRing(Graph *g, Patch *p)
{
  const int before = p->n, center = p->vertex[0];
  for (int i = p->ring_start; i < before; i++) {
    const int v = p->vertex[i];
    for (int k = g->start[v]; k < g->start[v + 1]; k++) {
      const int w = g->near[k];
      if (g->seen[w] == center || p->n == MAX_PATCH) continue;
      g->seen[w] = center;
      p->vertex[p->n++] = w;
    }
  }
  p->ring_start = before;
  return p->n > before;
}

/* B with B C B^T = I for the covariance C of the patch: in y = B (x - x0) the patch is round and about 1
 * wide, however stretched the triangles are.  0 if the patch is a line. */
static int Normalise(const double x[], const Patch *p, double b[3])
{
  const double *o = &x[2 * p->vertex[0]];
  double c[3] = {0.0, 0.0, 0.0};
  for (int i = 1; i < p->n; i++) {
    const double dx = x[2 * p->vertex[i]] - o[0], dy = x[2 * p->vertex[i] + 1] - o[1];
    c[0] += dx * dx / p->n;
    c[1] += dx * dy / p->n;
    c[2] += dy * dy / p->n;
  }
  if (!(c[0] > 0.0)) return 0;
  const double l = sqrt(c[0]), m = c[1] / l, rest = c[2] - m * m;
  if (!(rest > 1e-14 * c[2])) return 0;
  b[0] = 1.0 / l; /* B is the inverse of the Cholesky factor, lower triangular: b0; b1 b2 */
  b[2] = 1.0 / sqrt(rest);
  b[1] = -m / l * b[2];
  return 1;
}

/* Monomials up to degree 3; the second-order ones are halved so that coefficients 3 to 5 are derivatives. */
static void Basis(double x, double y, double f[CUBIC])
{
  const double value[CUBIC] = {1.0,         x,         y,         0.5 * x * x, x * y,
                               0.5 * y * y, x * x * x, x * x * y, x * y * y,   y * y * y};
  memcpy(f, value, sizeof value);
}

/* Solves the n x n normal equations by Cholesky for nr right-hand sides; 0 if they are close to singular. */
static int Solve(int n, double a[CUBIC][CUBIC], int nr, double r[MAX_FIELDS][CUBIC])
{
  for (int j = 0; j < n; j++) {
    const double before = a[j][j];
    for (int k = 0; k < j; k++) a[j][j] -= a[j][k] * a[j][k];
    if (!(a[j][j] > 1e-9 * before)) return 0;
    a[j][j] = sqrt(a[j][j]);
    for (int i = j + 1; i < n; i++) {
      for (int k = 0; k < j; k++) a[i][j] -= a[i][k] * a[j][k];
      a[i][j] /= a[j][j];
    }
  }
  for (int f = 0; f < nr; f++) {
    for (int j = 0; j < n; j++) {
      for (int k = 0; k < j; k++) r[f][j] -= a[j][k] * r[f][k];
      r[f][j] /= a[j][j];
    }
    for (int j = n - 1; j >= 0; j--) {
      for (int k = j + 1; k < n; k++) r[f][j] -= a[k][j] * r[f][k];
      r[f][j] /= a[j][j];
    }
  }
  return 1;
}

/* Least squares with n monomials, near vertices weighing more; H = B^T H_y B for vertex p->vertex[0]. */
static int Fit(const double x[], int nfields, const double *const field[], const Patch *p, int n,
               double *const hessian[])
{
  const int center = p->vertex[0];
  double b[3], a[CUBIC][CUBIC] = {{0.0}}, r[MAX_FIELDS][CUBIC] = {{0.0}};
  if (p->n < n || !Normalise(x, p, b)) return 0;
  for (int i = 0; i < p->n; i++) {
    const int v = p->vertex[i];
    const double dx = x[2 * v] - x[2 * center], dy = x[2 * v + 1] - x[2 * center + 1];
    const double y0 = b[0] * dx, y1 = b[1] * dx + b[2] * dy, weight = 1.0 / (0.5 + y0 * y0 + y1 * y1);
    double basis[CUBIC];
    Basis(y0, y1, basis);
    for (int j = 0; j < n; j++) {
      for (int f = 0; f < nfields; f++) r[f][j] += weight * basis[j] * (field[f][v] - field[f][center]);
      for (int k = 0; k <= j; k++) a[j][k] += weight * basis[j] * basis[k];
    }
  }
  if (!Solve(n, a, nfields, r)) return 0;
  for (int f = 0; f < nfields; f++) {
    double *h = hessian[f] + 3 * center;
    h[0] = b[0] * b[0] * r[f][3] + 2.0 * b[0] * b[1] * r[f][4] + b[1] * b[1] * r[f][5];
    h[1] = b[2] * (b[0] * r[f][4] + b[1] * r[f][5]);
    h[2] = b[2] * b[2] * r[f][5];
  }
  return 1;
}

PetscErrorCode HessianRecover(const MeshSerial *mesh, int nfields, const double *const field[],
                              double *const hessian[])
{
  Graph g;
  PetscFunctionBeginUser;
  PetscCheck(nfields <= HESSIAN_FIELDS, PETSC_COMM_SELF, PETSC_ERR_ARG_OUTOFRANGE, "%d fields, at most %d",
             nfields, HESSIAN_FIELDS);
  PetscCall(GraphCreate(mesh, &g));
  for (int f = 0; f < nfields; f++) PetscCall(PetscArrayzero(hessian[f], 3 * mesh->nv));
  for (int v = 0; v < mesh->nv; v++) {
    Patch p = {1, 0, {v}};
    int ring = 0, done = 0, more = 1;
    g.seen[v] = v;
    while (!done && more && ring < MAX_RINGS) {
      more = AddRing(&g, &p);
      if (++ring >= 2 && p.n >= CUBIC + 4) done = Fit(mesh->x, nfields, field, &p, CUBIC, hessian);
    }
    if (!done) Fit(mesh->x, nfields, field, &p, QUADRATIC, hessian);
  }
  PetscCall(PetscFree3(g.start, g.near, g.seen));
  PetscFunctionReturn(0);
}
