/* What lies outside of open boundaries and is swept in.
 *
 *      left         | domain      Each point outside belongs to one boundary: to that of the nearer end of the face
 *     .             |             that sweeps it, and, where two boundaries meet there, v, to the one on its side of
 *    v'. . . . . .  v             the line through v and v', where v was dt ago.  So the face of a boundary sweeps
 *     .             |             what is outside of this boundary, and the interior faces around v divide the same
 *      inlet        |             way: volumes stay in their bounds, since what all faces sweep fits together.
 *
 * Not collective. */
#ifndef CORACLE_PHASES_OUTSIDE_H
#define CORACLE_PHASES_OUTSIDE_H
#include "fluid/phases/swept.h"

typedef struct {
  const Stars *stars;
  const PhasesInflow *inflow; /* NULL: boundaries are closed */
  const double (*flux)[3];    /* [nl]; 0 through a boundary face: a wall */
  const double (*shift)[2];   /* [nowned] from where a vertex is to where it was, m */
} Outside;

/* Whether what may come in at vertex v is phase p alone: all that is outside of open boundaries around it. */
int OutsideIsOnly(const Outside *outside, int v, int p);
/* The parts of what is outside of the face between the owned elements' vertices a and b, seen from `origin`; none where no open
 * boundary is near. */
void OutsideDivide(const Outside *outside, int a, int b, const double origin[2], SweptOutside *parts);
/* area[np] += what of the uncovered area `rest` comes in of each phase, after SweptCollect. */
void OutsideShare(const Outside *outside, int np, double rest, const SweptOutside *parts, double area[]);
#endif
