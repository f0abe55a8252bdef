/* Where two surfaces are so close that no fluid element lies between them: points of the solid's surface with a wall of the tank, or with
 * another part of the solid's surface, within a reach (uplift.h).
 *
 *        facet f                          The points are the two Gauss points of each facet.  Opposite a point lies
 *     a ------x------------x----- b       the nearest point y of a facet that is in front of f, faces it and has f in
 *             | reach                     front of itself, or a wall that f faces.
 *     ----g---y-------------------
 *
 * Fields are for reading. */
#ifndef CORACLE_COUPLER_CLOSE_POINTS_H
#define CORACLE_COUPLER_CLOSE_POINTS_H
#include "coupler/geometry/shell.h"

enum { CLOSE_TO_WALL = -1, CLOSE_TO_NOTHING = -2 };

typedef struct {
  int facet;                     /* f, of this rank */
  int opposite;                  /* of the arrived facets; CLOSE_TO_WALL: a wall */
  int is_held, opposite_is_held; /* nothing of f, nothing there is free to move */
  double n[2];                   /* the two functions of f there */
  double opposite_n[2];          /* those of g at y */
  double weight, gap;            /* m: the part of the length of f; the distance */
} ClosePoint;

typedef struct {
  int n, capacity;
  ClosePoint *point; /* [n], by facets */
  Scatter scatter;   /* of facets to where others are close to them */
} ClosePoints;

/* Collective: all points with something within `reach`, m, of the solid and its shell; walls: lower and upper, infinite where there are none.
 * *points is overwritten; zero-initialise the first time. */
PetscErrorCode ClosePointsFind(const SolidState *solid, const Shell shell, const double lower[2],
                               const double upper[2], double reach, ClosePoints *points);
PetscErrorCode ClosePointsDestroy(ClosePoints *points);
/* Collective: arrived[][2][ncomp], of the arrived facets' nodes, from node[nnodes][ncomp] of the solid; and node += arrived, of this rank's
 * copy of each node. */
PetscErrorCode ClosePointsForward(const ClosePoints *points, const SolidState *solid, int ncomp,
                                  const double node[], double arrived[]);
PetscErrorCode ClosePointsReverseAdd(const ClosePoints *points, const SolidState *solid, int ncomp,
                                     const double arrived[], double node[]);
#endif
