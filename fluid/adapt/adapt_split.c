#include "fluid/adapt/adapt_impl.h"

/* The longest face of triangle e, of equal ones the first. */
static int Longest(const Adapt *a, int e, double *length)
{
  int best = 3 * e;
  *length = 0.0;
  for (int c = 3 * e; c < 3 * e + 3; c++) {
    const double l = AdaptLength(a, a->vertex[Next(c)], a->vertex[Prev(c)]);
    if (l > (1.0 + TIE) * *length) *length = l, best = c;
  }
  return best;
}

/* Both halves of the triangle at corner c stay well oriented. */
static bool HalvesAreValid(const Adapt *a, int c, int m)
{
  double square;
  const int p = a->vertex[c], q = a->vertex[Next(c)], r = a->vertex[Prev(c)];
  return AdaptQuality(a, p, q, m, &square) > 0.0 && AdaptQuality(a, p, m, r, &square) > 0.0;
}

/* Makes (p, q, r) at corner c into (p, q, m) in place and (p, m, r); returns the new triangle.  Their faces
 * on qr are left to be joined. */
static int Halve(Adapt *a, int c, int m)
{
  const int e = c / 3, n = AdaptNewTriangle(a);
  const int p = a->vertex[c], q = a->vertex[Next(c)], r = a->vertex[Prev(c)];
  const int pq = a->across[Prev(c)], rp = a->across[Next(c)];
  const int mark_pq = a->mark[Prev(c)], mark_rp = a->mark[Next(c)];
  AdaptSetTriangle(a, e, p, q, m);
  AdaptSetTriangle(a, n, p, m, r);
  a->region[n] = a->region[e];
  AdaptJoin(a, 3 * e + 2, pq, mark_pq);
  AdaptJoin(a, 3 * n + 1, rp, mark_rp);
  AdaptJoin(a, 3 * e + 1, 3 * n + 2, NONE);
  return n;
}

/* A vertex in the middle of the face at corner c; NONE if a triangle would become flat. */
static int Midpoint(Adapt *a, int c)
{
  const int p = a->vertex[Next(c)], q = a->vertex[Prev(c)], m = AdaptNewVertex(a);
  for (int k = 0; k < 2; k++) a->x[2 * m + k] = a->x[2 * p + k] + 0.5 * (a->x[2 * q + k] - a->x[2 * p + k]);
  int home = a->home[p];
  BackgroundMetric(&a->background, &a->x[2 * m], &home, &a->metric[3 * m]);
  a->origin[m] = NONE;
  a->kind[m] = a->mark[c] == NONE ? FREE : ON_LINE;
  const int o = a->across[c];
  if (HalvesAreValid(a, c, m) && (o == NONE || HalvesAreValid(a, o, m))) {
    a->home[m] = home;
    return m;
  }
  AdaptKillVertex(a, m);
  return NONE;
}

static bool SplitFace(Adapt *a, int c)
{
  const int o = a->across[c], mark = a->mark[c], m = Midpoint(a, c);
  if (m == NONE) return false;
  const int e = c / 3, n = Halve(a, c, m); /* (p, a, m) and (p, m, b) */
  if (o == NONE) {
    AdaptJoin(a, 3 * e, NONE, mark);
    AdaptJoin(a, 3 * n, NONE, mark);
  } else {
    const int f = o / 3, k = Halve(a, o, m); /* (q, b, m) and (q, m, a) */
    AdaptJoin(a, 3 * e, 3 * k, mark);
    AdaptJoin(a, 3 * n, 3 * f, mark);
  }
  return true;
}

PetscErrorCode AdaptSplit(Adapt *a, int since, int *done)
{
  const int ne = a->ne; /* what is new waits for the next sweep */
  PetscFunctionBeginUser;
  a->tick++;
  *done = 0;
  for (int e = 0; e < ne; e++) {
    const int *v = &a->vertex[3 * e];
    double length, beyond;
    if (v[0] == NONE || a->stamp[v[0]] < since || a->stamp[v[1]] < since || a->stamp[v[2]] < since) continue;
    if (!AdaptIsLong(a, v[0], v[1]) && !AdaptIsLong(a, v[1], v[2]) && !AdaptIsLong(a, v[2], v[0])) continue;
    const int c = Longest(a, e, &length), o = a->across[c];
    if (length <= LONG_EDGE || (a->mark[c] != NONE && a->frozen_mark[a->mark[c]])) continue;
    /* a triangle is cut across its longest face only: no angle gets small (Rivara, 1984) */
    if (o != NONE && Longest(a, o / 3, &beyond) != o && beyond > (1.0 + TIE) * length) continue;
    PetscCall(AdaptReserve(a));
    *done += SplitFace(a, c);
  }
  a->report.splits += *done;
  PetscFunctionReturn(0);
}
