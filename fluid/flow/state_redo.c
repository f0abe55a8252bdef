/* The state of the fluid at the start of a step that may be redone. */
#include "fluid/flow/fluid_impl.h"

static PetscErrorCode CopyWithGhosts(Vec from, Vec to)
{
  Vec a, b;
  PetscFunctionBeginUser;
  PetscCall(VecGhostGetLocalForm(from, &a));
  PetscCall(VecGhostGetLocalForm(to, &b));
  PetscCall(VecCopy(a, b));
  PetscCall(VecGhostRestoreLocalForm(from, &a));
  PetscCall(VecGhostRestoreLocalForm(to, &b));
  PetscFunctionReturn(0);
}

PetscErrorCode FluidSaveState(Fluid f)
{
  PetscFunctionBeginUser;
  PetscCall(CopyWithGhosts(f->u, f->saved.u));
  PetscCall(CopyWithGhosts(f->u_previous, f->saved.u_previous));
  PetscCall(CopyWithGhosts(f->p, f->saved.p));
  PetscCall(MaterialSave(f->material));
  if (f->phases) PetscCall(PhaseTransportSaveState(f->phases));
  f->saved.t = f->t, f->saved.dt_previous = f->dt_previous, f->saved.damped = f->damped;
  PetscCall(PetscArraycpy(f->saved.momentum, f->budget.momentum, 2));
  PetscCall(PetscArraycpy(f->saved.budget_start, f->budget_start, 2));
  PetscFunctionReturn(0);
}

PetscErrorCode FluidRestoreState(Fluid f)
{
  PetscFunctionBeginUser;
  PetscCall(CopyWithGhosts(f->saved.u, f->u));
  PetscCall(CopyWithGhosts(f->saved.u_previous, f->u_previous));
  PetscCall(CopyWithGhosts(f->saved.p, f->p));
  PetscCall(MaterialRestore(f->material));
  if (f->phases) PetscCall(PhaseTransportRestoreState(f->phases));
  f->failure[0] = '\0';
  f->t = f->saved.t, f->dt_previous = f->saved.dt_previous, f->damped = f->saved.damped;
  PetscCall(PetscArraycpy(f->budget.momentum, f->saved.momentum, 2));
  PetscCall(PetscArraycpy(f->budget_start, f->saved.budget_start, 2));
  PetscFunctionReturn(0);
}
