/* The volumes of the phases beside a solid, which the lightest one fills: the velocity of elements that its surface crosses is not the solid's, so
 * in each step some of a heavier phase comes into it, and elsewhere leaves a gap. */
#ifndef FLUID_PHASE_SOLID_H
#define FLUID_PHASE_SOLID_H
#include "fluid/transport/phase_transport.h"

/* Of volumes after advection.  Heavier phases leave what the solid covers of elements, solid[ne] = |K and S|/|K|, one after the other, the heaviest
 * first: each has the room that heavier ones leave, and goes into gaps, then where the nearest room is (PhasesExpel).  Then gaps are closed: where the
 * elements around one of the surface do not have the lightest phase, what this has beside the solid in it is exchanged for the lightest one that they have, p, of
 * the nearest element in which p meets lighter ones.  (Without that the air that one step leaves below a float stays, and adds up: it
 * lifted a block at rest by 0.4 mm in 3 s.)  Added to swept[ne][3][n] of PhasesAdvect.  Collective. */
PetscErrorCode PhaseLeaveSolid(const PhaseProperties *properties, const Stars *stars, Phases phases,
                               const double solid[], double swept[]);
#endif
