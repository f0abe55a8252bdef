/* The series fluid_forces.csv: the budget of momentum (budget.h) and the forces on the boundaries, a row a step:
 *
 *   t, dt [s]; start momentum, momentum, x and y of each [kg/s]; then x and y of each [N/m]
 *   weight, solid, correction, divergence, interface, absorption, adaptation, rest       on the fluid
 *   NAME pressure, NAME viscous, NAME convection                             of each boundary, on it */
#ifndef FLUID_FORCE_SERIES_H
#define FLUID_FORCE_SERIES_H
#include "common/program/run_case.h"
#include "fluid/flow/fluid.h"

typedef struct ForceSeries_s *ForceSeries;

/* Collective: the series in output.folder; with a checkpoint (else NULL) as it was at ForceSeriesSave. */
PetscErrorCode ForceSeriesCreate(const RunCase *run, Fluid fluid, Checkpoint from, ForceSeries *s);
/* Collective, between two steps. */
PetscErrorCode ForceSeriesSave(ForceSeries s, Checkpoint to);
/* Not collective, after every step. */
PetscErrorCode ForceSeriesStep(ForceSeries s, Fluid fluid);
PetscErrorCode ForceSeriesDestroy(ForceSeries *s);
#endif
