/* What the fluid's boundaries prescribe.  A boundary is a named part of the mesh's rim (mesh->tag_name); its
 * condition enters the weak forms through three things only: the velocity that it prescribes, the directions
 * in which it does so, and the pressure where it is open.  Velocities are imposed by Nitsche's method
 * (kernels.h), pressures strongly (projection.h).
 *
 *   kind        velocity prescribed         traction               pressure
 *   VELOCITY    u = g(x, t)                 -                      -
 *   FREE_SLIP   u.n = 0                     (tau n).t = 0          -
 *   OPEN        -                           tau n = 0              hydrostatic + `pressure`(t)
 *
 * What depends on time (rise, factor, period, level) is that of both ends of a step for velocities, of its middle for pressures
 * and for levels, also as what comes in goes by them.
 * What comes in where it is OPEN has been at rest outside (AssembleBoundary). */
#ifndef FLUID_BOUNDARY_H
#define FLUID_BOUNDARY_H
#include "common/mesh/mesh.h"
#include "common/program/time_table.h"
#include "fluid/phases/phases.h"
#include <petscsys.h>

/* v: value(s) at x, m, and t, s */
typedef void (*FieldFunction)(void *context, double t, const double x[2], double v[]);

typedef enum {
  BOUNDARY_VELOCITY,  /* u = velocity (no slip where it is 0) */
  BOUNDARY_FREE_SLIP, /* u.n = 0, no tangential traction */
  BOUNDARY_OPEN       /* no viscous traction, hydrostatic pressure plus `pressure` */
} BoundaryKind;

/* What a boundary does to phases; all zero: the lightest comes in, and interfaces meet walls at 90 degrees. */
typedef struct {
  int nlevels, level_phase[PHASES_MAX]; /* where open: layers outside, from below, each up to a height */
  double level[PHASES_MAX];             /* against gravity, m, rising; they come in below it */
  TimeTable level_table[PHASES_MAX];    /* of t, s, and the level, in its place; nrows 0: none */
  double level_period;                  /* s: in which the tables repeat themselves; 0: they do not */
  double inflow[PHASES_MAX];            /* fractions of what else comes in, sum 1; all 0: the lightest */
  PhasesPairs contact_cosine;           /* of contact angles, through the first phase of each pair */
} BoundaryPhases;

typedef struct {
  BoundaryKind kind;
  double velocity[2];        /* m/s */
  PetscBool parabolic;       /* velocity times 4 s (1 - s), s along the boundary's bounding box */
  TimeTable profile;         /* of x or y, m, along that box's longer side, and a factor; nrows 0: none */
  double lower[2], upper[2]; /* that box, m; set by BoundaryBoxes */
  double pressure;           /* where open: above hydrostatic, Pa */
  double rise;               /* s: until then velocity, pressure times (1 - cos(pi t/rise))/2; 0: at once */
  TimeTable factor;          /* of t, s, and a factor of velocity, pressure; nrows 0: none */
  double period; /* s: in which factor repeats itself; without a factor: times sin(2 pi t/period); 0: no */
  BoundaryPhases phases;
  FieldFunction function; /* instead of velocity; NULL: none */
  void *context;
} Boundary;

/* Sets the bounding boxes of boundary[mesh->ntags].  Collective over mesh->comm. */
PetscErrorCode BoundaryBoxes(const Mesh *mesh, Boundary boundary[]);
/* What velocity and pressure are times at t.  Not collective, like what follows. */
double BoundaryFactor(const Boundary *b, double t);
/* The height of layer k outside at t, m. */
double BoundaryLevel(const BoundaryPhases *b, int k, double t);
/* Whether velocity, pressure or a level depend on time. */
PetscBool BoundaryVaries(const Boundary *b);
/* The velocity v, m/s, that a BOUNDARY_VELOCITY prescribes at x and t. */
void BoundaryVelocity(const Boundary *b, double t, const double x[2], double v[2]);
/* v.n, and 0 where that is round-off: a wall that moves along itself is closed.  n: of any length. */
static inline double BoundaryNormalPart(const double v[2], const double n[2])
{
  const double part = v[0] * n[0] + v[1] * n[1];
  return fabs(part) > 1e-9 * hypot(v[0], v[1]) * hypot(n[0], n[1]) ? part : 0.0;
}
/* project[c][d]: the directions in which a boundary with outward unit normal n prescribes the velocity: I, n n or 0. */
void BoundaryProjection(const Boundary *b, const double n[2], double project[2][2]);
/* Volume that the prescribed velocities of all BOUNDARY_VELOCITY take out of the domain at time t, m2/s: net, and the
 * sum of its absolute value over all edges (gross).  Sets the bounding boxes.  Collective over mesh->comm. */
PetscErrorCode BoundaryPrescribedFlux(const Mesh *mesh, Boundary boundary[], double t, double *net,
                                      double *gross);
#endif
