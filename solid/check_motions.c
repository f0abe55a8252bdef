#include "solid/check_motions.h"
#include "solid/prescribed_motion.h"
#include <stdio.h>

enum { MOST_LINES = 8, INSTANTS = 1000 };

/* Way of the pivot along x and y, m, and angle, rad: the least and the most. */
typedef struct {
  double least[3], most[3];
} MotionRange;

/* When a motion ends of a run that ends then. */
static double EndOf(const PrescribedMotion *d, double end)
{
  return d->release > 0.0 ? fmin(d->release, end) : end;
}

static MotionRange RangeOf(const PrescribedMotion *d, double end)
{
  MotionRange range = {{0.0}, {0.0}};
  for (int i = 1; i <= INSTANTS; i++) {
    const double t = end * i / INSTANTS;
    const double at[3] = {t * PrescribedVelocity(d, 0, 0.0, t), t * PrescribedVelocity(d, 1, 0.0, t),
                          t * PrescribedRotation(d, 0.0, t)};
    for (int c = 0; c < 3; c++) {
      if (c < 2 && !d->prescribed[c]) continue;
      range.least[c] = fmin(range.least[c], at[c]);
      range.most[c] = fmax(range.most[c], at[c]);
    }
  }
  return range;
}

void ExpectMotions(Solid s, double end)
{
  for (int k = 0, motion = -1, lines = 0; k < s->nprescribed && lines < MOST_LINES; k++) {
    if (s->prescribed[k].motion == motion) continue;
    motion = s->prescribed[k].motion;
    const PrescribedMotion *d = &s->motion[motion];
    const MotionRange r = RangeOf(d, EndOf(d, end));
    if (r.most[0] - r.least[0] + r.most[1] - r.least[1] + r.most[2] - r.least[2] == 0.0) continue;
    printf("solid: body %d is moved%s%s by %.3g to %.3g m along x, by %.3g to %.3g m along y",
           s->node_body[s->prescribed[k].node], d->name[0] ? " as " : "", d->name, r.least[0], r.most[0],
           r.least[1], r.most[1]);
    if (PrescribedTurns(d))
      printf(", turned by %.3g to %.3g rad about (%.4g, %.4g) m, which moves with it", r.least[2], r.most[2],
             d->pivot[0], d->pivot[1]);
    printf("\n");
    lines++;
  }
}

/* rad: the fluid beside a body that turns by more in a step is not resolved in time. */
#define FAR_TURN 1.0

void NoteTurns(Solid s, double end, double dt_max)
{
  for (int k = 0; k < s->nprescribed; k++) {
    const PrescribedMotion *d = &s->motion[s->prescribed[k].motion];
    double velocity, turn;
    PrescribedLargest(d, 0.0, EndOf(d, end), &velocity, &turn);
    turn *= d->period > 0.0 ? fmin(dt_max, d->period / PETSC_PI) : dt_max; /* there and back */
    if (turn <= FAR_TURN) continue;
    printf(
        "note: solid.bodies[%d] is turned by up to %.3g rad in time.dt_max, %g s: the fluid around it needs "
        "steps in which that is a few degrees\n",
        s->body[s->node_body[s->prescribed[k].node]].entry, turn, dt_max);
    return;
  }
}
