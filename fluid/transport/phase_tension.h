/* Surface tension of the phases, and the solid that it has to know (phases/wetting.h): that of the last step, also on a mesh that
 * has just been made. */
#ifndef FLUID_PHASE_TENSION_H
#define FLUID_PHASE_TENSION_H
#include "fluid/transport/phase_boundary.h"

typedef struct PhaseTension_s *PhaseTension;

/* stars, properties and boundaries are borrowed until PhaseTensionDestroy; there is no solid yet.  Collective, like what follows. */
PetscErrorCode PhaseTensionCreate(const Stars *stars, const PhaseProperties *properties,
                                  const PhaseBoundaries *boundaries, PhaseTension *tension);
PetscErrorCode PhaseTensionDestroy(PhaseTension *tension);
/* alpha[ne], moves[ne]: as in PhaseStep; alpha NULL: none.  Without surface tension nothing is kept. */
PetscErrorCode PhaseTensionSetSolid(PhaseTension tension, const double alpha[], const char moves[]);
/* The solid of `from`, on another mesh. */
PetscErrorCode PhaseTensionRemap(PhaseTension from, Transfer transfer, PhaseTension to);
/* Whether any element has ever had a solid. */
PetscBool PhaseTensionHasSolid(PhaseTension tension);
/* Adds the force of the phases' lines to inverse[ne]. */
PetscErrorCode PhaseTensionAdd(PhaseTension tension, Phases phases, InverseDensity inverse[]);
#endif
