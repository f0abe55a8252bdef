#include "fluid/adapt/adapt_impl.h"

/* A move must raise the worst score around the vertex by so much; stars that are this good are left alone. */
#define GAIN 1.01
#define GOOD 0.9

/* Shape and size of a triangle: q (f (2 - f))^3 with f = min(s, 1/s) of its mean edge s, after Vasilevskii
 * and Lipnikov (Comput. Math. Math. Phys. 39, 1999); 1 for an equilateral one of unit edges. */
static double Score(const Adapt *a, int p, int q, int r)
{
  double square;
  const double quality = AdaptQuality(a, p, q, r, &square);
  if (quality <= 0.0) return -1.0;
  const double s = sqrt(square), f = PetscMin(s, 1.0 / s), g = f * (2.0 - f);
  return quality * g * g * g;
}

static double WorstScore(const Adapt *a, const Star *star, int v, double bound)
{
  double worst = INFINITY;
  for (int i = 0; i < star->n && worst > bound; i++) {
    const int c = star->corner[i];
    const double score = Score(a, v, a->vertex[Next(c)], a->vertex[Prev(c)]);
    worst = PetscMin(worst, score);
  }
  return worst;
}

/* Mean of the points at unit distance from each neighbour towards v. */
static void Target(const Adapt *a, const Star *star, int v, double target[2])
{
  const int n = star->n + !star->closed;
  target[0] = target[1] = 0.0;
  for (int i = 0; i < n; i++) {
    const int u = i < star->n ? a->vertex[Next(star->corner[i])] : a->vertex[Prev(star->corner[i - 1])];
    const double stretch = 1.0 / AdaptLength(a, u, v);
    for (int k = 0; k < 2; k++)
      target[k] += (a->x[2 * u + k] + stretch * (a->x[2 * v + k] - a->x[2 * u + k])) / n;
  }
}

/* The two neighbours of v along its line. */
static bool LineEnds(const Adapt *a, const Star *star, int end[2])
{
  int n = 0;
  for (int i = 0; i < star->n; i++) {
    const int c = star->corner[i];
    if (a->mark[Prev(c)] != NONE && n < 2) end[n++] = a->vertex[Next(c)];
    if (!star->closed && i == star->n - 1 && a->mark[Next(c)] != NONE && n < 2) end[n++] = a->vertex[Prev(c)];
  }
  return n == 2;
}

/* Brings a point onto the segment between the ends, away from both. */
static void Project(const Adapt *a, const int end[2], double x[2])
{
  const double *p = &a->x[2 * end[0]], *q = &a->x[2 * end[1]];
  const double dx = q[0] - p[0], dy = q[1] - p[1];
  double t = ((x[0] - p[0]) * dx + (x[1] - p[1]) * dy) / (dx * dx + dy * dy);
  t = PetscMin(PetscMax(t, 0.05), 0.95);
  x[0] = p[0] + t * dx;
  x[1] = p[1] + t * dy;
}

static bool Move(Adapt *a, int v)
{
  Star star;
  int end[2] = {NONE, NONE};
  double target[2];
  if (!AdaptStar(a, v, &star)) return false;
  const double before = WorstScore(a, &star, v, -1.0);
  if (before > GOOD) return false;
  if (a->kind[v] == ON_LINE && !LineEnds(a, &star, end)) return false;
  Target(a, &star, v, target);
  double *x = &a->x[2 * v], *m = &a->metric[3 * v];
  const double x0[2] = {x[0], x[1]}, m0[3] = {m[0], m[1], m[2]};
  double step = 1.0;
  for (int trial = 0; trial < 2; trial++, step *= 0.5) {
    int home = a->home[v];
    for (int k = 0; k < 2; k++) x[k] = x0[k] + step * (target[k] - x0[k]);
    if (a->kind[v] == ON_LINE) Project(a, end, x);
    BackgroundMetric(&a->background, x, &home, m);
    if (WorstScore(a, &star, v, GAIN * before) > GAIN * before) {
      a->home[v] = home;
      a->origin[v] = NONE;
      return true;
    }
  }
  for (int k = 0; k < 2; k++) x[k] = x0[k];
  for (int k = 0; k < 3; k++) m[k] = m0[k];
  return false;
}

int AdaptSmooth(Adapt *a, int since)
{
  int done = 0;
  a->tick++;
  for (int v = 0; v < a->nv; v++) {
    if (a->corner[v] == NONE || a->kind[v] == FIXED || a->stamp[v] < since || !Move(a, v)) continue;
    Star star;
    AdaptStar(a, v, &star);
    a->stamp[v] = a->tick;
    for (int i = 0; i < star.n; i++) {
      a->stamp[a->vertex[Next(star.corner[i])]] = a->stamp[a->vertex[Prev(star.corner[i])]] = a->tick;
    }
    done++;
  }
  a->report.moves += done;
  return done;
}
