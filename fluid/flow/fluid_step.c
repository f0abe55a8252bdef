/* The fluid's step. */
#include "fluid/discretization/ghosted.h"
#include "fluid/flow/fluid_impl.h"

/* How much of the pressure that a step's compression starts from is the last one's; what is left keeps it at the equation of
 * state.  (0 is on the edge of stability: phases/README.md.) */
#define GAS_OLD 0.98
/* Of backward Euler, with which an abrupt start begins. */
#define DAMPED_STEPS 4

PetscErrorCode FluidSetMaterial(Fluid f, MaterialLevel level, const double rho[], const double mu[])
{
  return MaterialSet(f->material, level, rho, mu);
}

PetscErrorCode FluidSetCoupling(Fluid f, int n, const CoracleCoupling coupling[])
{
  return SolidCouplingSet(f->solid, n, coupling);
}

/* u* = u at t + dt, the solver's first guess, and the mass flux rho u at t + theta dt, both extrapolated by at most two of
 * the last step. */
static PetscErrorCode Extrapolate(Fluid f, double dt)
{
  const double r = f->dt_previous > 0.0 ? fmin(dt / f->dt_previous, 2.0) : 0.0,
               s = (f->phases ? 0.5 : f->theta) * r;
  const double *rho = MaterialDensity(f->material, MATERIAL_STEP);
  PetscScalar *flux;
  PetscFunctionBeginUser;
  PetscCall(VecWAXPY(f->mass_flux, -1.0, f->u_previous, f->u));
  PetscCall(VecWAXPY(f->u_star, r, f->mass_flux, f->u));
  PetscCall(VecAYPX(f->mass_flux, s, f->u));
  if (f->phases) {
    PetscCall(VecWAXPY(f->mass_flux, -1.0, f->bulk_previous, f->bulk));
    PetscCall(VecAYPX(f->mass_flux, s, f->bulk));
    PetscCall(FluidMovePhases(f, dt, s));
  } else {
    PetscCall(VecGetArray(f->mass_flux, &flux));
    for (int e = 0; e < f->domain.mesh->ne; e++)
      for (int k = 0; k < 6; k++) flux[6 * e + k] *= rho[e];
    PetscCall(VecRestoreArray(f->mass_flux, &flux));
  }
  PetscCall(GhostedUpdate(f->mass_flux));
  PetscFunctionReturn(0);
}

/* Open boundaries whose pressure depends on time, as all do where gravity does, have what it is in the middle of the step, which moves u over all of it, from the
 * step's start: the projection leaves it alone. */
static PetscErrorCode SetVaryingPressure(Fluid f, double t)
{
  const PetscBool weight = (PetscBool)(f->setup.gravity_table.nrows > 0);
  PetscFunctionBeginUser;
  for (int b = 0; b < f->domain.mesh->ntags; b++)
    if (f->domain.boundary[b].kind == BOUNDARY_OPEN && (weight || BoundaryVaries(&f->domain.boundary[b]))) {
      PetscCall(FluidSetOpenPressure(f, t));
      break;
    }
  PetscFunctionReturn(0);
}

static PetscErrorCode SetGravity(Fluid f, double dt)
{
  double *g = f->setup.gravity;
  PetscFunctionBeginUser;
  if (!f->setup.gravity_table.nrows) PetscFunctionReturn(0);
  GravityOver(&f->setup.gravity_table, f->t, dt, g);
  if (f->phases) PetscCall(PhaseTransportSetGravity(f->phases, g));
  PetscFunctionReturn(0);
}

/* Whether the velocity at t is not the one that boundaries prescribe: of fluid at rest beside a wall that moves at once, or of fluid that
 * moves beside a wall at rest. */
static PetscErrorCode IsAbrupt(Fluid f, PetscBool *abrupt)
{
  const FluidDomain *d = &f->domain;
  double most[2] = {0.0}; /* difference, velocity */
  const PetscScalar *u;
  PetscFunctionBeginUser;
  PetscCall(VecGetArrayRead(f->u, &u));
  for (int k = 0; k < 3 * d->mesh->ne; k++) {
    const int e = k / 3;
    if (d->mesh->neighbor[k] >= 0 || BoundaryOfFace(d, e, k % 3)->kind != BOUNDARY_VELOCITY) continue;
    for (int i = 1; i < 3; i++) {
      const int node = (k + i) % 3;
      const double now[2] = {u[6 * e + node], u[6 * e + 3 + node]};
      double v[2];
      BoundaryVelocity(BoundaryOfFace(d, e, k % 3), f->t, ElementVertex(d->mesh, e, node), v);
      most[0] = fmax(most[0], hypot(now[0] - v[0], now[1] - v[1]));
      most[1] = fmax(most[1], fmax(hypot(now[0], now[1]), hypot(v[0], v[1])));
    }
  }
  PetscCall(VecRestoreArrayRead(f->u, &u));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, most, 2, MPI_DOUBLE, MPI_MAX, d->mesh->comm));
  *abrupt = (PetscBool)(most[0] > 0.01 * most[1]);
  PetscFunctionReturn(0);
}

/* Rannacher's start: with a theta of 1/2 what viscosity levels within a step is turned over in each and hardly decays; the first
 * steps of an abrupt start are of backward Euler, which takes it away. */
static PetscErrorCode SetTheta(Fluid f)
{
  PetscBool abrupt = PETSC_FALSE;
  PetscFunctionBeginUser;
  if (f->dt_previous == 0.0) {
    PetscCall(IsAbrupt(f, &abrupt));
    f->damped = abrupt ? DAMPED_STEPS : 0;
  }
  f->theta = f->damped > 0 ? 1.0 : f->setup.theta;
  MaterialSetTheta(f->material, f->theta);
  PetscFunctionReturn(0);
}

static MomentumStep StepOfMomentum(Fluid f, double dt, const double outside[])
{
  return (MomentumStep){f->t,
                        dt,
                        f->theta,
                        {f->setup.gravity[0], f->setup.gravity[1]},
                        MaterialDensity(f->material, MATERIAL_STEP),
                        MaterialViscosity(f->material, MATERIAL_STEP),
                        MaterialRevision(f->material),
                        f->mass_flux,
                        f->u,
                        f->p,
                        f->solid,
                        outside,
                        FluidInverseDensity(f),
                        f->absorption};
}

/* With the shares that phases have after they have moved. */
static void SetAbsorption(Fluid f)
{
  double share[PHASES_MAX];
  int n = 0;
  const double *volume = f->phases ? PhaseTransportVolumes(f->phases, &n) : NULL;
  for (int e = 0; e < f->domain.mesh->ne && f->absorption; e++) {
    double mass = 0.0;
    for (int p = 0; p < n; p++) mass += share[p] = f->setup.phases.rho[p] * fmax(volume[n * e + p], 0.0);
    for (int p = 0; p < n; p++) share[p] /= mass;
    f->absorption[e] = AbsorptionOfElement(&f->setup.absorption, f->domain.mesh, e, n ? share : NULL);
  }
}

PetscErrorCode FluidPrepareMomentum(Fluid f, double dt)
{
  const double start = MPI_Wtime();
  const PetscScalar *outside = NULL;
  PetscFunctionBeginUser;
  f->stats.dt = dt;
  PetscCall(SetTheta(f));
  PetscCall(SetGravity(f, dt));
  FluidSetTarget(f, f->dt_previous > 0.0 ? GAS_OLD : 0.0);
  PetscCall(Extrapolate(f, dt));
  FluidSetCompressibility(f);
  PetscCall(SetVaryingPressure(f, f->t + 0.5 * dt));
  if (f->phases) {
    PetscCall(FluidPredictPressure(f, dt));
    PetscCall(FluidSetOutside(f));
    PetscCall(GhostedGetArrayRead(f->outside, &outside));
  }
  SetAbsorption(f);
  const MomentumStep step = StepOfMomentum(f, dt, outside);
  PetscCall(MomentumSolverAssemble(f->momentum, &step));
  if (f->phases) {
    PetscCall(GhostedRestoreArrayRead(f->outside, &outside));
    PetscCall(FluidLendPressure(f, dt));
  }
  f->prepared = PETSC_TRUE;
  f->stats.seconds[ASSEMBLY] += MPI_Wtime() - start;
  PetscFunctionReturn(0);
}

int FluidTakeReport(Fluid f, const SolverReport *report)
{
  if (report->failure[0] && !f->failure[0])
    (void)snprintf(f->failure, sizeof f->failure, "%s", report->failure);
  return report->iterations;
}

const char *FluidStepFailure(Fluid f)
{
  return f->failure[0] ? f->failure : NULL;
}

PetscErrorCode FluidMomentum(Fluid f, double dt)
{
  MomentumReport report;
  PetscFunctionBeginUser;
  if (!f->prepared) PetscCall(FluidPrepareMomentum(f, dt));
  f->prepared = PETSC_FALSE;
  PetscCall(FluidBudgetBegin(f));
  const MomentumStep step = StepOfMomentum(f, dt, NULL);
  PetscCall(MomentumSolverSolve(f->momentum, &step, f->u_star, &report));
  f->stats.momentum_iterations = FluidTakeReport(f, &report.solver);
  f->stats.seconds[MOMENTUM] += report.seconds_solve;
  f->stats.seconds[ASSEMBLY] += report.seconds_assembly;
  PetscFunctionReturn(0);
}

ProjectionStep FluidProjectionStep(Fluid f, double t, double dt, PetscBool inertia)
{
  return (ProjectionStep){t,
                          dt,
                          MaterialDensity(f->material, MATERIAL_STEP),
                          MaterialRevision(f->material),
                          f->solid,
                          NULL,
                          inertia,
                          f->compressible,
                          f->p};
}

/* Of the step's end: with its density, so that what the pressure gives to an element is the change of the momentum that it has
 * then, rho^{n+1} u. */
static ProjectionStep EndProjection(Fluid f, double dt)
{
  ProjectionStep step = FluidProjectionStep(f, f->t + dt, dt, PETSC_TRUE);
  step.rho = MaterialDensity(f->material, MATERIAL_NEW);
  return step;
}

PetscErrorCode FluidProject(Fluid f, double dt)
{
  const double start = MPI_Wtime();
  const ProjectionStep step = EndProjection(f, dt);
  SolverReport report;
  Vec phi;
  PetscFunctionBeginUser;
  PetscCall(VecCopy(f->u_star, f->u_projected));
  if (f->phases) PetscCall(FluidReturnPressure(f, dt, f->u_projected));
  PetscCall(ProjectionSolverSolve(f->projection, &step, f->u_projected, &phi, &report));
  f->stats.pressure_iterations = FluidTakeReport(f, &report);
  PetscCall(ProjectionSolverSubtract(f->projection, &step, f->u_projected));
  PetscCall(VecAXPY(f->p, 1.0, phi));
  PetscCall(GhostedUpdate(f->p));
  f->stats.seconds[PRESSURE] += MPI_Wtime() - start;
  PetscFunctionReturn(0);
}

PetscErrorCode FluidCorrect(Fluid f, double dt, const CoracleCorrection correction[])
{
  const double start = MPI_Wtime();
  const Vec oldest = f->u_previous, oldest_bulk = f->bulk_previous;
  PetscFunctionBeginUser;
  if (f->phases) {
    /* that of u_projected is not free of divergence where a held solid fills a part of an element */
    const ProjectionStep step = EndProjection(f, dt);
    PetscCall(FluidBulkVelocity(f, f->u_star, oldest_bulk));
    PetscCall(FluidReturnPressure(f, dt, oldest_bulk));
    PetscCall(ProjectionSolverSubtract(f->projection, &step, oldest_bulk));
    f->bulk_previous = f->bulk;
    f->bulk = oldest_bulk;
  }
  PetscCall(FluidBudgetSolid(f, dt, correction));
  if (correction) {
    PetscScalar *u;
    PetscCall(VecGetArray(f->u_projected, &u));
    SolidCouplingCorrect(f->solid, f->domain.geometry, correction, u);
    PetscCall(VecRestoreArray(f->u_projected, &u));
  }
  PetscCall(FluidBudgetEnd(f, dt));
  if (f->phases) {
    PetscCall(VecCopy(ProjectionSolverLast(f->projection), f->dynamic));
    PetscCall(GhostedUpdate(f->dynamic));
  } else {
    const ProjectionStep step = EndProjection(f, dt);
    const double *mu = MaterialViscosity(f->material, MATERIAL_STEP);
    PetscCall(ProjectionSolverAddRotational(f->projection, &step, mu, f->theta, f->p));
  }
  SolidCouplingSetStarting(f->solid, PETSC_FALSE);
  f->u_previous = f->u;
  f->u = f->u_projected;
  f->u_projected = oldest;
  PetscCall(MaterialAdvance(f->material));
  f->dt_previous = dt;
  if (f->damped > 0) f->damped--;
  f->t += dt;
  f->stats.t = f->t;
  f->stats.seconds[COUPLING] += MPI_Wtime() - start;
  PetscFunctionReturn(0);
}

PetscErrorCode FluidStep(Fluid f, double dt)
{
  PetscFunctionBeginUser;
  PetscCall(FluidMomentum(f, dt));
  PetscCall(FluidProject(f, dt));
  PetscCheck(!FluidStepFailure(f), f->domain.mesh->comm, PETSC_ERR_NOT_CONVERGED, "%s", f->failure);
  PetscCall(FluidCorrect(f, dt, NULL));
  PetscFunctionReturn(0);
}

/* velocity, that of time t, less the part whose bulk velocity is not free of divergence */
static PetscErrorCode SubtractDivergence(Fluid f, double t, Vec velocity, Vec also)
{
  ProjectionStep step = FluidProjectionStep(f, t, 1.0, PETSC_FALSE); /* any dt: it cancels */
  SolverReport report;
  Vec phi;
  PetscFunctionBeginUser;
  step.pressure = NULL;
  if (f->compressible) PetscCall(FluidLeaveCompressible(f));
  PetscCall(ProjectionSolverSolve(f->projection, &step, velocity, &phi, &report));
  f->stats.pressure_iterations = FluidTakeReport(f, &report);
  PetscCall(ProjectionSolverSubtract(f->projection, &step, velocity));
  if (also) PetscCall(ProjectionSolverSubtract(f->projection, &step, also));
  PetscFunctionReturn(0);
}

PetscErrorCode FluidMakeSolenoidal(Fluid f)
{
  const double start = MPI_Wtime();
  PetscFunctionBeginUser;
  if (f->phases) { /* which the extrapolated velocity moves: it must be free of divergence, too, and have the boundaries' values */
    PetscCall(FluidBulkVelocity(f, f->u, f->bulk));
    PetscCall(FluidBulkVelocity(f, f->u_previous, f->bulk_previous));
    PetscCall(SubtractDivergence(f, f->t, f->u, f->bulk));
    PetscCall(SubtractDivergence(f, f->t - f->dt_previous, f->u_previous, f->bulk_previous));
  } else {
    PetscCall(SubtractDivergence(f, f->t, f->u, f->u_previous)); /* their difference extrapolates */
  }
  PetscCall(FluidBudgetChanged(f));
  f->stats.seconds[PRESSURE] += MPI_Wtime() - start;
  PetscFunctionReturn(0);
}
