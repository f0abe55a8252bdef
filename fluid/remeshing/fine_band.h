/* Where the mesh must be fine because the solid's surface or the interface between phases is there, or will be before the
 * mesh changes again.  Of the solid the coupling on the fluid's elements is known, and that is enough; of the interface the
 * elements that it cuts. */
#ifndef FLUID_FINE_BAND_H
#define FLUID_FINE_BAND_H
#include "fluid/flow/fluid.h"

/* Fine elements on each side of the surface, in multiples of their size. */
#define FINE_BAND 2.0

typedef struct {
  double size_min, size_max; /* le, Le, m */
  double interface_size;     /* of elements at the interface, m */
  double corner_size;        /* of elements at corners of the solid, m */
  double slope;              /* by which sizes grow with the distance from the band */
  double ahead;              /* until the next adaptation, s */
  double reach;              /* how far the surface may move until then, m */
} FineBand;

/* Collective: the largest speed of the solid and of the interface, m/s; 0 without either. */
PetscErrorCode FineBandSpeed(Fluid fluid, double *speed);
/* Collective: size[nv], m, for the first nv vertices: the surface's size within FINE_BAND times that of its way, growing
 * outside; Le far away, where gradation takes over. */
PetscErrorCode FineBandSizes(Fluid fluid, const FineBand *band, int nv, double size[]);
#endif
