/* The joint, a cohesive element: the traction between two triangles along their common edge once that edge is
 * loaded to its strength, and how it softens until they are apart.  Two ends, each with half of the edge's
 * length L (at rest); per end
 *
 *        a2----------b2    element 2         d = x2 - x1 at the end,  e along the midline a -> b,
 *        :   o ^     :                       n to its right, out of element 1
 *        a1----------b1    element 1         opening o = d.n,  slip s = d.e
 *
 *     O = max(o + c' + o0, 0),  S = s + s0,  a = F_t/k + D r_t,  b = F_s/k + D r_s,  r_i = G_i/(A F_i)
 *     intact      (O/a)^2 + (S/b)^2 <= 1 at D = 0     sigma = k O, tau = k S
 *     softening   D = the least in 0 .. 1 with (O/a)^2 + (S/b)^2 <= 1, never less than before
 *                 sigma = z(D) F_t O/a,  tau = z(D) F_s S/b
 *     pressed     sigma = k max(c', min(o + c', 0)), c' = c (1 - D) <= 0: the pressure of its activation, which contact
 *                 between the two faces, k min(o, 0), takes over as they close
 *     friction    q += k ds, cut back to |q| <= f |sigma| where pressed, as contact's is; tau is the value above plus q,
 *                 so that an intact edge bears F_s + f |sigma| (Mohr and Coulomb)
 *
 * with z(D) of JointSoftening and A = int_0^1 z dD.  Strength and residual strength are ellipses: (sigma/F_t)^2
 * + (tau/F_s)^2 = z^2 while D grows; unloading goes straight to the origin.  (o0, s0) and c are chosen when
 * the joint activates: its traction then is that of the elements (JointBegin), and it needs no compliance before.
 *
 * Energy.  With O = a cos q, S = b sin q the work while D grows is, per unit of edge,
 *     sigma do + tau ds = z/A (G_I cos^2 q + G_II sin^2 q) dD + z (F_s b - F_t a) sin q cos q dq
 * so that an end dissipates exactly G_I in tension, G_II in shear, G_I cos^2 q + G_II sin^2 q at a constant
 * mixture; for G_I = G_II it is G on every path up to (F_s^2 - F_t^2)/2k.  One that activates under a pressure P and
 * breaks under it takes P^2/2k more, which is not counted.
 *
 * The last end.  Two pieces that turn about an end do not open it: on its half of the edge they would hang
 * for ever, and folded back to back (midline of length 0) have no joint's shape.  So from when the other end
 * has broken its tension is that of the middle of its half, o = 3/4 o_i + 1/4 o_j, s alike, less what they
 * were beyond its own then: no traction jumps, and G still is what it takes.  It is pressed where it was. */
#ifndef SOLID_JOINT_H
#define SOLID_JOINT_H
#include "solid/plane.h"
#include <math.h>

#define JOINT_SOFTENING_AREA 0.386307294743945 /* int_0^1 z(D) dD */

typedef struct {
  double strength[2]; /* tension, shear, Pa */
  double energy[2];   /* mode I, mode II, J/m2 */
  double stiffness;   /* k: that of contact on this edge, Pa/m */
  double friction;    /* f: pressure adds f times itself to the shear strength */
} JointLaw;

typedef struct {
  double damage, residual; /* D, z(D) */
  double begun;            /* 1; 0: its nodes are still one */
  double offset[3];        /* o0, s0, c, m */
  double opening, slip;    /* of the last evaluation, m */
  double other_weight;     /* the other end's part in opening and slip: 0, or 1/4 once it has broken; */
  double shift[2];         /* then they are less by this, m */
  double tension, shear;   /* the traction then, Pa */
  double friction;         /* q: friction's share of the shear, Pa */
  double friction_slip;    /* the end's own slip when last pressed, m */
  double absorbed;         /* int tension do + shear ds, J/m2: the energy of fracture when broken */
} JointEnd;

typedef struct {
  double normal, shear; /* Pa */
} JointTraction;

/* z(D): 1 at D = 0, 0 at D = 1 */
static inline double JointSoftening(double damage)
{
  const double a = 0.63, b = 1.8, c = 6.0, ab = a + b, remaining = 1.0 - damage,
               square = remaining * remaining;
  return (1.0 - (ab - 1.0) / ab * exp(damage * (a + c * b) / (ab * (1.0 - ab)))) *
         (a * remaining + b * square * square * square);
}

/* What friction bears of a shear, at most f times the pressure. */
static inline double JointFriction(const JointLaw *law, double normal, double shear)
{
  const double most = -law->friction * Lesser(normal, 0.0);
  return Greater(-most, Lesser(most, shear));
}

/* Of the traction on an edge, over its strength: (sigma/F_t)^2 + (tau'/F_s)^2, tau' what friction does not
 * bear. */
static inline double JointLoad(const JointLaw *law, double normal, double shear)
{
  const double x = Greater(normal, 0.0) / law->strength[0];
  const double y = (shear - JointFriction(law, normal, shear)) / law->strength[1];
  return x * x + y * y;
}

/* An end activates under the traction that the edge carries, or, where that is more than its strength, on the
 * ellipse: so it is in an impact, when the nodes of another edge part, and after a resume with lower strengths (tests/solid/lowered.sh).
 * Stronger by that much, with a traction that is continuous, what cannot bear its load stood. */
static inline JointEnd JointBegin(const JointLaw *law, double normal, double shear)
{
  const double friction = JointFriction(law, normal, shear);
  const double part = 1.0 / Greater(1.0, sqrt(JointLoad(law, normal, shear)));
  JointEnd end = {.residual = 1.0,
                  .begun = 1.0,
                  .tension = part * Greater(normal, 0.0),
                  .shear = part * (shear - friction),
                  .friction = friction};
  end.offset[0] = end.tension / law->stiffness;
  end.offset[1] = end.shear / law->stiffness;
  end.offset[2] = Lesser(normal, 0.0) / law->stiffness;
  return end;
}

/* O at a damage: what is left of the pressure with which the end activated is to be opened, too. */
static inline double JointOpening(const JointEnd *end, double damage, double opening)
{
  return Greater(opening + end->offset[2] * (1.0 - damage) + end->offset[0], 0.0);
}

/* The least damage, not less than the end's, that brings (O, S) onto the ellipse of half axes start + D range: a function of where the end
 * is, so that asked twice it is the same.  Newton's method, which comes from below: O/a falls with D and is convex, or, where less is damaged
 * by the opening than pressure goes, rises, and is taken as if O stayed. */
static inline double JointDamage(const JointEnd *end, double opening, double slip, const double start[2],
                                 const double range[2])
{
  const double growth = -end->offset[2];
  double damage = end->damage;
  for (int k = 0; k < 50 && damage < 1.0; k++) {
    const double a = start[0] + damage * range[0], b = start[1] + damage * range[1];
    const double x = JointOpening(end, damage, opening) / a, y = slip / b, beyond = x * x + y * y - 1.0;
    if (beyond <= 1e-14) break;
    const double falls = x * range[0] > growth ? x * range[0] - growth : x * range[0];
    damage += 0.5 * beyond / (x * falls / a + y * y * range[1] / b);
  }
  return Lesser(damage, 1.0);
}

/* The other end has broken; theirs are its opening and slip, own this end's. */
static inline void JointLast(JointEnd *end, const double own[2], const double theirs[2])
{
  end->other_weight = 0.25;
  for (int c = 0; c < 2; c++) end->shift[c] = end->other_weight * (theirs[c] - own[c]);
}

/* The traction without what presses, at an opening and a slip; remembers damage and energy. */
static inline JointTraction JointTension(const JointLaw *law, JointEnd *end, double opening, double slip)
{
  const double k = law->stiffness, *f = law->strength;
  const double start[2] = {f[0] / k, f[1] / k};
  const double range[2] = {law->energy[0] / (JOINT_SOFTENING_AREA * f[0]),
                           law->energy[1] / (JOINT_SOFTENING_AREA * f[1])};
  const double s = slip + end->offset[1], damage = JointDamage(end, opening, s, start, range);
  if (damage > end->damage) end->residual = damage < 1.0 ? JointSoftening(damage) : 0.0;
  end->damage = damage;
  const double o = JointOpening(end, damage, opening);
  const double tension = end->residual * f[0] * o / (start[0] + end->damage * range[0]);
  const double shear = end->residual * f[1] * s / (start[1] + end->damage * range[1]);
  end->absorbed += 0.5 * (end->tension + tension) * (opening - end->opening) +
                   0.5 * (end->shear + shear) * (slip - end->slip);
  end->opening = opening;
  end->slip = slip;
  end->tension = tension;
  end->shear = shear;
  return (JointTraction){tension, shear};
}

/* What is left of the pressure with which an end activated. */
static inline double JointPressure(const JointLaw *law, const JointEnd *end, double opening)
{
  const double preload = end->offset[2] * (1.0 - end->damage);
  return law->stiffness * Greater(preload, Lesser(opening + preload, 0.0));
}

/* Pressure and friction of an end at its own opening and slip; remembers the friction. */
static inline JointTraction JointPress(const JointLaw *law, JointEnd *end, double opening, double slip)
{
  const double pressure = JointPressure(law, end, opening);
  end->friction = JointFriction(law, pressure, end->friction + law->stiffness * (slip - end->friction_slip));
  end->friction_slip = slip;
  return (JointTraction){pressure, end->friction};
}

/* --- the edge in the plane ---------------------------------------------------------------------------- */

typedef struct {
  Point along, normal; /* unit vectors e and n of the midline */
  double length;       /* of the midline, m */
  double opening[2], slip[2];
} JointShape;

/* one, two: the ends' positions on element 1 and on element 2. */
static inline JointShape JointShapeOf(const Point one[2], const Point two[2])
{
  const Point line = {0.5 * (one[1].x + two[1].x - one[0].x - two[0].x),
                      0.5 * (one[1].y + two[1].y - one[0].y - two[0].y)};
  JointShape shape = {.length = sqrt(line.x * line.x + line.y * line.y)};
  shape.along = (Point){line.x / shape.length, line.y / shape.length};
  shape.normal = (Point){shape.along.y, -shape.along.x};
  for (int i = 0; i < 2; i++) {
    const Point d = PointMinus(two[i], one[i]);
    shape.opening[i] = d.x * shape.normal.x + d.y * shape.normal.y;
    shape.slip[i] = d.x * shape.along.x + d.y * shape.along.y;
  }
  return shape;
}

/* The tractions t of both ends. */
static inline void JointTractions(const JointLaw *law, JointEnd end[2], const JointShape *shape,
                                  JointTraction t[2])
{
  const double *o = shape->opening, *s = shape->slip;
  t[0] = t[1] = (JointTraction){0.0, 0.0};
  for (int i = 0; i < 2; i++) {
    JointEnd *k = &end[i];
    if (!(k->begun > 0.0)) continue;
    const double own = 1.0 - k->other_weight, theirs = k->other_weight;
    const JointTraction traction = JointTension(law, k, own * o[i] + theirs * o[1 - i] - k->shift[0],
                                                own * s[i] + theirs * s[1 - i] - k->shift[1]);
    const JointTraction press = JointPress(law, k, o[i], s[i]);
    t[i].normal += own * traction.normal + press.normal;
    t[i].shear += own * traction.shear + press.shear;
    t[1 - i].normal += theirs * traction.normal;
    t[1 - i].shear += theirs * traction.shear;
  }
}

/* Adds end i's part to the rates normal[2] and shear[2], Pa/s, of the tractions on both ends when the ends open
 * and slip with these velocities, m/s: with the stiffness of unloading to the origin, or of pressed faces, contact's part of it included.
 * Linear and symmetric in (opening, slip). */
static inline void JointAddStiffness(const JointLaw *law, const JointEnd end[2], const JointShape *shape,
                                     int i, const double opening[2], const double slip[2], double normal[2],
                                     double shear[2])
{
  const JointEnd *k = &end[i];
  const double k0 = law->stiffness, own = 1.0 - k->other_weight,
               pressure = JointPressure(law, k, shape->opening[i]);
  const int pressed = shape->opening[i] < 0.0 || pressure < 0.0;
  const double rate[2] = {own * opening[i] + k->other_weight * opening[1 - i],
                          own * slip[i] + k->other_weight * slip[1 - i]};
  double *growth[2] = {normal, shear};
  if (pressed) normal[i] += k0 * opening[i];
  if (fabs(k->friction) < -law->friction * pressure) shear[i] += k0 * slip[i];
  for (int mode = 0; mode < 2; mode++) {
    const double f = law->strength[mode];
    if (mode == 0 && pressed && k->tension == 0.0) continue;
    const double traction =
        k->residual * f / (f / k0 + k->damage * law->energy[mode] / (JOINT_SOFTENING_AREA * f)) * rate[mode];
    growth[mode][i] += own * traction;
    growth[mode][1 - i] += k->other_weight * traction;
  }
}

/* Forces of the tractions t on element 1's nodes (one) and element 2's (two); half: L/2.  They are those of
 * the virtual work sum_i half (sigma do + tau ds): the turning of the midline with its four nodes gives the
 * couple m = sum_i half (sigma s - tau o) and with it neither momentum nor angular momentum changes. */
static inline void JointForces(const JointShape *shape, const JointTraction t[2], double half, Point one[2],
                               Point two[2])
{
  const Point e = shape->along, n = shape->normal;
  double couple = 0.0;
  for (int i = 0; i < 2; i++)
    couple += half * (t[i].normal * shape->slip[i] - t[i].shear * shape->opening[i]);
  for (int i = 0; i < 2; i++) {
    const Point traction = {half * (t[i].normal * n.x + t[i].shear * e.x),
                            half * (t[i].normal * n.y + t[i].shear * e.y)};
    const double turn = (i == 0 ? -0.5 : 0.5) * couple / shape->length;
    one[i] = (Point){traction.x + turn * n.x, traction.y + turn * n.y};
    two[i] = (Point){-traction.x + turn * n.x, -traction.y + turn * n.y};
  }
}
#endif
