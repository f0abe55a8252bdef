/* Viscosity beside the interface of fluid that is nearly at rest.
 *
 * What upwinding takes from a flow goes with its speed: from water that stands nothing.  There waves as short as an element, of which the volumes of elements,
 * the vertices' distances (phases/effective_density.h) and the extrapolation in time know too little, grow until they are fast enough for upwinding to end
 * them, at some 0.1 m/s in elements of 5 cm (tests/phases/README.md, "Still water").  So elements that are cut, and those on the other side of their faces, have at least
 *
 *     nu  =  h max(DAMPING c - |u|, 0),     c  =  sqrt(g h [rho]/(rho_1 + rho_2)),     h^2 twice an element's area,
 *
 * in the momentum equation alone: what upwinding would have in a flow of 2 (DAMPING c - |u|).  c/sqrt(pi) is the speed of waves of length 2 h, u the element's mean velocity. */
#include "fluid/discretization/ghosted.h"
#include "fluid/flow/fluid_impl.h"

/* Half of it leaves waves that grow in some meshes; twice as much slows resolved waves by 1e-3. */
#define DAMPING 0.05
/* Of an element, less than which of a phase beside a solid, or without one, makes no interface. */
#define LEAST 1e-2

static double Speed(const double u[6])
{
  return hypot(u[0] + u[1] + u[2], u[3] + u[4] + u[5]) / 3.0;
}

/* Of the densities that element e has beside the solid, over their sum: that of an interface there, not of what fills a solid. */
static double ContrastIn(Fluid f, int e, double solid)
{
  const PhaseProperties *phases = &f->setup.phases;
  const double area = f->domain.geometry[e].area;
  const int filler = PhaseLightest(phases);
  double low = HUGE_VAL, high = 0.0;
  int n;
  const double *volume = PhaseTransportVolumes(f->phases, &n) + (size_t)e * (size_t)phases->n;
  for (int p = 0; p < n; p++) {
    if (volume[p] - (p == filler ? solid * area : 0.0) < LEAST * area) continue;
    low = fmin(low, phases->rho[p]);
    high = fmax(high, phases->rho[p]);
  }
  return high > low ? (high - low) / (high + low) : 0.0;
}

/* contrast[ne + ng], of elements with a line; 0 elsewhere. */
static PetscErrorCode SetContrast(Fluid f, Vec contrast)
{
  const double *solid = SolidCouplingFraction(f->solid);
  Phases phases = PhaseTransportPhases(f->phases);
  PetscScalar *a;
  PetscFunctionBeginUser;
  PetscCall(VecGetArrayWrite(contrast, &a));
  for (int e = 0; e < f->domain.mesh->ne; e++)
    a[e] = PhasesSingle(phases, e) < 0 && !PhasesSpread(phases, e) ? ContrastIn(f, e, solid[e]) : 0.0;
  PetscCall(VecRestoreArrayWrite(contrast, &a));
  PetscCall(GhostedUpdate(contrast));
  PetscFunctionReturn(0);
}

PetscErrorCode FluidDampInterface(Fluid f, const double u[])
{
  const Mesh *m = f->domain.mesh;
  const double *rho = MaterialDensity(f->material, MATERIAL_STEP),
               g = hypot(f->setup.gravity[0], f->setup.gravity[1]);
  const PetscScalar *a;
  double *least;
  Vec contrast;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(m->ne, &least));
  PetscCall(VecDuplicate(f->outside, &contrast));
  PetscCall(SetContrast(f, contrast));
  PetscCall(GhostedGetArrayRead(contrast, &a));
  for (int e = 0; e < m->ne; e++) {
    const double h = sqrt(2.0 * f->domain.geometry[e].area);
    double largest = a[e];
    for (int i = 0; i < 3; i++) {
      const int nb = m->neighbor[3 * e + i];
      if (nb >= 0) largest = fmax(largest, a[nb]);
    }
    least[e] = rho[e] * h * fmax(DAMPING * sqrt(g * h * largest) - Speed(u + 6 * e), 0.0);
  }
  PetscCall(GhostedRestoreArrayRead(contrast, &a));
  PetscCall(MaterialRaiseViscosity(f->material, least));
  PetscCall(VecDestroy(&contrast));
  PetscCall(PetscFree(least));
  PetscFunctionReturn(0);
}
