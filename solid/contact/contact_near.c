/* Which edge may touch which target before the next search. */
#include "solid/contact/contact_impl.h"

/* Neighbours on the mesh of one body that lie this close at rest become candidates when they have come closer
 * by half: till then they cost nothing. */
#define APPROACH 0.5

/* Squared distance from a to the segment p q. */
static double PointSegment(Point a, Point p, Point q)
{
  const Point d = PointMinus(q, p), r = PointMinus(a, p);
  const double s = fmax(0.0, fmin(1.0, (r.x * d.x + r.y * d.y) / (d.x * d.x + d.y * d.y)));
  const double x = r.x - s * d.x, y = r.y - s * d.y;
  return x * x + y * y;
}

static double Distance(Point p, Point q, const Point t[3])
{
  double least = HUGE_VAL;
  if (ContactTouches(p, q, t)) return 0.0;
  for (int i = 0; i < 3; i++) {
    const Point a = t[i], b = t[(i + 1) % 3];
    least = fmin(least, fmin(PointSegment(p, a, b), PointSegment(q, a, b)));
    least = fmin(least, PointSegment(a, p, q));
  }
  return sqrt(least);
}

/* They were one point at rest: the facet's end and the target's node that are least apart now, squared; HUGE_VAL: none. */
static double Parted(const Solid s, const int *edge, const Target *t, const Point now[3])
{
  double least = HUGE_VAL;
  for (int i = 0; i < 6; i++) {
    const double *rest = s->rest + 2 * edge[i / 3];
    if (t->rest[2 * (i % 3)] != rest[0] || t->rest[2 * (i % 3) + 1] != rest[1]) continue;
    const Point d = PointMinus(PointAt(s->x, edge[i / 3]), now[i % 3]);
    least = fmin(least, d.x * d.x + d.y * d.y);
  }
  return least;
}

PetscBool ContactMayBeActive(const Contact c, const Solid s, int facet, const Target *t, double *distance)
{
  const int *edge = s->facet + 2 * facet, body = s->elements.body[s->facet_element[facet]];
  Point now[3], rest[3];
  if (t->body == body && !ContactJoined(s, facet, t))
    for (int i = 0; i < 6; i++)
      if (t->gid[i % 3] == s->gid[edge[i / 3]]) return PETSC_FALSE;
  for (int i = 0; i < 3; i++) {
    now[i] = ContactPosition(c, s, t->node[i]);
    rest[i] = PointAt(t->rest, i);
  }
  *distance = 0.0;
  if (t->body == body && Parted(s, edge, t, now) <= c->shortest_buffer * c->shortest_buffer)
    return PETSC_TRUE;
  *distance = Distance(PointAt(s->x, edge[0]), PointAt(s->x, edge[1]), now);
  *distance = fmax(0.0, *distance - c->bulge[body] - c->bulge[t->body]);
  if (t->body != body) return (PetscBool)(*distance <= c->skin[body] + c->skin[t->body]);
  if (*distance <= c->shortest_buffer) {
    const double apart = Distance(PointAt(s->rest, edge[0]), PointAt(s->rest, edge[1]), rest);
    if (apart == 0.0 || apart > c->shortest_buffer || *distance < APPROACH * apart) return PETSC_TRUE;
  }
  c->waiting[body] = fmin(c->waiting[body], *distance);
  return PETSC_FALSE;
}
