/* Private to the phases room. */
#ifndef CORACLE_PHASES_IMPL_H
#define CORACLE_PHASES_IMPL_H
#include "fluid/phases/phases.h"

/* An element within this fraction of empty or full of a phase counts as such when lines are made. */
#define PHASES_TINY 1e-12

/* Lines of a cut element, relative to its first vertex.  A line of n = 0 takes all (d >= 0) or nothing. */
struct Phases_s {
  const Stars *stars; /* borrowed */
  int np;
  double *volume;  /* [nl][np] m2 */
  HalfPlane *line; /* [nl][np - 1] */
  int *single;     /* [nl] the only phase, or -1 */
  double courant;
  PetscBool has_lines;
};

/* The part of phase p in local element e, relative to origin. */
void PhasesPart(Phases phases, int e, int p, const double origin[2], Polygon *part);
/* The same, of those that phases 0 .. p - 1 leave together. */
void PhasesRest(Phases phases, int e, int p, const double origin[2], Polygon *rest);
/* The half plane of line p of element e, relative to origin. */
static inline HalfPlane PhasesMoveLine(HalfPlane h, const double x0[2], const double origin[2])
{
  h.d += h.n[0] * (x0[0] - origin[0]) + h.n[1] * (x0[1] - origin[1]);
  return h;
}

static inline HalfPlane PhasesLine(Phases f, int e, int p, const double origin[2])
{
  return PhasesMoveLine(f->line[(size_t)e * (size_t)(f->np - 1) + (size_t)p], f->stars->element[e].x[0],
                        origin);
}
/* With two phases: the distance of vertex v of an owned element from the interface, negative in the first phase, m; 0 where
 * elements of both phases meet there, and around which no element is cut.  *inside: 1 in the first phase, 0 in the second,
 * 1/2 on the interface. */
double PhasesDistance(Phases phases, int v, double *inside);
/* The interface's curvature near vertex v of an owned element, 1/m, positive where the first phase is convex; 0 is returned
 * where none is known.  cosine: of contact angles, as in PhasesGetSurfaceForce. */
int PhasesCurvature(Phases phases, int v, const double cosine[], double *curvature);
/* Where the first line of cut element e crosses its face i, m; 0 if it does not. */
int PhasesCrossing(Phases phases, int e, int i, double x[2]);
/* area[np] += weight * |polygon and phase p| in local element e; polygon lies in the element, relative to
 * origin. */
void PhasesSplit(Phases phases, int e, const Polygon *polygon, const double origin[2], double weight,
                 double area[]);
/* The same in an element whose first vertex is x0 and that has these lines[np - 1], or is of a single phase.
 * */
void PhasesSplitBy(int np, int single, const HalfPlane line[], const double x0[2], const Polygon *polygon,
                   const double origin[2], double weight, double area[]);
#endif
