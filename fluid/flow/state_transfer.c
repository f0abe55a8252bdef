/* The state of the fluid from one mesh to the next. */
#include "common/transfer/transfer.h"
#include "fluid/discretization/ghosted.h"
#include "fluid/flow/fluid_impl.h"

/* u and u of the step before, in one go: [ne][2 fields][2][3]. */
static PetscErrorCode Velocities(Fluid from, Fluid to, Transfer transfer)
{
  const Vec source[2] = {from->u, from->u_previous}, target[2] = {to->u, to->u_previous};
  double *old, *new;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(12 * from->domain.mesh->ne, &old, 12 * to->domain.mesh->ne, &new));
  for (int k = 0; k < 2; k++) {
    const PetscScalar *u;
    PetscCall(VecGetArrayRead(source[k], &u));
    for (int e = 0; e < from->domain.mesh->ne; e++)
      PetscCall(PetscArraycpy(old + 12 * e + 6 * k, u + 6 * e, 6));
    PetscCall(VecRestoreArrayRead(source[k], &u));
  }
  PetscCall(TransferP1DG(transfer, 4, old, new));
  for (int k = 0; k < 2; k++) {
    PetscScalar *u;
    PetscCall(VecGetArray(target[k], &u));
    for (int e = 0; e < to->domain.mesh->ne; e++)
      PetscCall(PetscArraycpy(u + 6 * e, new + 12 * e + 6 * k, 6));
    PetscCall(VecRestoreArray(target[k], &u));
  }
  PetscCall(PetscFree2(old, new));
  PetscFunctionReturn(0);
}

/* of, a P2 field of `from`, to `into`, one of `to`. */
static PetscErrorCode Pressure(Fluid from, Vec of, Fluid to, Vec into, Transfer transfer)
{
  const PetscScalar *p;
  PetscScalar *q;
  PetscFunctionBeginUser;
  PetscCall(GhostedGetArrayRead(of, &p));
  PetscCall(GhostedGetArray(into, &q));
  PetscCall(TransferP2(transfer, from->domain.p2, to->domain.p2, p, q));
  PetscCall(GhostedRestoreArray(into, &q));
  PetscCall(GhostedRestoreArrayRead(of, &p));
  PetscFunctionReturn(0);
}

/* --- with phases ---------------------------------------------------------------------------------------- */

/* What is transferred for an element, at its vertices. */
typedef struct {
  double u[2][2][3],
      momentum[2][2][3]; /* of the last two steps: components of u, m/s, and rho u, kg/(m2 s) */
  double rho[3];
} PhaseFields;

static double Sum(const double v[3])
{
  return v[0] + v[1] + v[2];
}

/* u by Galerkin projection, shifted by elements so that the mean is that of rho u over that of rho. */
static PetscErrorCode PhaseVelocities(Fluid from, Fluid to, Transfer transfer)
{
  enum { FIELDS = sizeof(PhaseFields) / (3 * sizeof(double)) };
  const Vec source[2] = {from->u, from->u_previous}, target[2] = {to->u, to->u_previous};
  const int nfrom = from->domain.mesh->ne, nto = to->domain.mesh->ne;
  const double *rho = FluidDensity(from);
  PhaseFields *old, *new;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(nfrom, &old, nto, &new));
  for (int k = 0; k < 2; k++) {
    const PetscScalar *u;
    PetscCall(VecGetArrayRead(source[k], &u));
    for (int e = 0; e < nfrom; e++)
      for (int i = 0; i < 6; i++) {
        old[e].u[k][i / 3][i % 3] = u[6 * e + i];
        old[e].momentum[k][i / 3][i % 3] = rho[e] * u[6 * e + i];
        old[e].rho[i % 3] = rho[e];
      }
    PetscCall(VecRestoreArrayRead(source[k], &u));
  }
  PetscCall(TransferP1DG(transfer, FIELDS, (const double *)old, (double *)new));
  for (int k = 0; k < 2; k++) {
    PetscScalar *u;
    PetscCall(VecGetArray(target[k], &u));
    for (int e = 0; e < nto; e++)
      for (int c = 0; c < 2; c++) {
        const double *v = new[e].u[k][c];
        const double shift = Sum(new[e].momentum[k][c]) / Sum(new[e].rho) - Sum(v) / 3.0;
        for (int i = 0; i < 3; i++) u[6 * e + 3 * c + i] = v[i] + shift;
      }
    PetscCall(VecRestoreArray(target[k], &u));
  }
  PetscCall(PetscFree2(old, new));
  PetscFunctionReturn(0);
}

/* What gravity alone makes is computed on either mesh, because its kink lies on the interface; the rest, here with the
 * opposite sign, is interpolated.  Leaves that in from->p. */
static PetscErrorCode PhasePressure(Fluid from, Fluid to, Transfer transfer)
{
  Vec p, still;
  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(from->p, &p));
  PetscCall(VecDuplicate(to->p, &still));
  PetscCall(VecCopy(from->p, p));
  /* with surface tension a step begins from this pressure (FluidPredictPressure), and of a gas it is what its compression starts from
   * (FluidSetTarget): the new mesh knows no coupling yet, and the old one must not either, or what a solid changes would be left in it */
  if (PhaseHasTension(&from->setup.phases) || from->compressible) PetscCall(FluidSetCoupling(from, 0, NULL));
  PetscCall(FluidBalancePressure(from));
  PetscCall(FluidSetOpenPressure(to, from->t + 0.5 * from->stats.dt));
  PetscCall(FluidBalancePressure(to));
  PetscCall(VecCopy(to->p, still));
  PetscCall(VecAXPY(from->p, -1.0, p));
  PetscCall(GhostedUpdate(from->p));
  PetscCall(Pressure(from, from->p, to, to->p, transfer));
  PetscCall(Pressure(from, from->dynamic, to, to->dynamic, transfer));
  PetscCall(VecAYPX(to->p, -1.0, still));
  PetscCall(GhostedUpdate(to->p));
  PetscCall(VecDestroy(&p));
  PetscCall(VecDestroy(&still));
  PetscFunctionReturn(0);
}

static PetscErrorCode PhaseFlow(Fluid from, Fluid to, Transfer transfer)
{
  PetscFunctionBeginUser;
  PhaseTransportSettle(from->phases);
  PetscCall(FluidPhasesChanged(from));
  PetscCall(PhaseVelocities(from, to, transfer));
  PetscCall(PhasePressure(from, to, transfer));
  PetscFunctionReturn(0);
}

PetscErrorCode FluidTransferPhases(Fluid from, Fluid to)
{
  const double start = MPI_Wtime();
  PetscFunctionBeginUser;
  PetscCall(TransferCreate(from->domain.mesh, to->domain.mesh, &to->transfer));
  if (from->phases) {
    PetscCall(PhaseTransportRemap(from->phases, to->transfer, to->phases));
    PetscCall(FluidPhasesChanged(to));
  }
  to->stats.seconds[ADAPTATION] += MPI_Wtime() - start;
  PetscFunctionReturn(0);
}

PetscErrorCode FluidTransfer(Fluid from, Fluid to)
{
  const double start = MPI_Wtime();
  PetscFunctionBeginUser;
  if (!to->transfer) PetscCall(FluidTransferPhases(from, to));
  const double setup = to->stats.seconds[SETUP], remap = to->stats.seconds[ADAPTATION];
  to->t = from->t;
  if (from->phases) {
    PetscCall(PhaseFlow(from, to, to->transfer));
  } else {
    PetscCall(Velocities(from, to, to->transfer));
    PetscCall(Pressure(from, from->p, to, to->p, to->transfer));
    PetscCall(FluidSetOpenPressure(to, to->t)); /* to the last bit what a run that resumes sets */
  }
  PetscCall(TransferDestroy(&to->transfer));
  PetscCall(VecCopy(to->u, to->u_projected));
  to->dt_previous = from->dt_previous;
  to->damped = from->damped;
  PetscCall(PetscArraycpy(to->budget.momentum, from->budget.momentum, 2));
  PetscCall(FluidBudgetChanged(to));
  to->stats = from->stats;
  to->stats.seconds[ADAPTATION] += remap + MPI_Wtime() - start;
  to->stats.seconds[SETUP] += setup;
  PetscFunctionReturn(0);
}
