/* The volume that flows through a segment, of a phase or of all. */
#ifndef FLUID_FLOW_GAUGE_H
#define FLUID_FLOW_GAUGE_H
#include "fluid/flow/fluid.h"

/* flow, m2/s: the integral of u.n along the segment, at the end of the last completed step, where the phase is (-1: everywhere), in an
 * element that it is spread in times its share of that (PhasesGetExtent); n is to the right as one goes from `from` to `to`: along x through
 * a segment that goes upwards.  Exact for the velocity, which is linear in each element; along faces it is the mean of both sides.
 * Collective. */
PetscErrorCode FlowMeasure(Fluid fluid, int phase, const double from[2], const double to[2], double *flow);
#endif
