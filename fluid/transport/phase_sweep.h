/* What one step sweeps through the faces of the elements: fluxes of the velocity, the volumes of the phases that pass with them,
 * and the mass flux that momentum moves with (phases/README.md). */
#ifndef FLUID_PHASE_SWEEP_H
#define FLUID_PHASE_SWEEP_H
#include "fluid/transport/phase_boundary.h"

typedef struct PhaseSweep_s *PhaseSweep;

/* All is borrowed; steps change the volumes of `phases`.  Collective, like all that says nothing else. */
PetscErrorCode PhaseSweepCreate(const FluidDomain *domain, const PhaseProperties *properties,
                                const Stars *stars, PhaseBoundaries *boundaries, Phases phases,
                                PhaseSweep *sweep);
PetscErrorCode PhaseSweepDestroy(PhaseSweep *sweep);
/* Moves the volumes over the step, in parts if an element near an interface would lose more than its content, and the heavier
 * phase out of the solid.  Needs the lines; afterwards these belong to the old volumes: PhasesReconstruct.  Added to out[n]: what
 * has left through the boundary, m2, of all ranks.  Errors of PhasesAdvect. */
PetscErrorCode PhaseSweepStep(PhaseSweep sweep, const PhaseStep *step, double out[]);
/* With the lines of the new volumes: writes step->mass_flux, kg/(m2 s).  Not collective. */
void PhaseSweepMassFlux(PhaseSweep sweep, const PhaseStep *step);
#endif
