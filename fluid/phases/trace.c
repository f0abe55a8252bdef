#include "fluid/phases/trace.h"
#include <math.h>

#define TRACE_CORNER 1e-9 /* sine of the angle between two walls that count as one line */

/* What walls leave of the motion of a vertex: 0 free, 1 along the direction, 2 nothing. */
static int Walls(const TraceFlow *w, int v, double along[2])
{
  const Stars *s = w->stars;
  int n = 0;
  for (int k = s->start[v]; k < s->start[v + 1]; k++) {
    const int e = s->around[k] / 3, c = s->around[k] % 3;
    for (int i = 1; i < 3; i++) {
      const int face = (c + i) % 3;
      if (s->element[e].tag[face] < 0 || w->flux[e][face] != 0.0) continue;
      const double *a = s->element[e].x[(face + 1) % 3], *b = s->element[e].x[(face + 2) % 3];
      const double l = hypot(b[0] - a[0], b[1] - a[1]), t[2] = {(b[0] - a[0]) / l, (b[1] - a[1]) / l};
      if (n && fabs(t[0] * along[1] - t[1] * along[0]) > TRACE_CORNER) return 2;
      if (!n) along[0] = t[0], along[1] = t[1];
      n = 1;
    }
  }
  return n;
}

static void Constrain(int walls, const double along[2], double u[2])
{
  const double t = u[0] * along[0] + u[1] * along[1];
  for (int c = 0; c < 2; c++) u[c] = walls == 0 ? u[c] : walls == 1 ? t * along[c] : 0.0;
}

/* The velocity at point x + shift: from the element around v in which the smallest barycentric coordinate is
 * largest. */
static void Interpolate(const TraceFlow *w, int v, const double shift[2], double u[2])
{
  const Stars *s = w->stars;
  double best = -HUGE_VAL;
  for (int k = s->start[v]; k < s->start[v + 1]; k++) {
    const int e = s->around[k] / 3, c = s->around[k] % 3, p = (c + 1) % 3, q = (c + 2) % 3;
    const double(*x)[2] = (const double(*)[2])s->element[e].x;
    const double a[2] = {x[p][0] - x[c][0], x[p][1] - x[c][1]}, b[2] = {x[q][0] - x[c][0], x[q][1] - x[c][1]};
    const double det = a[0] * b[1] - a[1] * b[0];
    const double lp = (shift[0] * b[1] - shift[1] * b[0]) / det;
    const double lq = (a[0] * shift[1] - a[1] * shift[0]) / det;
    const double low = fmin(fmin(lp, lq), 1.0 - lp - lq);
    if (low <= best) continue;
    best = low;
    for (int d = 0; d < 2; d++)
      u[d] = (1.0 - lp - lq) * w->velocity[e][c][d] + lp * w->velocity[e][p][d] + lq * w->velocity[e][q][d];
  }
}

void TraceVertex(const TraceFlow *w, int v, double shift[2])
{
  const int first = w->stars->around[w->stars->start[v]];
  double along[2] = {0.0, 0.0},
         u[2] = {w->velocity[first / 3][first % 3][0], w->velocity[first / 3][first % 3][1]};
  const int walls = Walls(w, v, along);
  Constrain(walls, along, u);
  const double half[2] = {-0.5 * w->dt * u[0], -0.5 * w->dt * u[1]};
  Interpolate(w, v, half, u);
  Constrain(walls, along, u);
  for (int c = 0; c < 2; c++) shift[c] = -w->dt * u[c];
}
