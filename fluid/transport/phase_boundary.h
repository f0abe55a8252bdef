/* What the fluid's boundaries do to the phases: which one flows in, up to which level, at which angle the interface meets them,
 * and what their prescribed velocities carry through their faces. */
#ifndef FLUID_PHASE_BOUNDARY_H
#define FLUID_PHASE_BOUNDARY_H
#include "fluid/transport/phase_transport.h"

typedef struct {
  const FluidDomain *domain;    /* borrowed */
  char *open;                   /* [ntags] fluxes are free there */
  double (*inflow)[PHASES_MAX]; /* [ntags] fractions of what comes in */
  PhasesPairs *contact;         /* [ntags] cosines of contact angles */
  PhasesLevels *levels;         /* [ntags], of the step */
  double *moment;               /* [ne][3][2] of FluxBoundary, of the step */
} PhaseBoundaries;

/* What comes in through an open boundary, or is prescribed: the lightest phase, unless the boundary says which; levels against
 * gravity[2], m/s2.  The domain is borrowed.  Not collective, like what follows. */
PetscErrorCode PhaseBoundariesCreate(const FluidDomain *domain, const PhaseProperties *properties,
                                     const double gravity[2], PhaseBoundaries *boundaries);
PetscErrorCode PhaseBoundariesDestroy(PhaseBoundaries *boundaries);
/* Sets moment: int lambda g.n, m2/s, on boundary faces, of the instants that the step's velocity is made of; and the levels' heights
 * in the middle of the step. */
void PhaseBoundariesSetStep(PhaseBoundaries *boundaries, const PhaseStep *step);
#endif
