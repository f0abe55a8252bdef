/* What a fluid of several phases does differently. */
#include "fluid/discretization/ghosted.h"
#include "fluid/flow/fluid_impl.h"
#include "fluid/pressure/viscous_share.h"
#include "fluid/pressure/weighted_projection.h"

/* Of an element, less than which beside a solid is none. */
#define LEAST_OPEN 1e-3
/* Of the density beside a solid, what may be missing: the lighter phase that a solid leaves behind where it moves. */
#define LITTLE 1e-2

/* Density and viscosity of the phases as they are. */
static PetscErrorCode SetPhaseMaterial(Fluid f, MaterialLevel level)
{
  double *rho, *mu;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(f->domain.mesh->ne, &rho, f->domain.mesh->ne, &mu));
  PhaseTransportMaterial(f->phases, rho, mu);
  PetscCall(FluidCheckDensity(f, rho));
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

/* Elements with a solid's inertia have one density; beside a solid that is held at rest water at rest stays at rest there. */
static PetscErrorCode SetInSolid(Fluid f)
{
  const double *alpha = SolidCouplingFraction(f->solid), *rho = MaterialDensity(f->material, MATERIAL_STEP);
  int n;
  const CoracleCoupling *entry = SolidCouplingEntries(f->solid, &n);
  PetscFunctionBeginUser;
  PetscCall(PetscArrayzero(f->remainder, 2 * (size_t)f->domain.mesh->ne));
  for (int k = 0; k < n; k++) {
    const int e = entry[k].element;
    double *remainder = f->remainder + 2 * e;
    if (!(entry[k].flags & CORACLE_HAS_INERTIA)) continue;
    PhaseTransportSetUniform(f->phases, e, rho[e], SolidCouplingIsAtRest(entry + k) ? alpha[e] : 1.0,
                             remainder);
    for (int c = 0; c < 2; c++) remainder[c] *= f->domain.geometry[e].area;
  }
  PetscFunctionReturn(0);
}

/* moves[ne]: elements with the volume of a solid that is not held. */
static PetscErrorCode WhereSolidMoves(Fluid f, char moves[])
{
  int n;
  const CoracleCoupling *entry = SolidCouplingEntries(f->solid, &n);
  PetscFunctionBeginUser;
  PetscCall(PetscArrayzero(moves, f->domain.mesh->ne));
  for (int k = 0; k < n; k++)
    moves[entry[k].element] =
        (entry[k].flags & (CORACLE_HAS_INERTIA | CORACLE_IS_HELD)) == CORACLE_HAS_INERTIA;
  PetscFunctionReturn(0);
}

/* The least (sum of densities)/tension of all pairs of phases. */
static double LeastDensityPerTension(const PhaseProperties *p)
{
  double least = HUGE_VAL;
  for (int k = 0; k < p->n; k++)
    for (int j = 0; j < k; j++)
      if (p->surface_tension.value[j][k] != 0.0)
        least = fmin(least, (p->rho[j] + p->rho[k]) / p->surface_tension.value[j][k]);
  return least;
}

void FluidDensityRange(Fluid f, int e, double *low, double *high)
{
  int n;
  const double *volume = PhaseTransportVolumes(f->phases, &n), *rho = f->setup.phases.rho;
  *low = HUGE_VAL;
  *high = 0.0;
  for (int p = 0; p < n; p++) {
    if (!(volume[n * e + p] > 0.0)) continue;
    *low = fmin(*low, rho[p]);
    *high = fmax(*high, rho[p]);
  }
}

double FluidInterfaceStep(Fluid f)
{
  const FluidSetup *s = &f->setup;
  Phases phases = f->phases ? PhaseTransportPhases(f->phases) : NULL;
  double area = HUGE_VAL, rate = 0.0, dt = HUGE_VAL; /* rate: of contrast/h, 1/m */
  if (!phases) return HUGE_VAL;
  for (int e = 0; e < f->domain.mesh->ne; e++) {
    double low, high;
    if (PhasesSingle(phases, e) >= 0 || PhasesSpread(phases, e)) continue;
    area = fmin(area, f->domain.geometry[e].area);
    FluidDensityRange(f, e, &low, &high);
    rate = fmax(rate, (high - low) / (high + low) / sqrt(2.0 * f->domain.geometry[e].area));
  }
  rate *= PETSC_PI * hypot(s->gravity[0], s->gravity[1]);
  if (s->gravity_cfl > 0.0 && rate > 0.0) dt = s->gravity_cfl / sqrt(rate);
  if (s->capillary_cfl > 0.0 && PhaseHasTension(&s->phases))
    dt = fmin(dt, s->capillary_cfl * sqrt(LeastDensityPerTension(&s->phases)) * pow(2.0 * area, 0.75));
  return dt;
}

PetscErrorCode FluidMovePhases(Fluid f, double dt, double s)
{
  PhaseStep step = {.time = f->t, .dt = dt, .extrapolated = s, .dt_before = f->dt_previous};
  const size_t n = 6 * (size_t)f->domain.mesh->ne;
  PetscScalar *flux;
  double *u;
  char *moves;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(n, &u, f->domain.mesh->ne, &moves));
  PetscCall(WhereSolidMoves(f, moves));
  PetscCall(VecGetArray(f->mass_flux, &flux));
  PetscCall(PetscArraycpy(u, flux, n));
  step.u = u;
  step.solid = SolidCouplingFraction(f->solid);
  step.moves = moves;
  step.mass_flux = flux;
  double *pressure = NULL;
  if (f->compressible) PetscCall(FluidMeanPressure(f, &pressure));
  step.pressure = pressure;
  PetscCall(PhaseTransportStep(f->phases, &step));
  PetscCall(VecRestoreArray(f->mass_flux, &flux));
  PetscCall(PetscFree(pressure));
  PetscCall(SetPhaseMaterial(f, MATERIAL_NEW));
  PetscCall(FluidDampInterface(f, u));
  PetscCall(PetscFree2(u, moves));
  PetscCall(SetInSolid(f));
  PetscFunctionReturn(0);
}

/* Density of what element e has beside the solid, which covers `alpha` of it; rho: of all that it has. */
static double OutsideDensity(Fluid f, int e, double rho, double alpha)
{
  double inside, beside;
  if (alpha == 0.0) return rho;
  if (alpha > 1.0 - LEAST_OPEN) return 0.0;
  PhaseTransportBesideSolid(f->phases, e, &inside, &beside);
  const double outside = fmax((rho - alpha * inside) / (1.0 - alpha), inside);
  return outside > (1.0 - LITTLE) * beside ? fmax(beside, inside) : outside;
}

PetscErrorCode FluidSetOutside(Fluid f)
{
  const double *alpha = SolidCouplingFraction(f->solid), *rho = MaterialDensity(f->material, MATERIAL_STEP);
  PetscScalar *outside;
  PetscFunctionBeginUser;
  PetscCall(VecGetArrayWrite(f->outside, &outside));
  for (int e = 0; e < f->domain.mesh->ne; e++) outside[e] = OutsideDensity(f, e, rho[e], alpha[e]);
  PetscCall(VecRestoreArrayWrite(f->outside, &outside));
  PetscCall(GhostedUpdate(f->outside));
  PetscFunctionReturn(0);
}

const InverseDensity *FluidInverseDensity(Fluid f)
{
  return f->phases ? PhaseTransportInverseDensity(f->phases) : NULL;
}

/* velocity = dt (weight - R^-1 grad p) */
static PetscErrorCode Accelerate(Fluid f, double dt, Vec velocity)
{
  const InverseDensity *r = FluidInverseDensity(f);
  const PetscScalar *p;
  PetscScalar *u;
  PetscFunctionBeginUser;
  PetscCall(GhostedGetArrayRead(f->p, &p));
  PetscCall(VecGetArrayWrite(velocity, &u));
  for (int e = 0; e < f->domain.mesh->ne; e++) {
    double grad[3][2], acceleration[2];
    DomainGradient(&f->domain, e, p, grad);
    for (int i = 0; i < 3; i++) {
      InverseDensityAcceleration(&r[e], grad[i], acceleration);
      for (int c = 0; c < 2; c++) u[6 * e + 3 * c + i] = dt * acceleration[c];
    }
  }
  PetscCall(VecRestoreArrayWrite(velocity, &u));
  PetscCall(GhostedRestoreArrayRead(f->p, &p));
  PetscFunctionReturn(0);
}

/* velocity, which is dt (weight - R^-1 grad p), becomes where the solid has implicit inertia what the momentum equation without
 * viscosity and advection makes of all forces there: W^-1 (rho M (weight - grad p/rho) + load - (a + I) u), load of SolidCouplingLoad. */
static PetscErrorCode AccelerateSolid(Fluid f, double dt, Vec velocity)
{
  const double *rho = MaterialDensity(f->material, MATERIAL_STEP);
  int n;
  const CoracleCoupling *entry = SolidCouplingEntries(f->solid, &n);
  const PetscScalar *u;
  PetscScalar *v;
  PetscFunctionBeginUser;
  PetscCall(VecGetArrayRead(f->u, &u));
  PetscCall(VecGetArray(velocity, &v));
  for (int k = 0; k < n; k++) {
    const int e = entry[k].element;
    const double area = f->domain.geometry[e].area;
    double load[6], matrix[6][6];
    if (!(entry[k].flags & CORACLE_HAS_INERTIA)) continue;
    for (int c = 0; c < 2; c++) P1MassApply(area * rho[e] / dt, v + 6 * e + 3 * c, load + 3 * c);
    SolidCouplingLoad(f->solid, e, u + 6 * e, area, rho[e] / dt, load);
    SolidCouplingMatrix(entry + k, matrix);
    for (int row = 0; row < 6; row++)
      for (int col = 0; col < 6; col++) load[row] -= matrix[row][col] * u[6 * e + col];
    PetscCall(WeightedProjectionSolve(area, rho[e] / dt, entry + k, load));
    for (int i = 0; i < 6; i++) v[6 * e + i] = load[i];
  }
  PetscCall(VecRestoreArray(velocity, &v));
  PetscCall(VecRestoreArrayRead(f->u, &u));
  PetscFunctionReturn(0);
}

/* On any rank. */
static PetscErrorCode HasSolid(Fluid f, PetscBool *solid)
{
  int n;
  PetscFunctionBeginUser;
  (void)SolidCouplingEntries(f->solid, &n);
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &n, 1, MPI_INT, MPI_MAX, f->domain.mesh->comm));
  *solid = (PetscBool)(n > 0);
  PetscFunctionReturn(0);
}

/* p, with its values on open boundaries as they are, makes the velocity that starts as `start` (NULL: 0) and is accelerated
 * over the step by weight - R^-1 grad p free of divergence.  It is improved from what it was, so that what the solver leaves, which
 * the projection, by 1/rho, does not take away, does not add up over the steps; or made from 0 with a solid, where a pressure's
 * response is not R^-1 grad p alone, or a gas.  With surface tension it is improved with a solid, too: the solver's matrix lets the
 * pressure through a solid that is held, and the pressure of a drop on it would drive the fluid there in each step. */
static PetscErrorCode SolvePressure(Fluid f, ProjectionStep *step, PetscBool from_zero, Vec start)
{
  SolverReport report;
  Vec velocity, phi;
  PetscFunctionBeginUser;
  step->inverse_density = FluidInverseDensity(f);
  PetscCall(VecDuplicate(f->u, &velocity));
  if (from_zero) PetscCall(ProjectionSolverKeepFixed(f->projection, f->p));
  PetscCall(Accelerate(f, step->dt, velocity));
  if (start) {
    PetscCall(AccelerateSolid(f, step->dt, velocity));
    PetscCall(VecAXPY(velocity, 1.0, start));
  }
  PetscCall(ProjectionSolverSolve(f->projection, step, velocity, &phi, &report));
  f->stats.pressure_iterations = FluidTakeReport(f, &report);
  PetscCall(VecAXPY(f->p, 1.0, phi));
  PetscCall(GhostedUpdate(f->p));
  PetscCall(VecDestroy(&velocity));
  PetscFunctionReturn(0);
}

static PetscErrorCode Balance(Fluid f, PetscBool from_zero)
{
  /* large: what prescribed velocities contribute goes with 1/dt */
  const double dt = f->compressible ? f->setup.dt_max : 1e8;
  ProjectionStep step = FluidProjectionStep(f, f->t, dt, PETSC_FALSE);
  PetscFunctionBeginUser;
  FluidSetTarget(f, 0.0);
  FluidSetCompressibility(f);
  PetscCall(SolvePressure(f, &step, from_zero, NULL));
  PetscFunctionReturn(0);
}

PetscErrorCode FluidBalancePressure(Fluid f)
{
  PetscBool solid;
  PetscFunctionBeginUser;
  PetscCall(HasSolid(f, &solid));
  PetscCall(Balance(f, (PetscBool)(solid || f->compressible)));
  PetscCheck(!FluidStepFailure(f), f->domain.mesh->comm, PETSC_ERR_NOT_CONVERGED, "%s", f->failure);
  PetscFunctionReturn(0);
}

PetscErrorCode FluidPredictPressure(Fluid f, double dt)
{
  ProjectionStep step = FluidProjectionStep(f, f->t, dt, PETSC_TRUE);
  PetscBool solid;
  PetscFunctionBeginUser;
  PetscCall(HasSolid(f, &solid));
  const PetscBool from_zero = (PetscBool)(f->compressible || !PhaseHasTension(&f->setup.phases));
  if (solid || f->compressible)
    PetscCall(SolvePressure(f, &step, from_zero, solid ? f->bulk : NULL));
  else
    PetscCall(Balance(f, PETSC_FALSE));
  PetscFunctionReturn(0);
}

/* q[c][i] = chi grad p of the last dynamic pressure at the vertices of element e; false where it has no share. */
static PetscBool ShareOfGradient(Fluid f, int e, double dt, const PetscScalar p[], double q[2][3])
{
  const double *rho = MaterialDensity(f->material, MATERIAL_STEP),
               *mu = MaterialViscosity(f->material, MATERIAL_STEP);
  const double share = ViscousShare(f->domain.geometry[e].area, rho[e], mu[e], dt);
  double grad[3][2];
  if (f->compressible || SolidCouplingAt(f->solid, e)) return PETSC_FALSE;
  DomainGradient(&f->domain, e, p, grad);
  for (int k = 0; k < 6; k++) q[k / 3][k % 3] = share * grad[k % 3][k / 3];
  return PETSC_TRUE;
}

PetscErrorCode FluidLendPressure(Fluid f, double dt)
{
  const PetscScalar *p;
  PetscScalar *load;
  PetscFunctionBeginUser;
  PetscCall(GhostedGetArrayRead(f->dynamic, &p));
  PetscCall(VecGetArray(MomentumSolverLoad(f->momentum), &load));
  for (int e = 0; e < f->domain.mesh->ne; e++) {
    double q[2][3], force[6];
    if (!ShareOfGradient(f, e, dt, p, q)) continue;
    for (int c = 0; c < 2; c++) P1MassApply(f->domain.geometry[e].area, q[c], force + 3 * c);
    for (int k = 0; k < 6; k++) load[6 * e + k] -= force[k];
  }
  PetscCall(VecRestoreArray(MomentumSolverLoad(f->momentum), &load));
  PetscCall(GhostedRestoreArrayRead(f->dynamic, &p));
  PetscFunctionReturn(0);
}

PetscErrorCode FluidReturnPressure(Fluid f, double dt, Vec velocity)
{
  const double *rho = MaterialDensity(f->material, MATERIAL_NEW);
  const PetscScalar *p;
  PetscScalar *u;
  PetscFunctionBeginUser;
  PetscCall(GhostedGetArrayRead(f->dynamic, &p));
  PetscCall(VecGetArray(velocity, &u));
  for (int e = 0; e < f->domain.mesh->ne; e++) {
    double q[2][3];
    if (!ShareOfGradient(f, e, dt, p, q)) continue;
    for (int k = 0; k < 6; k++) u[6 * e + k] += dt / rho[e] * q[k / 3][k % 3];
  }
  PetscCall(VecRestoreArray(velocity, &u));
  PetscCall(GhostedRestoreArrayRead(f->dynamic, &p));
  PetscFunctionReturn(0);
}

PetscErrorCode FluidBulkVelocity(Fluid f, Vec velocity, Vec bulk)
{
  int n;
  const CoracleCoupling *entry = SolidCouplingEntries(f->solid, &n);
  const PetscScalar *v;
  PetscScalar *b;
  PetscFunctionBeginUser;
  PetscCall(VecCopy(velocity, bulk));
  PetscCall(VecGetArrayRead(velocity, &v));
  PetscCall(VecGetArray(bulk, &b));
  for (int k = 0; k < n; k++) {
    const int e = entry[k].element;
    for (int c = 0; c < 2; c++) {
      double r[3], du[3];
      for (int i = 0; i < 3; i++) {
        r[i] = entry[k].us[c][i];
        for (int j = 0; j < 3; j++) r[i] -= entry[k].ms[i][j] * v[6 * e + 3 * c + j];
      }
      P1MassSolve(f->domain.geometry[e].area, r, du);
      for (int i = 0; i < 3; i++) b[6 * e + 3 * c + i] += du[i];
    }
  }
  PetscCall(VecRestoreArray(bulk, &b));
  PetscCall(VecRestoreArrayRead(velocity, &v));
  PetscFunctionReturn(0);
}
