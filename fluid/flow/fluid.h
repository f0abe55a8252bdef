/* The fluid: incompressible Navier-Stokes with P1DG velocity and P2 pressure on a mesh of triangles, the
 * solid present through the coupling of coracle.h.  One step from t^n to t^{n+1} is
 *
 *   FluidMomentum   u*           from  (rho/dt M + theta L + a) u* = ...                 momentum.h
 *   FluidProject    u_projected  =  u* - dt/rho grad phi,  p += phi                      projection.h
 *   FluidCorrect    u^{n+1}      =  u_projected + M^-1 r  inside the solid               solid_coupling.h
 *
 * Velocity is a block Vec: element e, component c, vertex i at 6 e + 3 c + i.  rho and mu are per element
 * (material.h).  All functions are collective over mesh->comm unless said otherwise. */
#ifndef FLUID_H
#define FLUID_H
#include "common/link/coracle.h"
#include "common/output/checkpoint.h"
#include "common/program/gravity.h"
#include "common/space/p2_space.h"
#include "fluid/discretization/absorption.h"
#include "fluid/discretization/boundary.h"
#include "fluid/discretization/kernels.h"
#include "fluid/discretization/material.h"
#include "fluid/transport/phase_transport.h"
#include <petscksp.h>

typedef struct {
  double theta; /* 0.5 Crank-Nicolson .. 1 backward Euler */
  /* kg/m3, Pa s; with phases: of the lightest, which hydrostatic pressures at open boundaries have */
  double rho, mu;
  PhaseProperties phases;  /* n = 0: one fluid */
  double gravity[2];       /* m/s2, of the current step */
  TimeTable gravity_table; /* of t, s, and gravity in its place, borrowed (gravity.h); nrows 0: none */
  double velocity[2];      /* everywhere at the start, unless FluidSetInitial has another, m/s */
  double cfl, dt_max;      /* step control */
  double capillary_cfl, gravity_cfl; /* the same of waves of the interface (FluidTimeStep); 0: no limit */
  Boundary *boundary;                /* [mesh->ntags], copied */
  FieldFunction source;              /* body force per volume, N/m3, or NULL */
  void *source_context;
  Absorption absorption;
} FluidSetup;

typedef struct Fluid_s *Fluid;

typedef struct {
  int momentum_iterations, pressure_iterations;
  double t, dt;
  /* Of this rank, by FluidTimeStep: m/s; the most steps a second that the CFL condition asks for, and the element that does: its centre, m, and its
   * largest speed, m/s. */
  double max_speed, cfl_rate, cfl_centre[2], cfl_speed;
  double
      seconds[6]; /* assembly, momentum, pressure, coupling; adaptation with transfer, set-up on new meshes */
} FluidStats;

PetscErrorCode FluidCreate(const Mesh *mesh, const FluidSetup *setup, Fluid *fluid); /* mesh borrowed */
/* The same fluid on another mesh with the same boundary names, without state: FluidTransfer. */
PetscErrorCode FluidCreateLike(Fluid like, const Mesh *mesh, Fluid *fluid);
PetscErrorCode FluidDestroy(Fluid *fluid);
/* With phases, before FluidSetInitial: where they are; errors of PhasesFill. */
PetscErrorCode FluidSetPhases(Fluid fluid, int nregions, const Region region[]);
/* Initial velocity by interpolation (NULL: that of the setup) and hydrostatic pressure (or p by interpolation); with
 * phases the pressure of the first instant, in which gravity alone acts. */
PetscErrorCode FluidSetInitial(Fluid fluid, double t, FieldFunction velocity, FieldFunction pressure,
                               void *context);
/* Before the first step of a run, with its coupling set: the fluid inside the solid moves with it, and of phases it is the
 * lightest.  A body that begins with a velocity has its whole momentum then, and strikes the fluid around it in the first step. */
PetscErrorCode FluidStartInside(Fluid fluid);

/* Takes the state between two steps over from a fluid on another mesh of the same domain: velocity by
 * Galerkin projection, which conserves momentum to round-off; pressure by interpolation; time and counters.
 * A material that varies is to be set on the new mesh (FluidSetMaterial, MATERIAL_OLD). */
PetscErrorCode FluidTransfer(Fluid from, Fluid to);
/* Before that, as soon as the phases of `from` are those of the step's end: the phases alone, and with them density and
 * viscosity, which the coupler asks for before the step is over; FluidTransfer does it where it was left out. */
PetscErrorCode FluidTransferPhases(Fluid from, Fluid to);
/* After FluidTransfer, or FluidSetInitial with a velocity that does not fit together with the boundaries' (at rest among moving
 * phases, too: they would be swept by it), with the coupling of the coming step set: subtracts the part of the bulk velocity that
 * is not free of divergence, which else would appear as a jump of the pressure. */
PetscErrorCode FluidMakeSolenoidal(Fluid fluid);

/* The state between two steps in a checkpoint, and out of it on a mesh of MeshLoad, with its rows (a material
 * that varies is saved by who sets it).  On as many ranks as saved it the run resumes to the last bit, as far
 * as a run repeats itself; to the solvers' tolerance on others, and where the solid has implicit inertia (the
 * factor of weighted_projection.c is new). */
PetscErrorCode FluidSave(Fluid fluid, Checkpoint to);
PetscErrorCode FluidLoad(Fluid fluid, const PetscInt row[], Checkpoint from);

/* Density, kg/m3, and viscosity, Pa s, of the owned elements, [ne], at the beginning (MATERIAL_OLD) or the end
 * (MATERIAL_NEW) of the coming step; by default those of the setup.  What is new becomes old as the step ends. */
PetscErrorCode FluidSetMaterial(Fluid fluid, MaterialLevel level, const double rho[], const double mu[]);
/* The solid's coupling of the coming step, element indices being local elements (copied); n = 0: no solid. */
PetscErrorCode FluidSetCoupling(Fluid fluid, int n, const CoracleCoupling coupling[]);
/* Optional, before FluidSetCoupling, for one fluid whose velocity is free of divergence: assembles what of the momentum equation from t to
 * t + dt, s, does not depend on the solid. */
PetscErrorCode FluidPrepareMomentum(Fluid fluid, double dt);
/* u*, then u_projected and p, from t to t + dt, s. */
PetscErrorCode FluidMomentum(Fluid fluid, double dt);
PetscErrorCode FluidProject(Fluid fluid, double dt);
/* NULL, or which equation of the step has not converged: the step, from FluidMakeSolenoidal on, cannot be made, and the fluid is good for
 * FluidRestoreState and FluidDestroy alone.  Borrowed until then; not collective, the same on all ranks. */
const char *FluidStepFailure(Fluid fluid);
/* Gives the inside of the solid its new velocity; correction: one entry a coupling entry, or NULL without a
 * solid. Ends the step: t becomes t + dt. */
PetscErrorCode FluidCorrect(Fluid fluid, double dt, const CoracleCorrection correction[]);
/* The three in turn, for a fluid alone. */
PetscErrorCode FluidStep(Fluid fluid, double dt);
/* Largest dt on this rank, capped by dt_max, of the CFL condition and, as the interface moves with the velocity of the step's start, of the shortest
 * waves that its elements, of area A = h^2/2, have: of surface tension, capillary_cfl sqrt((rho_0 + rho_1) h^3/surface tension), least of all pairs of
 * phases, and of gravity, gravity_cfl/omega with omega^2 = g pi/h |rho_0 - rho_1|/(rho_0 + rho_1).  A tank that sloshes with
 * 12 mm, 0.70 J/m (tests/coupled/waves.yaml with time.cfl 1, fluid.gravity_cfl 100, solid.bodies [] and the water's region a polygon, (-1, -1), (4, -1), (4, 0.52),
 * (-1, 0.48)), gains within 6 s at most 0.16, 0.12, 0.03, 0.04, 0.03 J/m with omega dt of 2, 1.5, 1, 0.5, 0.25, h being le.  Not collective. */
#define CAPILLARY_CFL 0.4 /* of case files that have none */
#define GRAVITY_CFL 0.5
double FluidTimeStep(Fluid fluid);

/* Views, borrowed, not collective: velocities [ne][2][3] of the owned elements, as of the last completed
 * step, before the projection of the current step and after it; pressure on the nodes of its
 * space, [n]; material at its end. */
const double *FluidVelocity(Fluid fluid);
const double *FluidVelocityStar(Fluid fluid);
const double *FluidVelocityProjected(Fluid fluid);
const double *FluidPressure(Fluid fluid);
const double *FluidDensity(Fluid fluid);   /* [ne] */
const double *FluidViscosity(Fluid fluid); /* [ne] */
/* start[2][3]: where the implicit inertia of element e starts from in the current step (solid_coupling.h). */
void FluidStartVelocity(Fluid fluid, int e, double start[]);
const double *FluidGravity(Fluid fluid);       /* [2] m/s2, of the step */
const double *FluidSolidFraction(Fluid fluid); /* [ne] alpha_s */
PhaseTransport FluidPhases(Fluid fluid);       /* NULL: one fluid */
/* [ne][2] N/m, with phases: CoracleFlow.remainder of the step. */
const double *FluidRemainder(Fluid fluid);
const FluidStats *FluidGetStats(Fluid fluid);
const Mesh *FluidMesh(Fluid fluid);
const P2Space *FluidPressureSpace(Fluid fluid);
/* Saves velocity, pressure, material and time, and restores them for a step that is redone. */
PetscErrorCode FluidSaveState(Fluid fluid);
PetscErrorCode FluidRestoreState(Fluid fluid);

/* Total momentum, kg m/s a metre, and kinetic energy, J/m. */
PetscErrorCode FluidMomentumTotal(Fluid fluid, double momentum[2], double *energy);
/* Of phases, also of that which fills solids, J/m: - int rho g.x. */
PetscErrorCode FluidPotentialEnergy(Fluid fluid, double *energy);
/* Force of the fluid on a boundary over the last step, N/m: pressure and viscous part of budget.h.  Not collective. */
PetscErrorCode FluidBoundaryForce(Fluid fluid, const char *boundary, double force[2]);
#endif
