#include "common/supermesh/outline.h"
#include "common/supermesh/geometry.h"
#include <stdlib.h>

double OutlineArea(int n, const double x[][2])
{
  double area = 0.0;
  for (int k = 0; k < n; k++) area += 0.5 * GeometryTurn(x[0], x[k], x[(k + 1) % n]);
  return area;
}

/* Whether the closed segments a b and c d have a point in common. */
static int Meet(const double a[2], const double b[2], const double c[2], const double d[2])
{
  GeometryBox one = GeometryBoxEmpty(), other = GeometryBoxEmpty();
  GeometryBoxGrow(&one, a), GeometryBoxGrow(&one, b);
  GeometryBoxGrow(&other, c), GeometryBoxGrow(&other, d);
  return GeometryBoxOverlap(&one, &other) && GeometryTurn(a, b, c) * GeometryTurn(a, b, d) <= 0.0 &&
         GeometryTurn(c, d, a) * GeometryTurn(c, d, b) <= 0.0;
}

int OutlineMeets(int n, const double x[][2], int *i, int *j)
{
  for (*i = 0; *i < n; ++*i)
    for (*j = *i + 2; *j < n - (*i == 0); ++*j)
      if (Meet(x[*i], x[*i + 1], x[*j], x[(*j + 1) % n])) return 1;
  return 0;
}

static int Inside(const double a[2], const double b[2], const double c[2], const double p[2])
{
  return GeometryTurn(a, b, p) >= 0.0 && GeometryTurn(b, c, p) >= 0.0 && GeometryTurn(c, a, p) >= 0.0;
}

/* An ear: corner k of those left, in front of which no other corner lies. */
static int IsEar(int n, const int left[], const double x[][2], int k)
{
  const int a = left[(k + n - 1) % n], b = left[k], c = left[(k + 1) % n];
  if (GeometryTurn(x[a], x[b], x[c]) <= 0.0) return 0;
  for (int i = 0; i < n; i++) {
    const int v = left[i];
    if (v != a && v != b && v != c && Inside(x[a], x[b], x[c], x[v])) return 0;
  }
  return 1;
}

int OutlineTriangles(int n, const double x[][2], int triangle[][3])
{
  int *left = malloc((size_t)n * sizeof *left), count = 0;
  if (!left) return 0;
  const int turns = OutlineArea(n, x) > 0.0;
  for (int k = 0; k < n; k++) left[k] = turns ? k : n - 1 - k;
  while (n > 2) {
    int k = 0;
    while (k < n && !IsEar(n, left, x, k)) k++;
    if (k == n) break;
    triangle[count][0] = left[(k + n - 1) % n];
    triangle[count][1] = left[k];
    triangle[count++][2] = left[(k + 1) % n];
    for (n--; k < n; k++) left[k] = left[k + 1];
  }
  free(left);
  return count;
}
