#include "fluid/transport/phase_sweep.h"
#include "fluid/phases/flux.h"
#include "fluid/transport/phase_solid.h"

/* Outflow from an element near an interface in one go, as a share of its area. */
#define COURANT_MAX 0.9

struct PhaseSweep_s {
  const FluidDomain *domain; /* borrowed, like what follows */
  const PhaseProperties *properties;
  const Stars *stars;
  PhaseBoundaries *boundaries;
  Phases phases;
  double *flux, *beta, *velocity; /* [ne][3], [ne][6], [ne][3][2] of the step */
  double *swept, *part;           /* [ne][3][n] of the step and of its part, m2 */
  double *mass, *mass_part;       /* the same of compressible phases, kg */
  double *weight, *solid;         /* [nl] of fluxes' divergence; the solid's share */
  double *expected;               /* [nl][n] densities, kg/m3 */
  int *single;                    /* [nl] at the start of the step */
};

PetscErrorCode PhaseSweepCreate(const FluidDomain *domain, const PhaseProperties *properties,
                                const Stars *stars, PhaseBoundaries *boundaries, Phases phases,
                                PhaseSweep *sweep)
{
  const int n = properties->n, ne = stars->ne;
  PhaseSweep s;
  PetscFunctionBeginUser;
  PetscCall(PetscNew(&s));
  s->domain = domain;
  s->properties = properties;
  s->stars = stars;
  s->boundaries = boundaries;
  s->phases = phases;
  PetscCall(PetscMalloc3(3 * ne, &s->flux, 6 * ne, &s->beta, 6 * ne, &s->velocity));
  PetscCall(PetscMalloc3(3 * n * ne, &s->swept, 3 * n * ne, &s->part, stars->nl, &s->single));
  if (PhaseHasGas(properties))
    PetscCall(PetscMalloc5(3 * n * ne + 1, &s->mass, 3 * n * ne, &s->mass_part, stars->nl, &s->weight,
                           stars->nl, &s->solid, n * stars->nl, &s->expected));
  *sweep = s;
  PetscFunctionReturn(0);
}

PetscErrorCode PhaseSweepDestroy(PhaseSweep *sweep)
{
  PhaseSweep s = *sweep;
  PetscFunctionBeginUser;
  if (!s) PetscFunctionReturn(0);
  PetscCall(PetscFree3(s->flux, s->beta, s->velocity));
  PetscCall(PetscFree3(s->swept, s->part, s->single));
  PetscCall(PetscFree5(s->mass, s->mass_part, s->weight, s->solid, s->expected));
  PetscCall(PetscFree(*sweep));
  PetscFunctionReturn(0);
}

static int NearInterface(PhaseSweep s, int e)
{
  if (s->single[e] < 0) return 1;
  for (int i = 0; i < 3; i++) {
    const int o = s->stars->neighbor[e][i];
    if (o >= 0 && s->single[o] != s->single[e]) return 1;
  }
  return 0;
}

/* Into how many parts the step is divided, so that no element near an interface loses more than its content. */
static PetscErrorCode CountParts(PhaseSweep s, double dt, int *parts)
{
  double courant = 0.0;
  PetscFunctionBeginUser;
  for (int e = 0; e < s->stars->ne; e++) {
    if (!NearInterface(s, e)) continue;
    double out = 0.0;
    for (int i = 0; i < 3; i++) out += fmax(s->flux[3 * e + i], 0.0);
    courant = fmax(courant, out * dt / s->domain->geometry[e].area);
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &courant, 1, MPI_DOUBLE, MPI_MAX, s->domain->mesh->comm));
  *parts = (int)fmax(1.0, ceil(courant / COURANT_MAX));
  PetscFunctionReturn(0);
}

/* Adds what this step has swept through the boundary. */
static PetscErrorCode AddOut(PhaseSweep s, double total[])
{
  const int n = s->properties->n;
  double out[PHASES_MAX] = {0.0};
  PetscFunctionBeginUser;
  for (int k = 0; k < 3 * s->stars->ne; k++)
    for (int p = 0; p < n && s->domain->mesh->neighbor[k] < 0; p++)
      out[p] += s->properties->state[p].pressure > 0.0 ? s->mass[k * n + p] : s->swept[k * n + p];
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, out, n, MPI_DOUBLE, MPI_SUM, s->domain->mesh->comm));
  for (int p = 0; p < n; p++) total[p] += out[p];
  PetscFunctionReturn(0);
}

static PetscErrorCode Advect(PhaseSweep s, double dt)
{
  const int n = 3 * s->properties->n * s->stars->ne;
  const PhasesInflow inflow = {(const double(*)[PHASES_MAX])s->boundaries->inflow, s->boundaries->levels,
                               s->mass ? s->expected : NULL};
  int parts;
  PetscFunctionBeginUser;
  PetscCall(CountParts(s, dt, &parts));
  PetscCall(PetscArrayzero(s->swept, n));
  if (s->mass) PetscCall(PetscArrayzero(s->mass, n));
  for (int k = 0; k < parts; k++) {
    if (k) PetscCall(PhasesReconstruct(s->phases));
    PetscCall(PhasesAdvect(s->phases, dt / parts, s->flux, s->velocity, &inflow, s->part, s->mass_part));
    for (int i = 0; i < n; i++) s->swept[i] += s->part[i];
    for (int i = 0; i < n && s->mass; i++) s->mass[i] += s->mass_part[i];
    if (s->mass) PetscCall(PhasesFillGaps(s->phases, s->expected, s->swept));
  }
  PetscFunctionReturn(0);
}

/* With the masses of compressible phases, which move with what is exchanged. */
static PetscErrorCode LeaveSolid(PhaseSweep s, const double solid[])
{
  PetscFunctionBeginUser;
  if (s->mass) {
    PetscCall(PhasesUpdateDensities(s->phases));
    PetscCall(PetscArraycpy(s->part, s->swept, 3 * s->properties->n * s->stars->ne));
  }
  PetscCall(PhaseLeaveSolid(s->properties, s->stars, s->phases, solid, s->swept));
  if (s->mass) PetscCall(PhasesMoveMasses(s->phases, s->part, s->swept, s->mass));
  PetscFunctionReturn(0);
}

/* Where the flow may have a divergence, and the densities that compressible phases should have about. */
static PetscErrorCode SetGas(PhaseSweep s, const PhaseStep *step)
{
  const int n = s->properties->n;
  double pressure;
  PetscFunctionBeginUser;
  PetscCall(PetscArrayzero(s->solid, s->stars->nl));
  if (step->solid) PetscCall(PetscArraycpy(s->solid, step->solid, s->stars->ne));
  PetscCall(StarsExchange(s->stars, sizeof *s->solid, s->solid));
  for (int e = 0; e < s->stars->nl; e++)
    s->weight[e] = StarsArea(s->stars, e) *
                   PhasesCompressibility(s->phases, e, s->solid[e], PhaseLightest(s->properties), &pressure);
  for (int k = 0; k < n * s->stars->ne; k++) {
    const EquationOfState *state = &s->properties->state[k % n];
    s->expected[k] = state->pressure > 0.0 ? GasDensity(state, step->pressure[k / n]) : state->density;
    if (s->solid[k / n] > 0.0) s->expected[k] = PhasesDensities(s->phases)[k];
  }
  PetscCall(StarsExchange(s->stars, (size_t)n * sizeof *s->expected, s->expected));
  PetscFunctionReturn(0);
}

PetscErrorCode PhaseSweepStep(PhaseSweep s, const PhaseStep *step, double out[])
{
  const FluxBoundary boundary = {s->boundaries->open, s->boundaries->moment, s->weight};
  PetscFunctionBeginUser;
  PhaseBoundariesSetStep(s->boundaries, step);
  if (s->mass) PetscCall(SetGas(s, step));
  PetscCall(FluxEquilibrate(s->stars, step->u, &boundary, s->flux, s->beta, NULL));
  PetscCall(FluxVertexVelocity(s->stars, s->beta, s->velocity));
  for (int e = 0; e < s->stars->nl; e++) s->single[e] = PhasesSingle(s->phases, e);
  PetscCall(Advect(s, step->dt));
  PetscCall(AddOut(s, out));
  if (step->solid) PetscCall(LeaveSolid(s, step->solid));
  PetscFunctionReturn(0);
}

/* The phase that alone lies on both sides of face i of e before and after the step and passes it, or -1. */
static int PhaseOfFace(PhaseSweep s, int e, int i)
{
  const int o = s->stars->neighbor[e][i], p = s->single[e], n = s->properties->n;
  if (p < 0 || PhasesSingle(s->phases, e) != p) return -1;
  if (o >= 0 && (s->single[o] != p || PhasesSingle(s->phases, o) != p)) return -1;
  for (int q = 0; q < n; q++)
    if (q != p && s->swept[(3 * e + i) * n + q] != 0.0) return -1;
  return p;
}

/* m with the masses that passed the faces: linear along a face inside a phase, else constant. */
void PhaseSweepMassFlux(PhaseSweep s, const PhaseStep *step)
{
  const int n = s->properties->n;
  const double *rho = s->properties->rho;
  for (int e = 0; e < s->stars->ne; e++) {
    const StarElement *element = &s->stars->element[e];
    double normal[3][2];
    for (int i = 0; i < 3; i++) {
      const int p = PhaseOfFace(s, e, i);
      double length, mass = 0.0;
      FluxNormalParts(element, &s->beta[6 * e], i, normal[i], &length);
      double density = p >= 0 ? rho[p] : 0.0;
      for (int q = 0; q < n; q++) {
        const int k = (3 * e + i) * n + q;
        const PetscBool gas = (PetscBool)(s->properties->state[q].pressure > 0.0);
        mass += gas ? s->mass[k] : rho[q] * s->swept[k];
        if (gas && q == p && s->swept[k] != 0.0) density = s->mass[k] / s->swept[k];
      }
      for (int k = 0; k < 2; k++) normal[i][k] = p >= 0 ? density * normal[i][k] : mass / (step->dt * length);
    }
    FluxLinearField(element, (const double(*)[2])normal, &step->mass_flux[6 * e]);
  }
}
