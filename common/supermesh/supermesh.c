#include "common/supermesh/supermesh.h"
#include <stdlib.h>

static const double SLIVER = 1e-14;

/* On a fan triangle of area w with the values f, g of two P1 functions at its vertices,
 *   int f g = w/12 (sum_k f_k g_k + sum_k f_k sum_k g_k):  exact.
 * z holds N_A (3) and N_B (3) at the polygon's vertices; m = int z z^T. */
static void IntegrateFan(int n, const double polygon[][2], const double z[][6], double m[6][6])
{
  memset(m, 0, 36 * sizeof(double));
  for (int k = 1; k + 1 < n; k++) {
    const double w = GeometryTurn(polygon[0], polygon[k], polygon[k + 1]) / 24.0;
    double s[6];
    for (int i = 0; i < 6; i++) s[i] = z[0][i] + z[k][i] + z[k + 1][i];
    for (int i = 0; i < 6; i++) {
      for (int j = 0; j < 6; j++) {
        m[i][j] += w * (z[0][i] * z[0][j] + z[k][i] * z[k][j] + z[k + 1][i] * z[k + 1][j] + s[i] * s[j]);
      }
    }
  }
}

/* The common polygon and the functions N_A (3) and N_B (3) at its vertices; 0 when there is next to none. */
static int Common(const double a[3][2], const double b[3][2], double polygon[GEOMETRY_CLIP_MAX][2],
                  double z[GEOMETRY_CLIP_MAX][6], double *area)
{
  const double area_a = GeometryArea(a), area_b = GeometryArea(b);
  if (!(area_a > 0.0 && area_b > 0.0)) return 0;
  const int n = GeometryClip(a, b, polygon);
  *area = GeometryPolygonArea(n, (const double(*)[2])polygon);
  if (*area <= SLIVER * fmin(area_a, area_b)) return 0;
  for (int k = 0; k < n; k++) {
    GeometryBarycentric(a, polygon[k], &z[k][0]);
    GeometryBarycentric(b, polygon[k], &z[k][3]);
  }
  return n;
}

int SupermeshIntegrate(const double a[3][2], const double b[3][2], SupermeshPair *pair)
{
  double polygon[GEOMETRY_CLIP_MAX][2], z[GEOMETRY_CLIP_MAX][6], m[6][6];
  const int n = Common(a, b, polygon, z, &pair->area);
  if (!n) return 0;
  IntegrateFan(n, (const double(*)[2])polygon, (const double(*)[6])z, m);
  for (int i = 0; i < 3; i++) {
    for (int j = 0; j < 3; j++) {
      pair->aa[i][j] = m[i][j];
      pair->ab[i][j] = m[i][3 + j];
      pair->bb[i][j] = m[3 + i][3 + j];
    }
  }
  return 1;
}

int SupermeshMixed(const double a[3][2], const double b[3][2], double mixed[3][3])
{
  double polygon[GEOMETRY_CLIP_MAX][2], z[GEOMETRY_CLIP_MAX][6], area;
  const int n = Common(a, b, polygon, z, &area);
  if (!n) return 0;
  memset(mixed, 0, 9 * sizeof(double));
  for (int k = 1; k + 1 < n; k++) {
    const double w = GeometryTurn(polygon[0], polygon[k], polygon[k + 1]) / 24.0;
    double s[6];
    for (int i = 0; i < 6; i++) s[i] = z[0][i] + z[k][i] + z[k + 1][i];
    for (int i = 0; i < 3; i++) {
      for (int j = 0; j < 3; j++) {
        mixed[i][j] += w * (z[0][i] * z[0][3 + j] + z[k][i] * z[k][3 + j] + z[k + 1][i] * z[k + 1][3 + j] +
                            s[i] * s[3 + j]);
      }
    }
  }
  return n > 0;
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
