#include "fluid/adapt/adapt_impl.h"

/* What a collapse may leave behind: this quality, or the one that was there. */
#define QUALITY_KEPT 0.35

typedef struct {
  int target;     /* NONE: no neighbour will do */
  double quality; /* worst of the new triangles */
} Choice;

/* Worst quality around v. */
static double WorstOf(const Adapt *a, const Star *star, int v)
{
  double worst = INFINITY, square;
  for (int i = 0; i < star->n; i++) {
    const int c = star->corner[i];
    const double quality = AdaptQuality(a, v, a->vertex[Next(c)], a->vertex[Prev(c)], &square);
    worst = PetscMin(worst, quality);
  }
  return worst;
}

/* Worst quality if v goes to u; negative if it is not above the bound or an edge would be too long. */
static double Try(const Adapt *a, const Star *star, int u, double bound)
{
  double worst = INFINITY, square;
  for (int i = 0; i < star->n; i++) {
    const int c = star->corner[i], p = a->vertex[Next(c)], q = a->vertex[Prev(c)];
    if (p == u || q == u) {
      /* the face that closes up must be free: only at a bend that passes for straight is it not */
      if (a->mark[p == u ? Next(c) : Prev(c)] != NONE) return -1.0;
      continue;
    }
    const double quality = AdaptQuality(a, u, p, q, &square);
    worst = PetscMin(worst, quality);
    if (worst <= bound || AdaptIsLong(a, u, p) || AdaptIsLong(a, u, q)) return -1.0;
  }
  return worst;
}

/* `mark` is that of the edge from v to u.  A vertex of a line follows its line; others go anywhere. */
static void Consider(const Adapt *a, const Star *star, int v, int u, int mark, double bound, Choice *best)
{
  if (a->kind[v] == ON_LINE && mark == NONE) return;
  if (!AdaptIsShort(a, v, u)) return;
  /* as good as before is allowed; of equal ones the first is taken */
  const double quality = Try(a, star, u, PetscMax((1.0 - TIE) * bound, (1.0 + TIE) * best->quality));
  if (quality > 0.0) *best = (Choice){u, quality};
}

/* Takes out triangle e = (v at corner c, p, q) with u = p or q: its other two faces become one. */
static void Zip(Adapt *a, int c, int u)
{
  const int gone =
      a->vertex[Next(c)] == u ? Next(c) : Prev(c); /* looks at the face from v to the third vertex */
  const int inner = a->across[gone], outer = a->across[c], mark = a->mark[c];
  AdaptJoin(a, inner, outer, mark);
  a->corner[a->vertex[Next(inner)]] = Next(inner);
  a->corner[a->vertex[Prev(inner)]] = Prev(inner);
  AdaptKillTriangle(a, c / 3);
}

static void Apply(Adapt *a, const Star *star, int v, int u)
{
  for (int i = 0; i < star->n; i++) {
    const int c = star->corner[i];
    a->vertex[c] = u;
    a->corner[u] = c;
  }
  for (int i = 0; i < star->n; i++) {
    const int c = star->corner[i];
    a->stamp[a->vertex[Next(c)]] = a->stamp[a->vertex[Prev(c)]] = a->tick;
    if (a->vertex[Next(c)] == u || a->vertex[Prev(c)] == u) Zip(a, c, u);
  }
  AdaptKillVertex(a, v);
}

static bool CollapseVertex(Adapt *a, int v)
{
  Star star;
  Choice best = {NONE, 0.0};
  if (!AdaptStar(a, v, &star)) return false;
  bool needed = false;
  for (int i = 0; i < star.n && !needed; i++) {
    const int c = star.corner[i];
    needed =
        AdaptIsShort(a, v, a->vertex[Next(c)]) || (!star.closed && AdaptIsShort(a, v, a->vertex[Prev(c)]));
  }
  if (!needed) return false;
  const double worst = WorstOf(a, &star, v), bound = PetscMin(QUALITY_KEPT, worst);
  for (int i = 0; i < star.n; i++) {
    const int c = star.corner[i];
    Consider(a, &star, v, a->vertex[Next(c)], a->mark[Prev(c)], bound, &best);
    if (!star.closed && i == star.n - 1)
      Consider(a, &star, v, a->vertex[Prev(c)], a->mark[Next(c)], bound, &best);
  }
  if (best.target == NONE) return false;
  Apply(a, &star, v, best.target);
  return true;
}

int AdaptCollapse(Adapt *a, int since)
{
  int done = 0;
  a->tick++;
  for (int v = 0; v < a->nv; v++) {
    if (a->corner[v] == NONE || a->kind[v] == FIXED || a->stamp[v] < since) continue;
    done += CollapseVertex(a, v);
  }
  a->report.collapses += done;
  return done;
}
