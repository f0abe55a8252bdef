/* Where a phase is along a segment, from its volumes and lines: a free-surface gauge.
 *
 *     from ##########------####---- to      #: the phase
 *                    ^         ^
 *                    first     last           length: that of all #
 */
#ifndef FLUID_SURFACE_GAUGE_H
#define FLUID_SURFACE_GAUGE_H
#include "fluid/phases/phases.h"

/* A piece shorter than this part of what the segment has in the element does not count, nor a polygon of less than its square of the element's
 * area, nor a gap of less than this part of the size of the element beyond it, nor a cloud (PHASES_CLOUD). */
#define SURFACE_SLIVER 0.01

typedef struct {
  double first, last, length; /* m from the start of the segment; all 0 without the phase */
} SurfacePlace;

/* Collective over mesh->comm, whose owned elements the phases are on.  first is 0 where another phase is at `from`. */
PetscErrorCode SurfaceMeasure(Phases phases, const Mesh *mesh, int phase, const double from[2],
                              const double to[2], SurfacePlace *place);
/* Not collective.  The part of from + s (to - from), 0 <= s <= 1, within a convex polygon x[n], counter-clockwise; whether there is any.
 * *along: the side, from that corner on, that the segment lies along, or -1. */
PetscBool SegmentClip(int n, const double x[][2], const double from[2], const double to[2], double s[2],
                      int *along);
#endif
