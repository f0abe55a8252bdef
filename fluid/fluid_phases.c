/* What a fluid of several phases does differently. */
#include "fluid/fluid_impl.h"

/* Density and viscosity of the phases as they are. */
static PetscErrorCode SetPhaseMaterial(Fluid f, MaterialLevel level)
{
  double *rho, *mu;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(f->domain.mesh->ne, &rho, f->domain.mesh->ne, &mu));
  PhaseTransportMaterial(f->phases, rho, mu);
  PetscCall(MaterialSet(f->material, level, rho, mu));
  PetscCall(PetscFree2(rho, mu));
  PetscFunctionReturn(0);
}

PetscErrorCode FluidPhasesChanged(Fluid f)
{
  PetscFunctionBeginUser;
  PetscCall(SetPhaseMaterial(f, MATERIAL_OLD));
  PetscCall(SetPhaseMaterial(f, MATERIAL_NEW));
  PetscFunctionReturn(0);
}

PetscErrorCode FluidSetPhases(Fluid f, int nregions, const Region region[])
{
  PetscFunctionBeginUser;
  PetscCall(PhaseTransportFill(f->phases, nregions, region));
  PetscCall(FluidPhasesChanged(f));
  PetscFunctionReturn(0);
}

PetscErrorCode FluidMovePhases(Fluid f, double dt, double s)
{
  PhaseStep step = {.time = f->t, .dt = dt, .extrapolated = s, .dt_before = f->dt_previous};
  const size_t n = 6 * (size_t)f->domain.mesh->ne;
  PetscScalar *flux;
  double *u;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(n, &u));
  PetscCall(VecGetArray(f->mass_flux, &flux));
  PetscCall(PetscArraycpy(u, flux, n));
  step.u = u;
  step.mass_flux = flux;
  PetscCall(PhaseTransportStep(f->phases, &step));
  PetscCall(VecRestoreArray(f->mass_flux, &flux));
  PetscCall(PetscFree(u));
  PetscCall(SetPhaseMaterial(f, MATERIAL_NEW));
  PetscFunctionReturn(0);
}

const InverseDensity *FluidInverseDensity(Fluid f)
{
  return f->phases ? PhaseTransportInverseDensity(f->phases) : NULL;
}

/* velocity = dt (weight - R^-1 grad p) */
static PetscErrorCode Accelerate(Fluid f, double dt, Vec velocity)
{
  const Mesh *m = f->domain.mesh;
  const InverseDensity *r = FluidInverseDensity(f);
  const PetscScalar *p;
  PetscScalar *u;
  Vec local;
  PetscFunctionBeginUser;
  PetscCall(VecGhostGetLocalForm(f->p, &local));
  PetscCall(VecGetArrayRead(local, &p));
  PetscCall(VecGetArrayWrite(velocity, &u));
  for (int e = 0; e < m->ne; e++) {
    const double *k = r[e].inverse;
    double pe[6], grad[3][2];
    for (int i = 0; i < 6; i++) pe[i] = p[f->domain.p2->node[6 * e + i]];
    P2Gradient((const double(*)[2])f->domain.geometry[e].g, pe, grad);
    for (int i = 0; i < 3; i++) {
      u[6 * e + i] = dt * (r[e].weight[0] - k[0] * grad[i][0] - k[1] * grad[i][1]);
      u[6 * e + 3 + i] = dt * (r[e].weight[1] - k[1] * grad[i][0] - k[2] * grad[i][1]);
    }
  }
  PetscCall(VecRestoreArrayWrite(velocity, &u));
  PetscCall(VecRestoreArrayRead(local, &p));
  PetscCall(VecGhostRestoreLocalForm(f->p, &local));
  PetscFunctionReturn(0);
}

PetscErrorCode FluidBalancePressure(Fluid f)
{
  const double dt = 1e8; /* large: what prescribed velocities contribute goes with 1/dt */
  const ProjectionStep step = FluidProjectionStep(f, f->t, dt, PETSC_FALSE);
  Vec velocity, phi;
  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(f->u, &velocity));
  PetscCall(Accelerate(f, dt, velocity));
  PetscCall(ProjectionSolverSolve(f->projection, &step, velocity, &phi, &f->stats.pressure_iterations));
  PetscCall(VecDestroy(&velocity));
  PetscCall(VecAXPY(f->p, 1.0, phi));
  PetscCall(VecGhostUpdateBegin(f->p, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecGhostUpdateEnd(f->p, INSERT_VALUES, SCATTER_FORWARD));
  PetscFunctionReturn(0);
}
