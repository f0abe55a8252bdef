#include "fluid/adapt/adapt_impl.h"

/* Twice the areas that x spans with the faces of triangle e; their sum is twice the triangle's. */
static void Areas(const MeshSerial *m, int e, const double x[2], double area[3])
{
  for (int i = 0; i < 3; i++) {
    const double *p = &m->x[2 * m->vertex[3 * e + (i + 1) % 3]];
    const double *q = &m->x[2 * m->vertex[3 * e + (i + 2) % 3]];
    area[i] = (p[0] - x[0]) * (q[1] - x[1]) - (p[1] - x[1]) * (q[0] - x[0]);
  }
}

/* Smallest barycentric coordinate; 0 or more inside. */
static double Inside(const double area[3])
{
  return PetscMin(PetscMin(area[0], area[1]), area[2]) / (area[0] + area[1] + area[2]);
}

/* Where no walk arrives (behind a hole): the triangle that contains x best. */
static int Exhaustive(const MeshSerial *m, const double x[2], double area[3])
{
  double best = -INFINITY;
  int home = 0;
  for (int e = 0; e < m->ne; e++) {
    Areas(m, e, x, area);
    if (Inside(area) > best) best = Inside(area), home = e;
    if (best >= 0.0) break;
  }
  Areas(m, home, x, area);
  return home;
}

/* Walks over the most negative face that has a neighbour (Devillers, Pion and Teillaud, 2002). */
static int Walk(const Background *b, const double x[2], int e, double area[3])
{
  const int most = 100 + 4 * (int)sqrt((double)b->mesh->ne);
  int from = NONE;
  for (int step = 0; step < most; step++) {
    int face = NONE;
    Areas(b->mesh, e, x, area);
    for (int i = 0; i < 3; i++) {
      const int o = b->across[3 * e + i];
      if (area[i] < 0.0 && o != NONE && o / 3 != from && (face == NONE || area[i] < area[face])) face = i;
    }
    /* on the boundary round-off may put x just outside */
    if (face == NONE && Inside(area) > -1e-6) return e;
    if (face == NONE) break;
    from = e;
    e = b->across[3 * e + face] / 3;
  }
  return Exhaustive(b->mesh, x, area);
}

void BackgroundMetric(const Background *b, const double x[2], int *home, double metric[3])
{
  double area[3], log_m[3] = {0.0, 0.0, 0.0}, sum = 0.0;
  *home = Walk(b, x, *home, area);
  for (int i = 0; i < 3; i++) sum += area[i] = PetscMax(area[i], 0.0);
  for (int i = 0; i < 3; i++) {
    const double *l = &b->log_metric[3 * b->mesh->vertex[3 * *home + i]];
    for (int k = 0; k < 3; k++) log_m[k] += area[i] / sum * l[k];
  }
  MetricExp(log_m, metric);
}
