/* Contact of rigid discs as circles, which roll without resistance: pointwise, no MPI, no PETSc.
 *
 * A disc's elements at the surface are sectors, each from the centre to the circle between the rays through its ends of the boundary.  The
 * potential of a sector is the disc's,
 *
 *     phi(x) = 3 (R^2 - |x - c|^2)/(2 R height),        3 depth/height near the surface,
 *
 * and a line that reaches into the disc is cut by the sectors' rays, so that their sum is the circle's whatever the disc has turned by.  Edges of other
 * bodies act on it as on a triangle (contact_kernel.h).  What a circle itself does to another circle or to a wall is the integral over the chord of both,
 * of half-length a, of
 *
 *     phi(s) = 3 (a^2 - s^2)/(2 R* height),     1/R* = 1/R_1 + 1/R_2 (1/R_1 at a wall),
 *
 * a function of the centres' distance alone: it has an energy. */
#ifndef SOLID_CONTACT_CIRCLE_KERNEL_H
#define SOLID_CONTACT_CIRCLE_KERNEL_H
#include "solid/contact/contact_kernel.h"

typedef struct {
  Point centre, start, end; /* on its rays, counter-clockwise by less than half a turn */
  double radius, height;
} Sector;

/* The points at + s along of a line; s from s0 to s1, nothing where s0 >= s1. */
typedef struct {
  Point at, along;
  double s0, s1;
} LinePart;

/* Its part where a + b s >= 0. */
static inline void LineClip(double a, double b, LinePart *l)
{
  if (b > 0.0) l->s0 = Greater(l->s0, -a / b);
  if (b < 0.0) l->s1 = Lesser(l->s1, -a / b);
  if (b == 0.0 && a < 0.0) l->s1 = l->s0;
}

static inline void LineClipSector(const Sector *k, LinePart *l)
{
  const Point start = PointMinus(k->start, k->centre), end = PointMinus(k->end, k->centre),
              at = PointMinus(l->at, k->centre);
  LineClip(PointCross(start, at), PointCross(start, l->along), l);
  LineClip(PointCross(at, end), PointCross(l->along, end), l);
}

static inline Point LinePoint(const LinePart *l, double s)
{
  return (Point){l->at.x + s * l->along.x, l->at.y + s * l->along.y};
}

/* int w ds and int w s ds of w = f0 + f1 s + f2 s^2 over the part. */
static inline void LineMoments(const LinePart *l, double f0, double f1, double f2, double moment[2])
{
  const double m = 0.5 * (l->s0 + l->s1), half = 0.5 * (l->s1 - l->s0), third = half * half / 3.0;
  const double at_m = f0 + m * (f1 + m * f2),
               slope = f1 + 2.0 * m * f2; /* about the middle: nothing cancels */
  moment[0] = 2.0 * half * (at_m + f2 * third);
  moment[1] = m * moment[0] + 2.0 * half * slope * third;
}

/* The edge p q of another body: shares of its ends; 0: outside.  `inside` and largest_phi as of ContactIntegrals. */
static inline int ContactEdgeSector(Point p, Point q, const Sector *k, ContactIntegrals *c)
{
  const Point d = PointMinus(q, p), r = PointMinus(p, k->centre);
  const double dd = d.x * d.x + d.y * d.y, nearest = -(r.x * d.x + r.y * d.y) / dd,
               height = PointCross(r, d) * PointCross(r, d) / dd; /* squared, of the centre over the line */
  const double chord = (k->radius * k->radius - height) / dd;     /* squared half of it */
  LinePart l = {p, d, 0.0, 1.0};
  double moment[2];
  if (!(chord > 0.0)) return 0;
  l.s0 = Greater(l.s0, nearest - sqrt(chord));
  l.s1 = Lesser(l.s1, nearest + sqrt(chord));
  LineClipSector(k, &l);
  if (!(l.s0 < l.s1)) return 0;
  const double scale = 1.5 * dd / (k->radius * k->height), s = Greater(l.s0, Lesser(l.s1, nearest));
  LineMoments(&l, scale * (chord - nearest * nearest), 2.0 * scale * nearest, -scale, moment);
  c->edge[0] = moment[0] - moment[1];
  c->edge[1] = moment[1];
  c->opposite = 0.0;
  c->inside = l.s1 - l.s0;
  c->largest_phi = scale * (chord - (s - nearest) * (s - nearest));
  return moment[0] > 0.0;
}

/* The chord of a disc and what it reaches into: a wall, of depth `depth`, or another disc. */
typedef struct {
  Point outward;         /* of the disc, a unit vector */
  double from, squared;  /* of the centre to the chord, m; a^2, m2 */
  double reduced_radius; /* R* */
} Chord;

static inline Chord ChordOfWall(double radius, double from, Point outward)
{
  return (Chord){outward, from, (radius - from) * (radius + from), radius};
}

static inline Chord ChordOfDiscs(Point centre, double radius, Point other_centre, double other_radius)
{
  const Point d = PointMinus(other_centre, centre);
  const double distance = sqrt(d.x * d.x + d.y * d.y), depth = radius + other_radius - distance;
  const double beyond = depth * (other_radius + distance - radius) / (2.0 * distance); /* R - from */
  return (Chord){{d.x / distance, d.y / distance},
                 radius - beyond,
                 beyond * (2.0 * radius - beyond),
                 radius * other_radius / (radius + other_radius)};
}

/* The chord's part in the sector and, unless it is NULL, the other one: the integral of phi over `length`, in the measure of an edge so long, *at where it acts,
 * inside and largest_phi; 0: no part.  height: of what the disc reaches into. */
static inline int ContactChord(const Chord *chord, const Sector *own, const Sector *other, double height,
                               double length, Point *at, double *integral, ContactIntegrals *c)
{
  const double a = chord->squared > 0.0 ? sqrt(chord->squared) : 0.0;
  const Point e = chord->outward;
  LinePart l = {{own->centre.x + chord->from * e.x, own->centre.y + chord->from * e.y}, {-e.y, e.x}, -a, a};
  double moment[2];
  if (!(a > 0.0)) return 0;
  LineClipSector(own, &l);
  if (other) LineClipSector(other, &l);
  if (!(l.s0 < l.s1)) return 0;
  const double scale = 1.5 / (chord->reduced_radius * height), s = Greater(l.s0, Lesser(l.s1, 0.0));
  LineMoments(&l, scale * chord->squared, 0.0, -scale, moment);
  if (!(moment[0] > 0.0)) return 0;
  *at = LinePoint(&l, Greater(l.s0, Lesser(l.s1, moment[1] / moment[0])));
  *integral = moment[0] / length;
  c->inside = (l.s1 - l.s0) / length;
  c->largest_phi = scale * (chord->squared - s * s);
  return 1;
}
#endif
