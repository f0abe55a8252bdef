/* Where the mesh must be fine because the solid's surface is there, or will be before the mesh changes again.
 * What the fluid knows of the solid is the coupling on its elements, and that is enough: pieces of the shell
 * and velocities. */
#ifndef FLUID_SOLID_BAND_H
#define FLUID_SOLID_BAND_H
#include "fluid/fluid.h"

/* Fine elements on each side of the surface, in multiples of le. */
#define SOLID_BAND 2.0

typedef struct {
  double size_min, size_max; /* le, Le, m */
  double slope;              /* by which sizes grow with the distance from the band */
  double ahead;              /* until the next adaptation, s */
  double reach;              /* how far the surface may move until then, m */
} SolidBand;

/* Collective: the largest speed of the solid, m/s; 0 without one. */
PetscErrorCode SolidBandSpeed(Fluid fluid, double *speed);
/* Collective: size[nv], m, for the first nv vertices: le within SOLID_BAND le of the way of the surface,
 * growing outside; Le far away, where gradation takes over. */
PetscErrorCode SolidBandSizes(Fluid fluid, const SolidBand *band, int nv, double size[]);
#endif
