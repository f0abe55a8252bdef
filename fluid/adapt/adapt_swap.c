#include "fluid/adapt/adapt_impl.h"

/* By how much a swap must raise the worse quality of the two: keeps ties from swapping for ever. */
#define GAIN 1.01

/* Two triangles (p, a, b) and (q, b, a) at corners c and o become (p, a, q) and (q, b, p). */
static void Swap(Adapt *m, int c, int o)
{
  const int t = c / 3, s = o / 3;
  const int p = m->vertex[c], a = m->vertex[Next(c)], b = m->vertex[Prev(c)], q = m->vertex[o];
  const int bp = m->across[Next(c)], pa = m->across[Prev(c)], aq = m->across[Next(o)],
            qb = m->across[Prev(o)];
  const int mark_bp = m->mark[Next(c)], mark_pa = m->mark[Prev(c)];
  const int mark_aq = m->mark[Next(o)], mark_qb = m->mark[Prev(o)];
  AdaptSetTriangle(m, t, p, a, q);
  AdaptSetTriangle(m, s, q, b, p);
  AdaptJoin(m, 3 * t, aq, mark_aq);
  AdaptJoin(m, 3 * t + 1, 3 * s + 1, NONE);
  AdaptJoin(m, 3 * t + 2, pa, mark_pa);
  AdaptJoin(m, 3 * s, bp, mark_bp);
  AdaptJoin(m, 3 * s + 2, qb, mark_qb);
}

static bool IsBetter(const Adapt *m, int c, int o)
{
  const int p = m->vertex[c], a = m->vertex[Next(c)], b = m->vertex[Prev(c)], q = m->vertex[o];
  double square;
  const double one = AdaptQuality(m, p, a, b, &square), other = AdaptQuality(m, q, b, a, &square);
  const double before = PetscMin(one, other);
  const double first = AdaptQuality(m, p, a, q, &square);
  if (first <= GAIN * before || first <= 0.0) return false;
  return AdaptQuality(m, q, b, p, &square) > GAIN * before;
}

int AdaptSwap(Adapt *a, int since)
{
  int done = 0;
  a->tick++;
  for (int c = 0; c < 3 * a->ne; c++) {
    if (a->vertex[c - c % 3] == NONE) {
      c += 2 - c % 3;
      continue;
    }
    const int o = a->across[c];
    /* an edge is looked at from its first side only, as is one that changes meanwhile; NONE is below all */
    if (c > o || a->mark[c] != NONE) continue;
    if (a->stamp[a->vertex[Next(c)]] < since || a->stamp[a->vertex[Prev(c)]] < since) continue;
    if (!IsBetter(a, c, o)) continue;
    Swap(a, c, o);
    done++;
  }
  a->report.swaps += done;
  return done;
}
