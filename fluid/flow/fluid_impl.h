/* Private to the fluid: what is behind the handle.  The solvers (momentum.h, projection.h) keep their own data; here is the
 * flow itself and what the three parts of a step hand each other. */
#ifndef FLUID_IMPL_H
#define FLUID_IMPL_H
#include "fluid/discretization/material.h"
#include "fluid/discretization/solid_coupling.h"
#include "fluid/flow/budget.h"
#include "fluid/momentum/momentum.h"
#include "fluid/pressure/projection.h"

enum { ASSEMBLY, MOMENTUM, PRESSURE, COUPLING, ADAPTATION, SETUP };

struct Fluid_s {
  FluidSetup setup; /* setup.boundary: that of the domain */
  FluidDomain domain;
  Material material;
  SolidCoupling solid;
  PhaseTransport phases; /* NULL: one fluid */
  Transfer transfer;     /* from the mesh before this one, between FluidTransferPhases and FluidTransfer */
  /* with phases: the bulk velocities of the last two steps, which are free of divergence and move them */
  Vec bulk, bulk_previous;
  Vec outside; /* ghosted, a number an element: density of what is beside the solid (momentum.h) */
  CompressibleElement *compressible; /* [ne] of the current step; NULL: no phase is */
  MomentumSolver momentum;
  ProjectionSolver projection;
  /* the flow; ghosted, velocities in blocks [2][3] an element, pressure on P2 nodes */
  double t, dt_previous;
  int damped;   /* coming steps of backward Euler, whatever the setup's theta */
  double theta; /* of the current step */
  Vec u, u_previous, u_star, u_projected, mass_flux;
  PetscBool prepared; /* FluidPrepareMomentum has been called for the step */
  Vec p;
  Vec dynamic;              /* with phases: phi of the last step, Pa (viscous_share.h) */
  AbsorptionAt *absorption; /* [ne] of the step; NULL: none */
  double *remainder;        /* with phases: FluidRemainder */
  struct {
    double t, dt_previous;
    int damped;
    Vec u, u_previous, p;
    double momentum[2], budget_start[2];
  } saved;
  FluidStats stats;
  char failure[160]; /* of FluidStepFailure, or "" */
  FluidBudget budget;
  double budget_start[2]; /* momentum when the next step begins, kg/s */
  double *budget_sum;     /* this rank's part of the current step's (budget.c) */
};

/* fluid_step.c: what the projection of a velocity at t over dt sees.  Not collective. */
ProjectionStep FluidProjectionStep(Fluid f, double t, double dt, PetscBool inertia);
/* Not collective: takes note of a solver's failure; its iterations. */
int FluidTakeReport(Fluid f, const SolverReport *report);
/* fluid_phases.c: [ne], borrowed; NULL for one fluid.  Not collective. */
const InverseDensity *FluidInverseDensity(Fluid f);
/* After the phases' volumes were set: density and viscosity at both levels.  Collective. */
PetscErrorCode FluidPhasesChanged(Fluid f);
/* Of the phases that element e has, the smallest and the largest density, kg/m3.  Not collective. */
void FluidDensityRange(Fluid f, int e, double *low, double *high);
/* The limit of the interface's waves (fluid.h) on this rank, s; HUGE_VAL without.  Not collective. */
double FluidInterfaceStep(Fluid f);
/* fluid_gas.c: *pressure[ne] of the elements, Pa, is allocated.  Not collective, like what follows. */
PetscErrorCode FluidMeanPressure(Fluid f, double **pressure);
/* Of f->compressible: before the phases move, the target is the share `old` of the pressure and the rest of that of the equations of
 * state; after it, beta, and these in the middle of the step, where a pressure of backward Euler is the volumes'. */
void FluidSetTarget(Fluid f, double old);
void FluidSetCompressibility(Fluid f);
/* The same for a velocity that is to be free of divergence where there is no compressible phase, and left alone where there is. */
PetscErrorCode FluidLeaveCompressible(Fluid f);
/* Refuses elements whose density rho[ne] is not positive: says which phase, where, and what helps. */
PetscErrorCode FluidCheckDensity(Fluid f, const double rho[]);
/* fluid_phases.c: moves the phases over dt with the velocity in mass_flux, extrapolated by s steps, and makes it the mass flux.  Collective. */
PetscErrorCode FluidMovePhases(Fluid f, double dt, double s);
/* interface_viscosity.c, as part of that: MATERIAL_STEP's viscosity; u[ne][6]: that velocity, like u of flux.h, m/s.  Collective. */
PetscErrorCode FluidDampInterface(Fluid f, const double u[]);
/* fluid_phases.c, after that: the density of what elements have beside the solid (f->outside).  Collective. */
PetscErrorCode FluidSetOutside(Fluid f);
/* p becomes the pressure that, with its values on open boundaries as they are, makes the acceleration weight - R^-1 grad p
 * free of divergence: that of the first instant of phases at rest.  Collective. */
PetscErrorCode FluidBalancePressure(Fluid f);
/* initial.c: p on open boundaries, and nowhere else: hydrostatic, with their pressures at t and levels.  Collective. */
PetscErrorCode FluidSetOpenPressure(Fluid f, double t);
/* The same with the solid, whose inertia and motion of the coming step over dt take part. */
PetscErrorCode FluidPredictPressure(Fluid f, double dt);
/* Of a step with phases (viscous_share.h): the momentum equation, which is assembled, gets a share of the last dynamic pressure; velocity, what
 * it has made of u, loses that again.  Not collective. */
PetscErrorCode FluidLendPressure(Fluid f, double dt);
PetscErrorCode FluidReturnPressure(Fluid f, double dt, Vec velocity);
/* bulk = velocity + M^-1 (us - ms velocity), with ghosts left alone.  Not collective. */
PetscErrorCode FluidBulkVelocity(Fluid f, Vec velocity, Vec bulk);
/* budget.c, not collective. */
PetscErrorCode FluidBudgetCreate(Fluid f);
PetscErrorCode FluidBudgetDestroy(Fluid f);
/* Between two steps u has been given another value.  Collective. */
PetscErrorCode FluidBudgetChanged(Fluid f);
/* When the step's pressure is predicted: begins its budget.  Not collective. */
PetscErrorCode FluidBudgetBegin(Fluid f);
/* What the solid does to the fluid over the step, before the correction is applied.  Not collective. */
PetscErrorCode FluidBudgetSolid(Fluid f, double dt, const CoracleCorrection correction[]);
/* The rest, with the step's end in u_projected, its start still in u, and the material not advanced.  Collective. */
PetscErrorCode FluidBudgetEnd(Fluid f, double dt);
#endif
