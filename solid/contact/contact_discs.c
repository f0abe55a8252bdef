/* Contact of rigid discs, as circles: their sectors, and what touches. */
#include "solid/contact/circle_kernel.h"
#include "solid/contact/contact_impl.h"

/* --- what never changes ------------------------------------------------------------------------------- */

/* Distance of the rest centre from a facet's line, which its foot is on. */
static double FacetDistance(const Solid s, int facet, Point centre)
{
  const Point p = PointAt(s->rest, s->facet[2 * facet]), q = PointAt(s->rest, s->facet[2 * facet + 1]),
              d = PointMinus(q, p);
  return PointCross(d, PointMinus(centre, p)) / hypot(d.x, d.y);
}

PetscErrorCode DiscsMeasure(Contact c, const Solid s)
{
  PetscFunctionBeginUser;
  PetscCall(PetscArrayzero(c->bulge, (size_t)s->nbodies));
  for (int k = 0; k < s->nfaces; k++) {
    Target *t = &c->target[c->facet_target[k]];
    if (!ContactIsDisc(s, t->body)) continue;
    const Body *body = &s->body[t->body];
    const Point centre = PointAt(body->centre, 0),
                rest[3] = {PointAt(t->rest, 0), PointAt(t->rest, 1), PointAt(t->rest, 2)};
    t->sector = s->facet_side[k];
    ContactCoordinates(rest, 1.0 / t->twice_area, centre, t->at_centre);
    c->bulge[t->body] = fmax(c->bulge[t->body], body->circle - FacetDistance(s, k, centre));
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, c->bulge, s->nbodies, MPI_DOUBLE, MPI_MAX, s->comm));
  PetscFunctionReturn(0);
}

/* --- now ---------------------------------------------------------------------------------------------- */

static void Positions(const Contact c, const Solid s, const Target *t, Point x[3])
{
  for (int i = 0; i < 3; i++) x[i] = ContactPosition(c, s, t->node[i]);
}

static Sector SectorOf(const Contact c, const Solid s, const Target *t, const Point x[3])
{
  const Point a = PointMinus(x[1], x[0]), b = PointMinus(x[2], x[0]);
  const double *at = t->at_centre;
  const Point centre = {x[0].x + at[1] * a.x + at[2] * b.x, x[0].y + at[1] * a.y + at[2] * b.y};
  return (Sector){centre, x[t->sector], x[(t->sector + 1) % 3], s->body[t->body].circle, c->height[t->body]};
}

/* Shares of the contactor's nodes of what acts at a point, exact for force and moment. */
static void WeightNodes(const Point x[3], int side, Point at, double integral, ContactIntegrals *k)
{
  double lambda[3];
  ContactCoordinates(x, 1.0 / ContactTwiceArea(x), at, lambda);
  k->edge[0] = integral * lambda[side];
  k->edge[1] = integral * lambda[(side + 1) % 3];
  k->opposite = integral * lambda[(side + 2) % 3];
}

/* The edge of another body, in a disc's sector. */
static int IntersectEdge(const Contact c, const Solid s, int facet, const Target *t, ActivePair *a)
{
  const int *edge = s->facet + 2 * facet;
  const Point p = PointAt(s->x, edge[0]), q = PointAt(s->x, edge[1]);
  ContactIntegrals *k = &a->integrals;
  double at_p[3], at_q[3];
  Point x[3];
  Positions(c, s, t, x);
  const Sector sector = SectorOf(c, s, t, x);
  if (!ContactEdgeSector(p, q, &sector, k)) return 0;
  k->twice_area = ContactTwiceArea(x);
  ContactCoordinates(x, 1.0 / k->twice_area, p, at_p);
  ContactCoordinates(x, 1.0 / k->twice_area, q, at_q);
  for (int i = 0; i < 3; i++) k->target[i] = at_p[i] * k->edge[0] + at_q[i] * k->edge[1];
  a->along = PointMinus(q, p);
  return 1;
}

/* A disc's edge stands for its part of the circle; the force acts as on an edge so long along the chord. */
static int IntersectCircles(const Contact c, const Solid s, int facet, const Target *own, const Target *t,
                            ActivePair *a)
{
  const double length = ContactRestLength(s, facet);
  ContactIntegrals *k = &a->integrals;
  double integral, lambda[3];
  Point x[3], y[3], at;
  Positions(c, s, own, x);
  Positions(c, s, t, y);
  const Sector one = SectorOf(c, s, own, x), other = SectorOf(c, s, t, y);
  const Point d = PointMinus(other.centre, one.centre);
  const double apart = one.radius + other.radius;
  if (PointSquared(d) >= apart * apart) return 0;
  const Chord chord = ChordOfDiscs(one.centre, one.radius, other.centre, other.radius);
  if (!ContactChord(&chord, &one, &other, other.height, length, &at, &integral, k)) return 0;
  WeightNodes(x, a->side, at, integral, k);
  k->twice_area = ContactTwiceArea(y);
  ContactCoordinates(y, 1.0 / k->twice_area, at, lambda);
  for (int i = 0; i < 3; i++) k->target[i] = integral * lambda[i];
  a->along = (Point){-length * chord.outward.y, length * chord.outward.x};
  return 1;
}

int DiscActive(const Contact c, const Solid s, const Candidate *candidate, int contactor, ActivePair *a)
{
  const Target *own = &c->target[contactor], *t = &c->target[candidate->target];
  const int active = own->sector >= 0 ? IntersectCircles(c, s, candidate->facet, own, t, a)
                                      : IntersectEdge(c, s, candidate->facet, t, a);
  if (active) a->scale = candidate->strength / a->integrals.twice_area;
  return active;
}

int DiscActiveAtWall(const Contact c, const Solid s, const WallCandidate *w, ActivePair *a)
{
  const Target *t = &c->target[c->facet_target[w->facet]];
  const int side = s->facet_side[w->facet];
  const double length = ContactRestLength(s, w->facet);
  const Point outward = w->axis ? (Point){0.0, w->outward} : (Point){w->outward, 0.0};
  double integral;
  Point x[3], at;
  Positions(c, s, t, x);
  const Sector sector = SectorOf(c, s, t, x);
  const Chord chord = ChordOfWall(
      sector.radius, w->outward * (w->at - (w->axis ? sector.centre.y : sector.centre.x)), outward);
  if (!ContactChord(&chord, &sector, NULL, sector.height, length, &at, &integral, &a->integrals)) return 0;
  WeightNodes(x, side, at, integral, &a->integrals);
  a->along = (Point){-length * outward.y, length * outward.x};
  return 1;
}
