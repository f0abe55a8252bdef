/* The state of the fluid from one mesh to the next. */
#include "common/transfer/transfer.h"
#include "fluid/fluid_impl.h"

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

static PetscErrorCode Pressure(Fluid from, Fluid to, Transfer transfer)
{
  Vec old, new;
  const PetscScalar *p;
  PetscScalar *q;
  PetscFunctionBeginUser;
  PetscCall(VecGhostGetLocalForm(from->p, &old));
  PetscCall(VecGhostGetLocalForm(to->p, &new));
  PetscCall(VecGetArrayRead(old, &p));
  PetscCall(VecGetArray(new, &q));
  PetscCall(TransferP2(transfer, from->domain.p2, to->domain.p2, p, q));
  PetscCall(VecRestoreArray(new, &q));
  PetscCall(VecRestoreArrayRead(old, &p));
  PetscCall(VecGhostRestoreLocalForm(to->p, &new));
  PetscCall(VecGhostRestoreLocalForm(from->p, &old));
  PetscFunctionReturn(0);
}

PetscErrorCode FluidTransfer(Fluid from, Fluid to)
{
  const double start = MPI_Wtime(), setup = to->stats.seconds[SETUP];
  Transfer transfer;
  PetscFunctionBeginUser;
  PetscCall(TransferCreate(from->domain.mesh, to->domain.mesh, &transfer));
  PetscCall(Velocities(from, to, transfer));
  PetscCall(Pressure(from, to, transfer));
  PetscCall(TransferDestroy(&transfer));
  PetscCall(VecCopy(to->u, to->u_projected));
  to->t = from->t;
  to->dt_previous = from->dt_previous;
  to->stats = from->stats;
  to->stats.seconds[ADAPTATION] += MPI_Wtime() - start;
  to->stats.seconds[SETUP] += setup;
  PetscFunctionReturn(0);
}
