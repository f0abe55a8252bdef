/* What a phase is as a whole, from its polygons in the elements: its place, its motion. */
#ifndef FLUID_PHASE_GAUGE_H
#define FLUID_PHASE_GAUGE_H
#include "fluid/flow/fluid.h"

typedef struct {
  double area;        /* m2 */
  double centre[2];   /* m; 0 without the phase, like the velocity */
  double velocity[2]; /* mean, m/s */
  double interface;   /* its length, m */
} PhaseMeasure;

/* Of the last completed step.  Collective. */
PetscErrorCode PhaseMeasureOf(Fluid fluid, int phase, PhaseMeasure *measure);
#endif
