#include "fluid/transport/phase_transport_impl.h"

/* Of an element, less than which of a phase is none. */
#define SLIVER 1e-12

int PhaseLightest(const PhaseProperties *p)
{
  int lightest = 0;
  for (int k = 1; k < p->n; k++)
    if (p->rho[k] < p->rho[lightest]) lightest = k;
  return lightest;
}

int PhaseHeaviest(const PhaseProperties *p)
{
  int heaviest = 0;
  for (int k = 1; k < p->n; k++)
    if (p->rho[k] > p->rho[heaviest]) heaviest = k;
  return heaviest;
}

PetscBool PhaseHasGas(const PhaseProperties *p)
{
  for (int k = 0; k < p->n; k++)
    if (p->state[k].pressure > 0.0) return PETSC_TRUE;
  return PETSC_FALSE;
}

PetscBool PhaseHasTension(const PhaseProperties *p)
{
  for (int k = 0; k < p->n; k++)
    for (int j = 0; j < k; j++)
      if (p->surface_tension.value[j][k] != 0.0) return PETSC_TRUE;
  return PETSC_FALSE;
}

/* --- life ----------------------------------------------------------------------------------------------- */

PetscErrorCode PhaseTransportCreate(const FluidDomain *domain, const PhaseProperties *properties,
                                    const double gravity[2], PhaseTransport *transport)
{
  const Mesh *m = domain->mesh;
  const int n = properties->n;
  PhaseTransport t;
  PetscFunctionBeginUser;
  PetscCall(PetscNew(&t));
  t->domain = domain;
  t->properties = *properties;
  for (int c = 0; c < 2; c++) t->gravity[c] = gravity[c];
  PetscCall(StarsCreate(m, &t->stars));
  PetscCall(PhasesCreate(t->stars, n, &t->phases));
  PhasesSetAdvection(t->phases, properties->advection);
  for (int k = 0; k < n; k++) t->properties.state[k].density = properties->rho[k];
  if (PhaseHasGas(properties)) PetscCall(PhasesSetStates(t->phases, t->properties.state));
  PetscCall(PhaseBoundariesCreate(domain, &t->properties, gravity, &t->boundaries));
  PetscCall(PhaseTensionCreate(t->stars, &t->properties, &t->boundaries, &t->tension));
  PetscCall(PhaseSweepCreate(domain, &t->properties, t->stars, &t->boundaries, t->phases, &t->sweep));
  /* one more inverse density: not NULL on ranks without elements */
  PetscCall(PetscMalloc6(m->ne, &t->begin, m->ne, &t->end, m->ne + 1, &t->inverse_density,
                         (size_t)n * (size_t)m->ne, &t->saved, (size_t)n * (size_t)m->ne, &t->saved_mass,
                         m->ne, &t->saved_solid));
  *transport = t;
  PetscFunctionReturn(0);
}

PetscErrorCode PhaseTransportDestroy(PhaseTransport *transport)
{
  PhaseTransport t = *transport;
  PetscFunctionBeginUser;
  if (!t) PetscFunctionReturn(0);
  PetscCall(PhaseTensionDestroy(&t->tension));
  PetscCall(PhaseSweepDestroy(&t->sweep));
  PetscCall(PhaseBoundariesDestroy(&t->boundaries));
  PetscCall(PhasesDestroy(&t->phases));
  PetscCall(StarsDestroy(&t->stars));
  PetscCall(PetscFree6(t->begin, t->end, t->inverse_density, t->saved, t->saved_mass, t->saved_solid));
  PetscCall(PetscFree(*transport));
  PetscFunctionReturn(0);
}

/* volume[n], m2, of compressible phases mass, kg, of all ranks. */
PetscErrorCode PhaseTransportSumVolumes(PhaseTransport t, double volume[])
{
  int n;
  const double *v = PhaseTransportVolumes(t, &n), *mass = PhasesMasses(t->phases);
  PetscFunctionBeginUser;
  PetscCall(PetscArrayzero(volume, n));
  for (int k = 0; k < n * t->stars->ne; k++)
    volume[k % n] += t->properties.state[k % n].pressure > 0.0 ? mass[k] : v[k];
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, volume, n, MPI_DOUBLE, MPI_SUM, t->domain->mesh->comm));
  PetscFunctionReturn(0);
}

/* Of all ranks, m2. */
static PetscErrorCode SumGap(PhaseTransport t, double *gap)
{
  int n;
  const double *v = PhaseTransportVolumes(t, &n);
  PetscFunctionBeginUser;
  *gap = 0.0;
  for (int e = 0; e < t->stars->ne; e++) {
    double more = -t->domain->geometry[e].area;
    for (int p = 0; p < n; p++) more += v[n * e + p];
    *gap += fabs(more);
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, gap, 1, MPI_DOUBLE, MPI_SUM, t->domain->mesh->comm));
  PetscFunctionReturn(0);
}

/* --- state ---------------------------------------------------------------------------------------------- */

/* How elements respond at the end of the step. */
static PetscErrorCode SetEnd(PhaseTransport t)
{
  PetscFunctionBeginUser;
  PetscCall(PhasesGetInverseDensity(t->phases, t->properties.rho, t->gravity, t->end));
  PetscCall(PhaseTensionAdd(t->tension, t->phases, t->end));
  PhaseTransportSettle(t);
  PetscFunctionReturn(0);
}

PetscErrorCode PhaseTransportSetGravity(PhaseTransport t, const double gravity[2])
{
  PetscFunctionBeginUser;
  PetscCall(PetscArraycpy(t->gravity, gravity, 2));
  PetscCall(SetEnd(t));
  PetscFunctionReturn(0);
}

PetscErrorCode PhaseTransportSetSolid(PhaseTransport t, const double alpha[], const char moves[])
{
  int any = PhasesSolid(t->phases) != NULL;
  PetscFunctionBeginUser;
  for (int e = 0; e < t->stars->ne; e++) any |= alpha[e] > 0.0;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &any, 1, MPI_INT, MPI_LOR, t->domain->mesh->comm));
  if (!any) PetscFunctionReturn(0);
  PetscCall(PhasesSetSolid(t->phases, PhaseLightest(&t->properties), alpha));
  PetscCall(PhaseTensionSetSolid(t->tension, moves));
  PetscFunctionReturn(0);
}

PetscErrorCode PhaseTransportReconstruct(PhaseTransport t)
{
  PetscFunctionBeginUser;
  PetscCall(PhasesReconstruct(t->phases));
  PetscCall(SetEnd(t));
  PetscFunctionReturn(0);
}

void PhaseTransportSetUniform(PhaseTransport t, int e, double rho, double alpha, double remainder[2])
{
  const double *g = t->gravity,
               beside = fmax(rho - alpha * t->properties.rho[PhaseLightest(&t->properties)], 0.0);
  InverseDensity *r = &t->inverse_density[e];
  const double surface[2] = {r->surface[0], r->surface[1]};
  double borne[2];
  InverseDensityBears(r, borne);
  InverseDensityUniform(rho, g, r);
  remainder[0] = remainder[1] = 0.0;
  for (int c = 0; c < 2 && alpha < 1.0 - PHASES_LEAST_OPEN; c++) {
    remainder[c] = beside / (1.0 - alpha) * g[c] - borne[c];
    r->weight[c] -= remainder[c] / rho;
  }
  if (PhaseHasTension(&t->properties)) InverseDensityAddSurface(surface, r);
}

void PhaseTransportSettle(PhaseTransport t)
{
  for (int e = 0; e < t->stars->ne; e++) t->inverse_density[e] = t->end[e];
}

void PhaseTransportMaterial(PhaseTransport t, double rho[], double mu[])
{
  int n;
  const double *volume = PhaseTransportVolumes(t, &n);
  for (int e = 0; e < t->stars->ne; e++) {
    const double area = t->domain->geometry[e].area;
    rho[e] = mu[e] = 0.0;
    for (int p = 0; p < n; p++) {
      const double *mass = PhasesMasses(t->phases);
      if (t->properties.state[p].pressure > 0.0)
        rho[e] += mass[n * e + p] / area;
      else
        rho[e] += t->properties.rho[p] * volume[n * e + p] / area;
      mu[e] += t->properties.mu[p] * volume[n * e + p] / area;
    }
    if (mu[e] < 0.0) mu[e] = 0.0;
  }
}

void PhaseTransportBesideSolid(PhaseTransport t, int e, double *inside, double *beside)
{
  const int light = PhaseLightest(&t->properties);
  double mass = 0.0, sum = 0.0;
  int n;
  const double *volume = PhaseTransportVolumes(t, &n) + t->properties.n * e;
  for (int p = 0; p < n; p++)
    if (p != light) {
      mass += t->properties.rho[p] * fmax(volume[p], 0.0);
      sum += fmax(volume[p], 0.0);
    }
  *inside = t->properties.rho[light];
  *beside = sum > SLIVER * t->domain->geometry[e].area ? mass / sum : 0.0;
}

const PhaseProperties *PhaseTransportProperties(PhaseTransport t)
{
  return &t->properties;
}

const InverseDensity *PhaseTransportInverseDensity(PhaseTransport t)
{
  return t->inverse_density;
}

const double *PhaseTransportVolumes(PhaseTransport t, int *n)
{
  const double *volume = NULL;
  *n = t->properties.n;
  (void)PhasesGetVolumes(t->phases, &volume);
  return volume;
}

Phases PhaseTransportPhases(PhaseTransport t)
{
  return t->phases;
}

PetscErrorCode PhaseTransportBudget(PhaseTransport t, PhaseBudget *budget)
{
  PetscFunctionBeginUser;
  *budget = t->budget;
  PetscCall(PhaseTransportSumVolumes(t, budget->volume));
  PetscCall(SumGap(t, &budget->gap));
  PetscFunctionReturn(0);
}

/* --- the step ------------------------------------------------------------------------------------------- */

PetscErrorCode PhaseTransportStep(PhaseTransport t, const PhaseStep *s)
{
  PetscFunctionBeginUser;
  if (s->solid) PetscCall(PhaseTransportSetSolid(t, s->solid, s->moves));
  if (PhasesSolid(t->phases)) PetscCall(SetEnd(t)); /* with the solid of this step */
  for (int e = 0; e < t->stars->ne; e++) t->begin[e] = t->end[e];
  PetscCall(PhaseSweepStep(t->sweep, s, t->budget.out));
  PetscCall(PhaseTransportReconstruct(t));
  for (int e = 0; e < t->stars->ne; e++)
    InverseDensityMiddle(&t->begin[e], &t->end[e], &t->inverse_density[e]);
  PhaseSweepMassFlux(t->sweep, s);
  PetscFunctionReturn(0);
}
