#include "common/supermesh/supermesh.h"
#include <stdlib.h>

static const double SLIVER = 1e-14;

/* int over the polygon of 1, x, y times 1, x, y, with its first vertex as the origin; on a fan triangle of area w with
 * the values f, g of two linear functions at its vertices
 *   int f g = w/12 (sum_k f_k g_k + sum_k f_k sum_k g_k):  exact. */
static void Moments(int n, const double polygon[][2], double m[3][3])
{
  double sum[6] = {0.0};
  for (int k = 1; k + 1 < n; k++) {
    const double px = polygon[k][0] - polygon[0][0], py = polygon[k][1] - polygon[0][1];
    const double qx = polygon[k + 1][0] - polygon[0][0], qy = polygon[k + 1][1] - polygon[0][1];
    const double w = 0.5 * (px * qy - py * qx), sx = px + qx, sy = py + qy;
    sum[0] += w;
    sum[1] += w / 3.0 * sx;
    sum[2] += w / 3.0 * sy;
    sum[3] += w / 12.0 * (px * px + qx * qx + sx * sx);
    sum[4] += w / 12.0 * (px * py + qx * qy + sx * sy);
    sum[5] += w / 12.0 * (py * py + qy * qy + sy * sy);
  }
  m[0][0] = sum[0];
  m[0][1] = m[1][0] = sum[1];
  m[0][2] = m[2][0] = sum[2];
  m[1][1] = sum[3];
  m[1][2] = m[2][1] = sum[4];
  m[2][2] = sum[5];
}

/* A triangle's P1 functions: N_i = l[i][0] + l[i][1] x + l[i][2] y from the origin. */
static void Functions(const double x[3][2], double area, const double origin[2], double l[3][3])
{
  const double inverse = 0.5 / area;
  for (int i = 1; i < 3; i++) {
    const double *p = x[(i + 1) % 3], *q = x[(i + 2) % 3];
    l[i][0] = inverse * GeometryTurn(p, q, origin);
    l[i][1] = inverse * (p[1] - q[1]);
    l[i][2] = inverse * (q[0] - p[0]);
  }
  l[0][0] = 1.0 - l[1][0] - l[2][0];
  l[0][1] = -l[1][1] - l[2][1];
  l[0][2] = -l[1][2] - l[2][2];
}

static double Dot(const double a[3], const double b[3])
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* fm[i] = int N_i (1, x, y); the functions add to 1, here and below. */
static void FirstMoments(const double f[3][3], const double m[3][3], double fm[3][3])
{
  for (int k = 0; k < 3; k++) {
    fm[1][k] = Dot(f[1], m[k]);
    fm[2][k] = Dot(f[2], m[k]);
    fm[0][k] = m[0][k] - fm[1][k] - fm[2][k];
  }
}

/* int N_A,i N_B,j */
static void Mixed(const double am[3][3], const double b[3][3], double ab[3][3])
{
  for (int i = 0; i < 3; i++) {
    ab[i][1] = Dot(am[i], b[1]);
    ab[i][2] = Dot(am[i], b[2]);
    ab[i][0] = am[i][0] - ab[i][1] - ab[i][2];
  }
}

/* int N_i N_j */
static void Gram(const double fm[3][3], const double f[3][3], double g[3][3])
{
  g[1][1] = Dot(fm[1], f[1]);
  g[2][2] = Dot(fm[2], f[2]);
  g[1][2] = g[2][1] = Dot(fm[1], f[2]);
  for (int i = 1; i < 3; i++) g[0][i] = g[i][0] = fm[i][0] - g[i][1] - g[i][2];
  g[0][0] = fm[0][0] - g[0][1] - g[0][2];
}

/* What integrals over the common polygon are made of: its moments, and both triangles' functions. */
typedef struct {
  double area, m[3][3], a[3][3], b[3][3];
} Common;

/* 0 when there is next to nothing in common. */
static int FindCommon(const double a[3][2], const double b[3][2], Common *common)
{
  const double area_a = GeometryArea(a), area_b = GeometryArea(b);
  double polygon[GEOMETRY_CLIP_MAX][2];
  if (!(area_a > 0.0 && area_b > 0.0)) return 0;
  const int n = GeometryClip(a, b, polygon);
  if (!n) return 0;
  Moments(n, (const double(*)[2])polygon, common->m);
  common->area = common->m[0][0];
  if (common->area <= SLIVER * fmin(area_a, area_b)) return 0;
  Functions(a, area_a, polygon[0], common->a);
  Functions(b, area_b, polygon[0], common->b);
  return 1;
}

int SupermeshIntegrate(const double a[3][2], const double b[3][2], SupermeshPair *pair)
{
  Common k;
  double am[3][3], bm[3][3];
  if (!FindCommon(a, b, &k)) return 0;
  pair->area = k.area;
  FirstMoments((const double(*)[3])k.a, (const double(*)[3])k.m, am);
  FirstMoments((const double(*)[3])k.b, (const double(*)[3])k.m, bm);
  Gram((const double(*)[3])am, (const double(*)[3])k.a, pair->aa);
  Mixed((const double(*)[3])am, (const double(*)[3])k.b, pair->ab);
  Gram((const double(*)[3])bm, (const double(*)[3])k.b, pair->bb);
  return 1;
}

int SupermeshMixed(const double a[3][2], const double b[3][2], double mixed[3][3])
{
  Common k;
  double am[3][3];
  if (!FindCommon(a, b, &k)) return 0;
  FirstMoments((const double(*)[3])k.a, (const double(*)[3])k.m, am);
  Mixed((const double(*)[3])am, (const double(*)[3])k.b, mixed);
  return 1;
}

static int Reserve(SupermeshPairs *pairs, int n)
{
  if (n <= pairs->capacity) return 0;
  const int capacity = n + n / 2 + 64;
  SupermeshPair *pair = realloc(pairs->pair, (size_t)capacity * sizeof *pair);
  if (!pair) return 1;
  pairs->pair = pair;
  pairs->capacity = capacity;
  return 0;
}

int SupermeshIntersect(int na, const double a[][3][2], Search search, const double b[][3][2],
                       SupermeshPairs *pairs)
{
  pairs->n = 0;
  for (int i = 0; i < na; i++) {
    const GeometryBox box = GeometryBoxOf(a[i]);
    const int *hit, nhit = SearchQuery(search, &box, &hit);
    if (nhit < 0 || Reserve(pairs, pairs->n + nhit)) return 1;
    for (int h = 0; h < nhit; h++) {
      SupermeshPair *pair = &pairs->pair[pairs->n];
      if (!SupermeshIntegrate(a[i], b[hit[h]], pair)) continue;
      pair->a = i;
      pair->b = hit[h];
      pairs->n++;
    }
  }
  return 0;
}

void SupermeshPairsDestroy(SupermeshPairs *pairs)
{
  free(pairs->pair);
  *pairs = (SupermeshPairs){0};
}
