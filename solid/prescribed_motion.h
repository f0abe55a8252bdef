/* Prescribed motion of nodes: a velocity, a table in time, linear between its rows and constant before the first and after the
 * last; one row: times sin(2 pi t/period), if there is a period, and from 0 at t = 0 on in proportion to t until `rise`; so is a
 * rotation, about a pivot that moves with the velocity, or it is a table of its own.  A substep moves a prescribed node by the integral of its velocity, so
 * that where it gets does not depend on the substeps. */
#ifndef SOLID_PRESCRIBED_MOTION_H
#define SOLID_PRESCRIBED_MOTION_H
#include "common/program/time_table.h"

enum { MOTION_NAME = 48 };

typedef struct {
  int prescribed[2];   /* which components; the others stay free */
  int nrows;           /* at least 1 */
  const double *row;   /* [nrows][3] t, u, v; s and m/s, t rising */
  double release;      /* s: from then on the nodes are free; 0: never */
  double period, rise; /* s, of one row and the angular velocity beside it; 0: constant, at once */
  double angular_velocity, pivot[2]; /* rad/s, counter-clockwise; m, at t = 0 */
  TimeTable spin;                    /* of s and rad/s, instead of the angular velocity; nrows 0: none */
  char name[MOTION_NAME];            /* leads the columns of its force (probes.h); "": it has none */
} PrescribedMotion;

typedef struct {
  int node, motion;
} PrescribedNode;

/* It moves its nodes at t; from `release` on they are free. */
static inline int PrescribedActs(const PrescribedMotion *d, double t)
{
  return d->release <= 0.0 || t < d->release * (1.0 - 1e-12);
}
/* It has a rotation, or may have one. */
static inline int PrescribedTurns(const PrescribedMotion *d)
{
  return d->spin.nrows > 0 || d->angular_velocity != 0.0;
}
/* The velocity's mean over from .. from + h, h > 0; where there is a rotation, the pivot's. */
double PrescribedVelocity(const PrescribedMotion *d, int component, double from, double h);
/* The mean of the angular velocity, rad/s, and where the pivot is at t, m: of a table of velocities by all its rows before t. */
double PrescribedRotation(const PrescribedMotion *d, double from, double h);
void PrescribedPivot(const PrescribedMotion *d, double t, double pivot[2]);
/* No less than the largest velocity, m/s, and angular velocity, rad/s, that it has over from .. from + length. */
void PrescribedLargest(const PrescribedMotion *d, double from, double length, double *velocity,
                       double *angular_velocity);
/* What a substep of h has for all nodes of a motion: the mean velocity of the pivot, where it begins, and (turn - 1)/h. */
typedef struct {
  double velocity[2], pivot[2], parallel, normal;
} PrescribedSubstep;
PrescribedSubstep PrescribedSubstepOf(const PrescribedMotion *d, double from, double h);
/* v: the mean velocity of a node that is at x when it begins. */
static inline void PrescribedNodeVelocity(const PrescribedSubstep *s, const double x[2], double v[2])
{
  const double r[2] = {x[0] - s->pivot[0], x[1] - s->pivot[1]};
  v[0] = s->velocity[0] + s->parallel * r[0] - s->normal * r[1];
  v[1] = s->velocity[1] + s->normal * r[0] + s->parallel * r[1];
}
#endif
