/* The joint's law by itself: energies of tension, shear and mixed paths, no healing, pressure on damaged
 * joints, continuity with what the edge carried, one end that hangs on; its forces are those of its work and
 * keep momentum and angular momentum. */
#include "solid/cracks/joint.h"
#include "tests/check.h"

enum { STEPS = 200000 };

static const double STRENGTH[2] = {3e6, 7e6};

static JointLaw Law(double mode_one, double mode_two)
{
  return (JointLaw){{STRENGTH[0], STRENGTH[1]}, {mode_one, mode_two}, 6e13, 0.0};
}

/* Of an end by itself. */
static JointTraction TractionAt(const JointLaw *law, JointEnd *end, double opening, double slip)
{
  const JointTraction t = JointTension(law, end, opening, slip), p = JointPress(law, end, opening, slip);
  return (JointTraction){t.normal + p.normal, t.shear + p.shear};
}

/* The opening or slip at which one mode alone has damage D, from activation on. */
static double OpeningRange(const JointLaw *law, int mode, double damage)
{
  return damage * law->energy[mode] / (JOINT_SOFTENING_AREA * STRENGTH[mode]);
}

/* The traction on an end, with that of contact between its faces. */
static JointTraction WithContact(const JointLaw *law, JointEnd *end, double opening, double slip)
{
  JointTraction t = TractionAt(law, end, opening, slip);
  t.normal += law->stiffness * fmin(opening, 0.0);
  return t;
}

/* The work until the end is broken, at a constant mixture of modes, or with the slip first and then the
 * opening. */
static double Work(const JointLaw *law, double angle, int bent)
{
  const double x = cos(angle), y = sin(angle);
  JointEnd end = JointBegin(law, x * STRENGTH[0], y * STRENGTH[1]);
  JointTraction before = {x * STRENGTH[0], y * STRENGTH[1]};
  double work = 0.0, o = 0.0, s = 0.0;
  for (int k = 1; k <= STEPS; k++) {
    const double part = (bent ? 3.0 : 1.1) * k / STEPS, slip_part = bent ? fmin(0.3, 2.0 * part) : part;
    const double next_o = x * OpeningRange(law, 0, part), next_s = y * OpeningRange(law, 1, slip_part),
                 damage = end.damage;
    const JointTraction now = TractionAt(law, &end, next_o, next_s);
    work +=
        0.5 * (before.normal + now.normal) * (next_o - o) + 0.5 * (before.shear + now.shear) * (next_s - s);
    CHECK(bent || fabs(end.damage - fmin(part, 1.0)) < 1e-9, "D = %g instead of %g", end.damage, part);
    CHECK(end.damage >= damage, "D falls from %g to %g", damage, end.damage);
    before = now;
    o = next_o;
    s = next_s;
  }
  CHECK(end.damage == 1.0 && before.normal == 0.0 && before.shear == 0.0, "not broken at %g: D = %g", angle,
        end.damage);
  CHECK(fabs(end.absorbed / work - 1.0) < 1e-9, "absorbed %.12g, work %.12g", end.absorbed, work);
  return work;
}

static void Energies(void)
{
  const JointLaw equal = Law(120.0, 120.0), other = Law(120.0, 300.0);
  for (int k = 0; k <= 6; k++) {
    const double angle = k * M_PI / 12.0, c = cos(angle), s = sin(angle);
    const double work = Work(&equal, angle, 0), mixed = Work(&other, angle, 0);
    const double expected = 120.0 * c * c + 300.0 * s * s;
    CHECK(fabs(work / 120.0 - 1.0) < 1e-6, "%.9g J/m2 at angle %g", work, angle);
    CHECK(fabs(mixed / expected - 1.0) < 1e-6, "%.9g J/m2 instead of %g at angle %g", mixed, expected, angle);
  }
  for (int k = 1; k <= 3; k++) {
    const double work = Work(&equal, k * M_PI / 12.0, 1);
    const double ramp = 0.5 * (STRENGTH[1] * STRENGTH[1] - STRENGTH[0] * STRENGTH[0]) / equal.stiffness;
    CHECK(ramp < 0.003 * 120.0 && fabs(work - 120.0) < ramp, "%g J/m2 on the bent path %d", work, k);
  }
}

/* Pulled to half its range, let go, pulled again: the same line down and up, the old strength is gone. */
static void NoHealing(void)
{
  const JointLaw law = Law(120.0, 120.0);
  const double range = law.energy[0] / (JOINT_SOFTENING_AREA * STRENGTH[0]);
  JointEnd end = JointBegin(&law, STRENGTH[0], 0.0);
  const double peak = TractionAt(&law, &end, 0.3 * range, 0.0).normal, damage = end.damage;
  CHECK(fabs(peak / (STRENGTH[0] * JointSoftening(0.3)) - 1.0) < 1e-12, "%g Pa", peak);
  const double zero = -end.offset[0];
  for (int back = 0; back < 2; back++)
    for (int k = 0; k <= 10; k++) {
      const double part = back ? 0.1 * k : 1.0 - 0.1 * k, o = zero + part * (0.3 * range - zero);
      const double traction = TractionAt(&law, &end, o, 0.0).normal;
      CHECK(fabs(traction - part * peak) < 1e-9 * peak, "%g Pa instead of %g", traction, part * peak);
      CHECK(end.damage == damage, "D = %g", end.damage);
    }
  const double further = TractionAt(&law, &end, 0.6 * range, 0.0).normal;
  CHECK(fabs(further / (STRENGTH[0] * JointSoftening(0.6)) - 1.0) < 1e-12, "%g Pa", further);
}

/* Broken, an end leaves all of the pressure to contact; till then both together press as hard as the edge did. */
static void Pressed(void)
{
  const JointLaw law = Law(120.0, 300.0);
  JointEnd end = JointBegin(&law, STRENGTH[0], 0.0);
  (void)TractionAt(&law, &end, 1.0, 0.0);
  const JointTraction t = TractionAt(&law, &end, -1e-7, 0.0);
  CHECK(t.normal == 0.0 && t.shear == 0.0, "a broken end: %g Pa", t.normal);
  /* sheared under pressure: the pressure stays while the shear goes, its joint closing a little */
  end = JointBegin(&law, -2e6, STRENGTH[1]);
  const JointTraction first = TractionAt(&law, &end, 0.0, 0.0);
  CHECK(fabs(first.normal / -2e6 - 1.0) < 1e-12 && fabs(first.shear / STRENGTH[1] - 1.0) < 1e-12, "%g %g",
        first.normal, first.shear);
  (void)TractionAt(&law, &end, 0.0, 1.0);
  const JointTraction last = WithContact(&law, &end, -2e6 / law.stiffness, 1.0);
  CHECK(end.damage == 1.0 && last.shear == 0.0 && fabs(last.normal / -2e6 - 1.0) < 1e-12, "%g", last.normal);
}

/* It activates with what the edge carried, below its strength or on it, and with its strength where that was more. */
static void Continuity(void)
{
  const JointLaw law = Law(120.0, 300.0);
  const double normal[5] = {1e6, 2e6, -4e6, 5e6, 3e7}, shear[5] = {2e6, -7e6, 7.5e6, 1e6, -4e7};
  for (int k = 0; k < 5; k++) {
    JointEnd end = JointBegin(&law, normal[k], shear[k]);
    const JointTraction t = TractionAt(&law, &end, 0.0, 0.0);
    const double friction = JointFriction(&law, normal[k], shear[k]),
                 part = 1.0 / fmax(1.0, sqrt(JointLoad(&law, normal[k], shear[k]))),
                 n = normal[k] > 0.0 ? part * normal[k] : normal[k],
                 s = friction + part * (shear[k] - friction);
    CHECK(fabs(t.normal - n) < 1e-3 && fabs(t.shear - s) < 1e-3, "%g %g", t.normal, t.shear);
    CHECK(JointLoad(&law, t.normal, t.shear) < 1.0 + 1e-9, "load %g", JointLoad(&law, t.normal, t.shear));
    CHECK(end.damage < 1e-12, "D = %g", end.damage);
  }
}

/* A potential of springs: forces are -dU/dx by central differences, their sum and moment vanish. */
static double Potential(const Point one[2], const Point two[2])
{
  const JointShape shape = JointShapeOf(one, two);
  double u = 0.0;
  for (int i = 0; i < 2; i++)
    u += 0.5 * (3.0 * shape.opening[i] * shape.opening[i] + 7.0 * shape.slip[i] * shape.slip[i]);
  return u;
}

static void Forces(void)
{
  Point p[4] = {{0.1, 0.2}, {1.1, -0.1}, {0.15, 0.1}, {1.2, -0.3}}, f[4];
  const JointShape shape = JointShapeOf(p, p + 2);
  JointTraction t[2];
  for (int i = 0; i < 2; i++) t[i] = (JointTraction){3.0 * shape.opening[i], 7.0 * shape.slip[i]};
  JointForces(&shape, t, 1.0, f, f + 2);
  Point sum = {0.0, 0.0};
  double moment = 0.0;
  for (int i = 0; i < 4; i++) {
    sum = (Point){sum.x + f[i].x, sum.y + f[i].y};
    moment += PointCross(p[i], f[i]);
    for (int c = 0; c < 2; c++) {
      double *x = c ? &p[i].y : &p[i].x;
      const double old = *x, h = 1e-6;
      *x = old + h;
      const double up = Potential(p, p + 2);
      *x = old - h;
      const double down = Potential(p, p + 2);
      *x = old;
      const double force = c ? f[i].y : f[i].x;
      CHECK(fabs(force + (up - down) / (2.0 * h)) < 1e-8, "node %d: %.12g, -dU/dx %.12g", i, force,
            -(up - down) / (2.0 * h));
    }
  }
  CHECK(fabs(sum.x) + fabs(sum.y) + fabs(moment) < 1e-14, "sum %g %g, moment %g", sum.x, sum.y, moment);
}

/* Let go a little: the traction falls as JointAddStiffness says, pulled and pressed. */
static void Stiffness(void)
{
  const JointLaw law = Law(120.0, 300.0);
  const double at[3][2] = {{0.5, 0.4}, {0.1, 0.8}, {-0.1, 0.3}}; /* opening and slip in reaches */
  for (int k = 0; k < 3; k++) {
    JointEnd end[2] = {JointBegin(&law, STRENGTH[0], 0.0), {.begun = 0.0}};
    JointShape shape = {.opening = {at[k][0] * OpeningRange(&law, 0, 1.0), 0.0},
                        .slip = {at[k][1] * OpeningRange(&law, 1, 1.0), 0.0}};
    const double way[2] = {-1e-4 * fabs(shape.opening[0]) - 1e-10, -1e-4 * shape.slip[0]};
    const JointTraction far = WithContact(&law, &end[0], shape.opening[0], shape.slip[0]);
    const JointTraction near = WithContact(&law, &end[0], shape.opening[0] + way[0], shape.slip[0] + way[1]);
    const double expected = (near.normal - far.normal) * way[0] + (near.shear - far.shear) * way[1];
    double normal[2] = {0.0, 0.0}, shear[2] = {0.0, 0.0};
    JointAddStiffness(&law, end, &shape, 0, (double[2]){way[0], 0.0}, (double[2]){way[1], 0.0}, normal,
                      shear);
    const double power = normal[0] * way[0] + shear[0] * way[1];
    CHECK(fabs(power / expected - 1.0) < 1e-6, "%d: %.12g instead of %.12g", k, power, expected);
  }
}

/* Element 2 turns about the common end 0, until it lies back to back with element 1. */
static void Hinge(void)
{
  enum { TURNS = 100000 };
  const JointLaw law = Law(120.0, 300.0);
  const double length = 0.01;
  JointEnd end[2] = {JointBegin(&law, STRENGTH[0], 0.0), JointBegin(&law, STRENGTH[0], 0.0)};
  Point one[2] = {{0.0, 0.0}, {length, 0.0}}, two[2] = {{0.0, 0.0}, {length, 0.0}};
  double before = STRENGTH[0] * 0.5 * length * length, work = 0.0; /* moment about the common end, N m/m */
  for (int k = 1; k <= TURNS; k++) {
    const double angle = 0.99 * M_PI * k / TURNS;
    JointTraction t[2], last[2];
    Point f[4];
    two[1] = (Point){length * cos(angle), -length * sin(angle)};
    const JointShape shape = JointShapeOf(one, two);
    JointTractions(&law, end, &shape, t);
    JointForces(&shape, t, 0.5 * length, f, f + 2);
    const double moment = PointCross(two[1], f[3]);
    work += 0.5 * (before + moment) * 0.99 * M_PI / TURNS;
    before = moment;
    if (end[1].damage < 1.0 || end[0].other_weight > 0.0) continue;
    JointLast(&end[0], (double[2]){shape.opening[0], shape.slip[0]},
              (double[2]){shape.opening[1], shape.slip[1]});
    JointTractions(&law, end, &shape, last);
    CHECK(fabs(last[0].normal + last[1].normal - t[0].normal - t[1].normal) < 1e-9 * STRENGTH[0],
          "%g Pa, and %g once it is the last end", t[0].normal + t[1].normal,
          last[0].normal + last[1].normal);
    CHECK(end[0].damage < 1e-3, "D = %g of the end that has not opened", end[0].damage);
    before = PointCross(two[1], (JointForces(&shape, last, 0.5 * length, f, f + 2), f[3]));
  }
  CHECK(end[0].damage == 1.0 && before == 0.0, "D = %g, %g N m/m at the end", end[0].damage, before);
  CHECK(fabs(work / (120.0 * length) - 1.0) < 2e-4, "%.9g J/m to tear %g m", work, length);
  CHECK(fabs(0.5 * (end[0].absorbed + end[1].absorbed) / 120.0 - 1.0) < 2e-4, "%g and %g J/m2 absorbed",
        end[0].absorbed, end[1].absorbed);
}

/* Mohr and Coulomb: a pressed edge bears F_s + f p and activates without a jump; as it is damaged it leaves the pressure
 * and the friction of it to contact, and its energy of fracture does not count that. */
static void FrictionCase(void)
{
  JointLaw law = Law(120.0, 300.0);
  law.friction = 0.7;
  const double p = 5e6, bears = STRENGTH[1] + 0.7 * p, other_weight = OpeningRange(&law, 1, 1.0);
  for (int sign = -1; sign <= 1; sign += 2) {
    CHECK(JointLoad(&law, -p, 0.999 * sign * bears) < 1.0 && JointLoad(&law, -p, 1.001 * sign * bears) > 1.0,
          "bears %g Pa", bears);
    JointEnd end = JointBegin(&law, -p, sign * bears);
    JointTraction t = TractionAt(&law, &end, 0.0, 0.0);
    CHECK(fabs(t.normal + p) + fabs(t.shear - sign * bears) < 1e-6 * p, "begins with %g, %g", t.normal,
          t.shear);
    for (int k = 1; k <= STEPS; k++) { /* pressed as hard, whatever its damage: contact's part is p D */
      const double opening = -p / law.stiffness - end.offset[2] * (1.0 - end.damage);
      t = TractionAt(&law, &end, opening, sign * 1.1 * other_weight * k / STEPS);
      const double cohesion = end.residual * STRENGTH[1];
      CHECK(fabs(t.shear - sign * (cohesion - 0.7 * t.normal)) < 1e-5 * bears, "%g Pa at D = %g", t.shear,
            end.damage);
    }
    CHECK(end.damage == 1.0 && fabs(end.absorbed / 300.0 - 1.0) < 1e-5, "absorbed %g J/m2", end.absorbed);
    t = TractionAt(&law, &end, -p / law.stiffness, 0.9 * sign * other_weight);
    CHECK(t.normal == 0.0 && t.shear == 0.0, "%g, %g Pa when broken", t.normal, t.shear);
  }
}

/* An end that activated under a pressure and opens: its damage and traction follow from where it is, not from how often that was asked. */
static void OpenedAfterPressure(double shear)
{
  const JointLaw law = Law(120.0, 300.0);
  const double far = OpeningRange(&law, 0, 0.4), slip = OpeningRange(&law, 1, 0.1);
  JointEnd once = JointBegin(&law, -6.0 * STRENGTH[0], shear), often = once;
  JointTraction direct = {0.0, 0.0}, gradual = direct;
  for (int k = 1; k <= 2; k++) direct = TractionAt(&law, &once, 0.5 * k * far, 0.5 * k * slip);
  const JointEnd before = once;
  const JointTraction again = TractionAt(&law, &once, far, slip);
  CHECK(once.damage > 0.3 && once.damage < 0.9, "D = %g", once.damage);
  CHECK(once.damage == before.damage && again.normal == direct.normal && again.shear == direct.shear,
        "asked again: D = %.15g instead of %.15g, traction %.15g instead of %.15g Pa", once.damage,
        before.damage, again.normal, direct.normal);
  for (int k = 1; k <= 1000; k++) gradual = TractionAt(&law, &often, 1e-3 * k * far, 1e-3 * k * slip);
  CHECK(fabs(often.damage - once.damage) < 1e-9 && fabs(gradual.normal - direct.normal) < 1e-8 * STRENGTH[0],
        "D = %.12g in 1000 steps, %.12g in 2", often.damage, once.damage);
}

int main(void)
{
  Stiffness();
  Hinge();
  Energies();
  NoHealing();
  Pressed();
  Continuity();
  Forces();
  FrictionCase();
  OpenedAfterPressure(0.0);
  OpenedAfterPressure(-STRENGTH[1]);
  return 0;
}
