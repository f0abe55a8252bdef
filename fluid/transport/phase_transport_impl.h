/* What the files of PhaseTransport share. */
#ifndef FLUID_PHASE_TRANSPORT_IMPL_H
#define FLUID_PHASE_TRANSPORT_IMPL_H
#include "fluid/transport/phase_sweep.h"
#include "fluid/transport/phase_tension.h"
#include "fluid/transport/phase_transport.h"

/* The solid as fields: alpha, and alpha where it moves. */
enum { SOLID, MOVING, SOLID_FIELDS };

struct PhaseTransport_s {
  const FluidDomain *domain; /* borrowed */
  PhaseProperties properties;
  double gravity[2];
  Stars *stars;
  Phases phases;
  PhaseBoundaries boundaries;
  PhaseSweep sweep;
  PhaseTension tension;
  InverseDensity *begin, *end, *inverse_density; /* [ne] at the ends of the step, and what the step sees */
  double *saved, *saved_mass;                    /* [ne][n] volumes, masses */
  double (*saved_solid)[SOLID_FIELDS];           /* [ne] that the lines were made with */
  PhaseBudget budget, saved_budget;
};

/* The solid of the step to come: alpha[ne] and moves[ne] as in PhaseStep, NULL: nothing moves; of none, if there has never been one, nothing is kept.  Collective. */
PetscErrorCode PhaseTransportSetSolid(PhaseTransport t, const double alpha[], const char moves[]);
/* volume[n]: of all ranks, m2.  Collective. */
PetscErrorCode PhaseTransportSumVolumes(PhaseTransport t, double volume[]);
/* Lines, and what follows from them.  Collective. */
PetscErrorCode PhaseTransportReconstruct(PhaseTransport t);
#endif
