/* The fluid: incompressible Navier-Stokes with P1DG velocity and P2 pressure on a mesh of triangles, the
 * solid present through the coupling of coracle.h.  One step is
 *
 *   FluidMomentum   u*  from  (rho/dt M + theta L + a) u* = ...           momentum.c
 *   FluidProject    u+  = u* - dt/rho grad phi,  p += phi                 pressure.c
 *   FluidCorrect    u   = u+ + M^-1 r                                     coupling.c
 *
 * Velocity is a block Vec: element e, component c, vertex i at 6 e + 3 c + i.  rho and mu are per element.
 * All functions are collective over mesh->comm unless said otherwise. */
#ifndef FLUID_H
#define FLUID_H
#include "common/link/coracle.h"
#include "common/mesh/mesh.h"
#include "common/output/checkpoint.h"
#include "fluid/kernels.h"
#include <petscksp.h>

/* v: value(s) at x and t */
typedef void (*FieldFunction)(void *context, double t, const double x[2], double v[]);

typedef enum {
  BOUNDARY_VELOCITY,  /* u = velocity (no slip where it is 0) */
  BOUNDARY_FREE_SLIP, /* u.n = 0, no tangential traction */
  BOUNDARY_OPEN       /* no viscous traction, hydrostatic pressure plus `pressure` */
} BoundaryKind;

typedef struct {
  BoundaryKind kind;
  double velocity[2];        /* m/s */
  PetscBool parabolic;       /* velocity times 4 s (1 - s), s along the boundary's bounding box */
  double lower[2], upper[2]; /* that box; set by FluidCreate */
  double rise;               /* s: until then velocity times (1 - cos(pi t/rise))/2; 0: at once */
  double pressure;           /* where open: above hydrostatic, Pa */
  FieldFunction function;    /* instead of velocity; NULL: none */
  void *context;
} Boundary;

typedef struct {
  double theta;         /* 0.5 Crank-Nicolson .. 1 backward Euler */
  double rho, mu;       /* kg/m3, Pa s */
  double gravity[2];    /* m/s2 */
  double cfl, dt_max;   /* step control */
  Boundary *boundary;   /* [mesh->ntags], copied */
  FieldFunction source; /* body force per volume, N/m3, or NULL */
  void *source_context;
} FluidSetup;

/* Collective: what the prescribed velocities take out of the domain at time t, m2/s: net, and the sum over all edges
 * of its size.  Sets the bounding boxes of boundary[mesh->ntags]. */
PetscErrorCode FluidPrescribedFlux(const Mesh *mesh, Boundary boundary[], double t, double *net,
                                   double *gross);

typedef struct Fluid_s *Fluid;

typedef struct {
  int momentum_iterations, pressure_iterations;
  double t, dt, max_speed;
  double
      seconds[6]; /* assembly, momentum, pressure, coupling; adaptation with transfer, set-up on new meshes */
} FluidStats;

PetscErrorCode FluidCreate(const Mesh *mesh, const FluidSetup *setup, Fluid *fluid); /* mesh borrowed */
/* The same fluid on another mesh with the same boundary names, without state: FluidTransfer. */
PetscErrorCode FluidCreateLike(Fluid like, const Mesh *mesh, Fluid *fluid);
PetscErrorCode FluidDestroy(Fluid *fluid);
/* Initial velocity by interpolation (NULL: rest) and hydrostatic pressure (or p by interpolation). */
PetscErrorCode FluidSetInitial(Fluid fluid, double t, FieldFunction velocity, FieldFunction pressure,
                               void *context);

/* Takes the state between two steps over from a fluid on another mesh of the same domain: velocity by
 * Galerkin projection, which conserves momentum to round-off; pressure by interpolation; time and counters.
 */
PetscErrorCode FluidTransfer(Fluid from, Fluid to);
/* After that, with the coupling of the coming step set: takes the part of the bulk velocity off that is not
 * free of divergence, which else would come out as a jump of the pressure. */
PetscErrorCode FluidMakeSolenoidal(Fluid fluid);

/* The state between two steps in a checkpoint, and out of it on a mesh that MeshLoad has given, with its
 * rows. On as many ranks as saved it the fluid goes on to the last bit as it would have, as far as a run
 * repeats itself; to the solvers' tolerance on others, and where a solid gives way (the factor of giving.c is
 * new). */
PetscErrorCode FluidSave(Fluid fluid, Checkpoint to);
PetscErrorCode FluidLoad(Fluid fluid, const PetscInt row[], Checkpoint from);

/* The solid's coupling of the coming step, element indices being local elements (copied); n = 0: no solid. */
PetscErrorCode FluidSetCoupling(Fluid fluid, int n, const CoracleCoupling coupling[]);
/* u* and u+ and p from t to t + dt */
PetscErrorCode FluidMomentum(Fluid fluid, double dt);
PetscErrorCode FluidProject(Fluid fluid, double dt);
/* Gives the inside of the solid its new velocity; correction: one entry a coupling entry, or NULL without a
 * solid. Ends the step: t becomes t + dt. */
PetscErrorCode FluidCorrect(Fluid fluid, double dt, const CoracleCorrection correction[]);
/* The three in turn, for a fluid alone. */
PetscErrorCode FluidStep(Fluid fluid, double dt);
/* Largest dt of the CFL condition on this rank, capped by dt_max.  Not collective. */
double FluidTimeStep(Fluid fluid);

/* Views, borrowed, not collective: velocities [ne][2][3] of the owned elements, as of the last completed
 * step, before the projection of the step in hand and after it; pressure [np2]. */
const double *FluidVelocity(Fluid fluid);
const double *FluidVelocityStar(Fluid fluid);
const double *FluidVelocityPlus(Fluid fluid);
const double *FluidPressure(Fluid fluid);
const double *FluidDensity(Fluid fluid);       /* [ne] */
const double *FluidViscosity(Fluid fluid);     /* [ne] */
const double *FluidSolidFraction(Fluid fluid); /* [ne] alpha_s */
const FluidStats *FluidGetStats(Fluid fluid);
const Mesh *FluidMesh(Fluid fluid);
/* Saves (1) or puts back (0) velocity, pressure and time: for a step that is redone. */
PetscErrorCode FluidState(Fluid fluid, int save);

/* Total momentum, kg m/s a metre, and kinetic energy, J/m. */
PetscErrorCode FluidMomentumTotal(Fluid fluid, double momentum[2], double *energy);
/* Force of the fluid on a boundary, N/m, from the interior-penalty traction (consistent with the scheme). */
PetscErrorCode FluidBoundaryForce(Fluid fluid, const char *boundary, double force[2]);
/* L2 errors against exact fields (any NULL skipped); pressure up to a constant. */
PetscErrorCode FluidErrors(Fluid fluid, double t, FieldFunction velocity, FieldFunction pressure,
                           void *context, double *velocity_error, double *pressure_error);
#endif
