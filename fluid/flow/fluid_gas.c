/* What a fluid with compressible phases does differently. */
#include "fluid/flow/fluid_impl.h"

PetscErrorCode FluidMeanPressure(Fluid f, double **pressure)
{
  const int ne = f->domain.mesh->ne, *node = f->domain.p2->node;
  const double *p = FluidPressure(f);
  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(ne + 1, pressure));
  for (int k = 0; k < 3 * ne; k++) (*pressure)[k / 3] += p[node[6 * (k / 3) + 3 + k % 3]] / 3.0;
  PetscFunctionReturn(0);
}

static double ElementCompressibility(Fluid f, int e, double *pressure)
{
  return PhasesCompressibility(PhaseTransportPhases(f->phases), e, SolidCouplingFraction(f->solid)[e],
                               PhaseLightest(&f->setup.phases), pressure);
}

void FluidSetTarget(Fluid f, double old)
{
  const int *node = f->domain.p2->node;
  const double *p = FluidPressure(f);
  for (int e = 0; e < f->domain.mesh->ne && f->compressible; e++) {
    CompressibleElement *c = &f->compressible[e];
    c->share = ElementCompressibility(f, e, &c->state) > 0.0 ? 1.0 - old : 0.0;
    for (int k = 0; k < 6; k++) c->target[k] = (1.0 - c->share) * p[node[6 * e + k]] + c->share * c->state;
  }
}

void FluidSetCompressibility(Fluid f)
{
  for (int e = 0; e < f->domain.mesh->ne && f->compressible; e++) {
    CompressibleElement *c = &f->compressible[e];
    double state;
    c->beta = ElementCompressibility(f, e, &state);
    if (c->beta == 0.0) continue;
    for (int k = 0; k < 6; k++) c->target[k] += 0.5 * c->share * (state - c->state);
  }
}

/* Of beta over its element's coefficient: leaves about its inverse of the divergence's pressure. */
#define LEAVE 1e6

PetscErrorCode FluidLeaveCompressible(Fluid f)
{
  const InverseDensity *r = FluidInverseDensity(f);
  PetscFunctionBeginUser;
  for (int e = 0; e < f->domain.mesh->ne; e++) {
    double own;
    CompressibleElement *c = &f->compressible[e];
    c->beta = ElementCompressibility(f, e, &own);
    if (c->beta > 0.0) c->beta = LEAVE * (r[e].inverse[0] + r[e].inverse[2]) / f->domain.geometry[e].area;
  }
  PetscFunctionReturn(0);
}

/* Of element e the mass of phase p, kg, and its volume, m2. */
static double PhaseMass(Fluid f, int e, int p, double *volume)
{
  const PhaseProperties *properties = PhaseTransportProperties(f->phases);
  int n;
  *volume = PhaseTransportVolumes(f->phases, &n)[properties->n * e + p];
  return properties->state[p].pressure > 0.0
             ? PhasesMasses(PhaseTransportPhases(f->phases))[properties->n * e + p]
             : properties->rho[p] * *volume;
}

PetscErrorCode FluidCheckDensity(Fluid f, const double rho[])
{
  const PhaseProperties *properties = PhaseTransportProperties(f->phases);
  PetscFunctionBeginUser;
  for (int e = 0; e < f->domain.mesh->ne; e++) {
    const Mesh *m = f->domain.mesh;
    double center[2] = {0.0, 0.0}, volume;
    int least = 0;
    if (rho[e] > 0.0) continue;
    for (int p = 1; p < properties->n; p++)
      if (PhaseMass(f, e, p, &volume) < PhaseMass(f, e, least, &volume)) least = p;
    const double mass = PhaseMass(f, e, least, &volume);
    for (int k = 0; k < 6; k++) center[k % 2] += m->x[2 * m->vertex[3 * e + k / 2] + k % 2] / 3.0;
    SETERRQ(PETSC_COMM_SELF, PETSC_ERR_ARG_OUTOFRANGE,
            "phase '%s' has %g kg and %g m2 of the element at (%.4g, %.4g), which has a density of %g "
            "kg/m3%s: expected more than "
            "0; take shorter steps (time.cfl, time.dt_max) or smaller elements there (fluid.adapt.size_min)",
            properties->name[least], mass, volume, center[0], center[1], rho[e],
            properties->state[least].pressure > 0.0 ? " (an absolute pressure below 0)" : "");
  }
  PetscFunctionReturn(0);
}
