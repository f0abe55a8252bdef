/* The phases of the fluid in a step: they move with the velocity, and momentum with their mass (phases/README.md).
 *
 *     u in the middle of the step, free of divergence --> fluxes F, beta --> V^{n+1}, swept volumes
 *       --> rho, mu of the elements at t^{n+1}          rho = sum of rho_p V_p/|K|
 *           mass flux m, sum_f m_f = -(rho^{n+1} - rho^n) |K|/dt to round-off
 *           R^-1 and the weight of cut elements          effective_density.h */
#ifndef FLUID_PHASE_TRANSPORT_H
#define FLUID_PHASE_TRANSPORT_H
#include "common/output/checkpoint.h"
#include "common/transfer/transfer.h"
#include "fluid/discretization/domain.h"
#include "fluid/phases/phases.h"
#include "fluid/phases/region.h"

typedef struct PhaseTransport_s *PhaseTransport;

/* n = 0: one fluid, whose density and viscosity are elsewhere. */
typedef struct {
  int n;
  double rho[PHASES_MAX], mu[PHASES_MAX]; /* kg/m3, Pa s */
  PhasesPairs surface_tension;            /* N/m */
  PhasesPairs solid_cosine; /* of contact angles at solids, through the first phase of each pair */
  PhasesAdvection advection;
  EquationOfState state[PHASES_MAX];   /* pressure 0: incompressible, of density rho */
  double initial_pressure[PHASES_MAX]; /* of gases, Pa: what their densities are those of at the start */
  char name[PHASES_MAX][32];
} PhaseProperties;

const PhaseProperties *PhaseTransportProperties(PhaseTransport t);
/* The lightest phase, which fills solids, the heaviest; whether any two have surface tension.  Not collective. */
int PhaseLightest(const PhaseProperties *properties);
int PhaseHeaviest(const PhaseProperties *properties);
PetscBool PhaseHasTension(const PhaseProperties *properties);
/* Of element e: the density of the phase that fills solids, and the mean density of its other phases, 0 where it has none, kg/m3.
 * Not collective. */
void PhaseTransportBesideSolid(PhaseTransport t, int e, double *inside, double *beside);
/* Whether any phase is compressible. */
PetscBool PhaseHasGas(const PhaseProperties *properties);
/* Without volumes; domain is borrowed.  Collective, like all that says nothing else. */
PetscErrorCode PhaseTransportCreate(const FluidDomain *domain, const PhaseProperties *properties,
                                    const double gravity[2], PhaseTransport *t);
PetscErrorCode PhaseTransportDestroy(PhaseTransport *t);
/* Between two steps: the gravity of the coming one, m/s2. */
PetscErrorCode PhaseTransportSetGravity(PhaseTransport t, const double gravity[2]);
/* The initial state; errors of PhasesFill. */
PetscErrorCode PhaseTransportFill(PhaseTransport t, int nregions, const Region region[]);
/* At the run's start: the lightest phase takes the place of heavier ones where the solid is, solid[ne] = alpha_s, centre[ne][2] the mean of x over
 * its part of an element where that is some, but not all.  In an element that its surface crosses that is what the line of cut_of_moment.h cuts off, so
 * that regions may end at a solid's faces; where it is another shape, the element keeps no more than fits beside it. */
PetscErrorCode PhaseTransportStartSolid(PhaseTransport t, const double solid[], const double centre[][2]);
/* The volumes from those on another mesh. */
PetscErrorCode PhaseTransportRemap(PhaseTransport from, Transfer transfer, PhaseTransport to);
/* From t^n over dt along u[ne][6], m/s, extrapolated from t^n by `extrapolated` times the step before, dt_before; prescribed
 * velocities are extrapolated likewise.  mass_flux[ne][6]: m, kg/(m2 s), is written. */
typedef struct {
  double time, dt;                /* t^n, s */
  double extrapolated, dt_before; /* u = u^n + extrapolated (u^n - u^{n-1}) */
  const double *u;
  const double *solid;    /* [ne] alpha_s: heavier phases stay out of it; NULL: none */
  const char *moves;      /* [ne] whether it moves freely; read with surface tension only */
  const double *pressure; /* [ne] at t^n, Pa; read with compressible phases only */
  double *mass_flux;
} PhaseStep;
PetscErrorCode PhaseTransportStep(PhaseTransport t, const PhaseStep *step);
/* rho[ne], kg/m3, and mu[ne], Pa s, of the owned elements.  Not collective. */
void PhaseTransportMaterial(PhaseTransport t, double rho[], double mu[]);
/* How elements respond to a pressure gradient, [ne], borrowed: in the middle of the last step.  Not collective. */
const InverseDensity *PhaseTransportInverseDensity(PhaseTransport t);
/* Until the next step element e has one density, rho, kg/m3.  Where a solid covers the part alpha of it and leaves PHASES_LEAST_OPEN, its weight is that which the pressure of
 * still water bears, as without a solid (effective_density.h); remainder, N/m3: what the water beside the solid, if it filled all of the element, would weigh beyond that, else 0; it acts on
 * the solid.  Not collective. */
void PhaseTransportSetUniform(PhaseTransport t, int e, double rho, double alpha, double remainder[2]);
/* From now on, until the next step, it is that of its end; the density's revision is the caller's affair. */
void PhaseTransportSettle(PhaseTransport t);
/* Volumes, m2, [ne][n], borrowed; the number of phases.  Not collective. */
const double *PhaseTransportVolumes(PhaseTransport t, int *n);
Phases PhaseTransportPhases(PhaseTransport t);
/* What has become of each phase since the run's start, m2, of compressible ones kg: volume + out - initial is what adaptation and the pressure's solution
 * have made of it. */
typedef struct {
  double initial[PHASES_MAX], out[PHASES_MAX]; /* at the start; what has left through the boundary, net */
  double volume[PHASES_MAX];                   /* what there is */
  double
      gap; /* sum over the elements of |sum of the volumes - area|, m2: what fluxes with a divergence have made */
} PhaseBudget;
PetscErrorCode PhaseTransportBudget(PhaseTransport t, PhaseBudget *budget);
/* For a step that is redone. */
PetscErrorCode PhaseTransportSaveState(PhaseTransport t);
PetscErrorCode PhaseTransportRestoreState(PhaseTransport t);
/* To and from a checkpoint, in which phases have their names: they may come in another order, not with other names, and stay compressible or not. */
PetscErrorCode PhaseTransportSave(PhaseTransport t, Checkpoint to);
PetscErrorCode PhaseTransportLoad(PhaseTransport t, const PetscInt row[], Checkpoint from);
#endif
