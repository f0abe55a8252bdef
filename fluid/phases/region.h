/* Regions of the plane that belong to phases, as a case file lists them: boxes, half planes, discs, polygons.
 * Later ones are painted over earlier ones.  A region becomes triangles, a disc those of a
 * regular polygon of 2048 sides and the disc's area, and these are intersected with the elements: fractions
 * are exact to round-off for straight sides, and to 1e-6 of the radius in place for discs. */
#ifndef CORACLE_PHASES_REGION_H
#define CORACLE_PHASES_REGION_H
#include "fluid/phases/phases.h"

typedef enum { REGION_BOX, REGION_HALF_PLANE, REGION_DISC, REGION_POLYGON } RegionShape;

typedef struct {
  RegionShape shape;
  int phase;
  double a[2];   /* box: lower corner, may be infinite; half plane: a point of its edge; disc: centre, m */
  double b[2];   /* box: upper corner, m; half plane: outward normal, any length */
  double radius; /* disc, m */
  int n;         /* polygon: corners, at least 3 */
  const double (*x)[2]; /* polygon: [n] in either sense, simple; borrowed */
} Region;

/* Collective.  Sets the volumes.  Errors, on all ranks: PETSC_ERR_ARG_OUTOFRANGE for a phase that does not
 * exist, a shape without area or a polygon that crosses itself; PETSC_ERR_ARG_INCOMP if some of the domain is
 * in no region. */
PetscErrorCode PhasesFill(Phases phases, int nregions, const Region region[]);
#endif
