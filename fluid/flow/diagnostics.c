/* What is measured of a flow: the step that it allows, momentum, energy. */
#include "fluid/flow/fluid_impl.h"

PetscErrorCode FluidMomentumTotal(Fluid f, double momentum[2], double *energy)
{
  const PetscScalar *u;
  double sum[3] = {0};
  PetscFunctionBeginUser;
  PetscCall(VecGetArrayRead(f->u, &u));
  for (int e = 0; e < f->domain.mesh->ne; e++)
    for (int c = 0; c < 2; c++) {
      double mu[3];
      P1MassApply(f->domain.geometry[e].area, u + 6 * e + 3 * c, mu);
      for (int i = 0; i < 3; i++) {
        sum[c] += FluidDensity(f)[e] * mu[i];
        sum[2] += 0.5 * FluidDensity(f)[e] * mu[i] * u[6 * e + 3 * c + i];
      }
    }
  PetscCall(VecRestoreArrayRead(f->u, &u));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sum, 3, MPI_DOUBLE, MPI_SUM, f->domain.mesh->comm));
  momentum[0] = sum[0], momentum[1] = sum[1];
  if (energy) *energy = sum[2];
  PetscFunctionReturn(0);
}

PetscErrorCode FluidPotentialEnergy(Fluid f, double *energy)
{
  int n;
  const double *volume = PhaseTransportVolumes(f->phases, &n), *g = f->setup.gravity;
  const Phases phases = PhaseTransportPhases(f->phases);
  const double *mass = PhasesMasses(phases);
  PetscFunctionBeginUser;
  *energy = 0.0;
  for (int k = 0; k < n * f->domain.mesh->ne; k++) {
    const EquationOfState *state = &f->setup.phases.state[k % n];
    Polygon part;
    double moment[2], share;
    if (!(volume[k] > 0.0)) continue;
    PetscCall(PhasesGetExtent(phases, k / n, k % n, &part, &share));
    PolygonMoment(&part, moment);
    const double rho = state->pressure > 0.0 ? mass[k] / volume[k] : f->setup.phases.rho[k % n];
    *energy -= share * rho * (g[0] * moment[0] + g[1] * moment[1]);
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, energy, 1, MPI_DOUBLE, MPI_SUM, f->domain.mesh->comm));
  PetscFunctionReturn(0);
}

PetscErrorCode FluidBoundaryForce(Fluid f, const char *boundary, double force[2])
{
  const int tag = MeshTagIndex(f->domain.mesh, boundary);
  PetscFunctionBeginUser;
  PetscCheck(tag >= 0, f->domain.mesh->comm, PETSC_ERR_ARG_WRONG, "the mesh has no boundary %s", boundary);
  for (int c = 0; c < 2; c++)
    force[c] = f->budget.boundary[tag][FORCE_PRESSURE][c] + f->budget.boundary[tag][FORCE_VISCOUS][c];
  PetscFunctionReturn(0);
}

static void SetCflElement(Fluid f, int e, double speed)
{
  double x[3][2];
  MeshCorners(f->domain.mesh, e, x);
  for (int c = 0; c < 2; c++) f->stats.cfl_centre[c] = (x[0][c] + x[1][c] + x[2][c]) / 3.0;
  f->stats.cfl_speed = speed;
}

double FluidTimeStep(Fluid f)
{
  const Mesh *m = f->domain.mesh;
  const PetscScalar *u;
  double rate = 0.0, largest = 0.0;
  if (VecGetArrayRead(f->u_projected, &u)) return 0.0;
  for (int e = 0; e < m->ne; e++) {
    const double before = rate;
    double speed = 0.0;
    for (int i = 0; i < 3; i++) {
      const double *v = u + 6 * e + i;
      double sum = 0.0; /* of |u.grad lambda|: twice the inverse of the time to cross the element */
      for (int k = 0; k < 3; k++)
        sum += fabs(v[0] * f->domain.geometry[e].g[k][0] + v[3] * f->domain.geometry[e].g[k][1]);
      rate = fmax(rate, 0.5 * sum);
      speed = fmax(speed, v[0] * v[0] + v[3] * v[3]);
    }
    largest = fmax(largest, speed);
    if (rate > before) SetCflElement(f, e, sqrt(speed));
  }
  (void)VecRestoreArrayRead(f->u_projected, &u);
  f->stats.max_speed = sqrt(largest);
  f->stats.cfl_rate = rate / f->setup.cfl;
  const double dt = rate * f->setup.dt_max > f->setup.cfl ? f->setup.cfl / rate : f->setup.dt_max;
  return fmin(dt, FluidInterfaceStep(f));
}
