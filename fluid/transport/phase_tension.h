/* Surface tension of the phases, with the solid that they know (phases/wetting.h). */
#ifndef FLUID_PHASE_TENSION_H
#define FLUID_PHASE_TENSION_H
#include "fluid/transport/phase_boundary.h"

typedef struct PhaseTension_s *PhaseTension;

/* stars, properties and boundaries are borrowed until PhaseTensionDestroy; there is no solid yet.  Collective, like what follows. */
PetscErrorCode PhaseTensionCreate(const Stars *stars, const PhaseProperties *properties,
                                  const PhaseBoundaries *boundaries, PhaseTension *tension);
PetscErrorCode PhaseTensionDestroy(PhaseTension *tension);
/* There is a solid; moves[ne]: as in PhaseStep, NULL: nothing moves.  Without surface tension nothing is kept. */
PetscErrorCode PhaseTensionSetSolid(PhaseTension tension, const char moves[]);
/* As it was set, borrowed; NULL: nothing was kept.  Not collective. */
const char *PhaseTensionMoves(PhaseTension tension);
/* Adds the force of the phases' lines to inverse[ne]. */
PetscErrorCode PhaseTensionAdd(PhaseTension tension, Phases phases, InverseDensity inverse[]);
#endif
