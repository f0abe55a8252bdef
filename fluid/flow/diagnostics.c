/* What is measured of a flow: the step that it allows, momentum, energy, errors against exact fields. */
#include "fluid/discretization/ghosted.h"
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

/* Dunavant's rule of degree 5: weights sum to 1 */
static const double QUADRATURE[7][4] = {
    {1.0 / 3, 1.0 / 3, 1.0 / 3, 0.225},
    {0.797426985353087, 0.101286507323456, 0.101286507323456, 0.125939180544827},
    {0.101286507323456, 0.797426985353087, 0.101286507323456, 0.125939180544827},
    {0.101286507323456, 0.101286507323456, 0.797426985353087, 0.125939180544827},
    {0.059715871789770, 0.470142064105115, 0.470142064105115, 0.132394152788506},
    {0.470142064105115, 0.059715871789770, 0.470142064105115, 0.132394152788506},
    {0.470142064105115, 0.470142064105115, 0.059715871789770, 0.132394152788506}};

/* Squared velocity error; sum of pressure error, of its square, and area. */
static void ElementErrors(Fluid f, int e, double t, FieldFunction velocity, FieldFunction pressure,
                          void *context, const double u[6], const double p[6], double sum[4])
{
  const Mesh *m = f->domain.mesh;
  for (int q = 0; q < 7; q++) {
    const double *l = QUADRATURE[q], w = l[3] * f->domain.geometry[e].area;
    double x[2] = {0}, v[2], exact = 0.0;
    for (int i = 0; i < 3; i++)
      for (int c = 0; c < 2; c++) x[c] += l[i] * ElementVertex(m, e, i)[c];
    if (velocity) velocity(context, t, x, v);
    for (int c = 0; c < 2 && velocity; c++) {
      const double d = l[0] * u[3 * c] + l[1] * u[3 * c + 1] + l[2] * u[3 * c + 2] - v[c];
      sum[0] += w * d * d;
    }
    if (pressure) pressure(context, t, x, &exact);
    double d = -exact;
    for (int i = 0; i < 3; i++)
      d += p[i] * l[i] * (2.0 * l[i] - 1.0) + p[3 + i] * 4.0 * l[(i + 1) % 3] * l[(i + 2) % 3];
    sum[1] += w * d;
    sum[2] += w * d * d;
    sum[3] += w;
  }
}

PetscErrorCode FluidErrors(Fluid f, double t, FieldFunction velocity, FieldFunction pressure, void *context,
                           double *velocity_error, double *pressure_error)
{
  const Mesh *m = f->domain.mesh;
  const PetscScalar *u, *p;
  double sum[4] = {0};
  PetscFunctionBeginUser;
  PetscCall(VecGetArrayRead(f->u, &u));
  PetscCall(GhostedGetArrayRead(f->p, &p));
  for (int e = 0; e < m->ne; e++) {
    double pe[6];
    for (int k = 0; k < 6; k++) pe[k] = p[f->domain.p2->node[6 * e + k]];
    ElementErrors(f, e, t, velocity, pressure, context, u + 6 * e, pe, sum);
  }
  PetscCall(GhostedRestoreArrayRead(f->p, &p));
  PetscCall(VecRestoreArrayRead(f->u, &u));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sum, 4, MPI_DOUBLE, MPI_SUM, m->comm));
  if (velocity_error) *velocity_error = sqrt(sum[0]);
  if (pressure_error) *pressure_error = sqrt(PetscMax(sum[2] - sum[1] * sum[1] / sum[3], 0.0));
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
