/* The momentum equation's preconditioner: both components of the velocity are nearly decoupled, by the same
 * scalar operator P, whose block for elements K and N is the mean of the xx and the yy part of the full one:
 *
 *     A_KN ~ [P_KN  0 ; 0  P_KN],   6 x 6 from 3 x 3
 *
 * An incomplete factorisation of P is eight times cheaper than one of A, and moves a quarter of the memory,
 * which is what the iterations wait for.  It is made anew in every step: the solid's stiff terms move with
 * it. */
#include "fluid/fluid_impl.h"

struct Preconditioner_s {
  Mat p; /* BAIJ like the momentum matrix, 3 unknowns an element: block k of the one is block k of the other
          */
  PC pc;
  Vec residual, correction; /* of one component */
};

/* PCSHELL: one component after the other */
static PetscErrorCode Apply(PC shell, Vec r, Vec z)
{
  struct Preconditioner_s *p;
  const PetscScalar *from, *solved;
  PetscScalar *to, *one;
  PetscInt n;
  PetscFunctionBeginUser;
  PetscCall(PCShellGetContext(shell, &p));
  PetscCall(VecGetLocalSize(p->residual, &n));
  PetscCall(VecGetArrayRead(r, &from));
  PetscCall(VecGetArrayWrite(z, &to));
  for (int c = 0; c < 2; c++) {
    PetscCall(VecGetArrayWrite(p->residual, &one));
    for (PetscInt e = 0; e < n / 3; e++)
      for (int i = 0; i < 3; i++) one[3 * e + i] = from[6 * e + 3 * c + i];
    PetscCall(VecRestoreArrayWrite(p->residual, &one));
    PetscCall(PCApply(p->pc, p->residual, p->correction));
    PetscCall(VecGetArrayRead(p->correction, &solved));
    for (PetscInt e = 0; e < n / 3; e++)
      for (int i = 0; i < 3; i++) to[6 * e + 3 * c + i] = solved[3 * e + i];
    PetscCall(VecRestoreArrayRead(p->correction, &solved));
  }
  PetscCall(VecRestoreArrayWrite(z, &to));
  PetscCall(VecRestoreArrayRead(r, &from));
  PetscFunctionReturn(0);
}

PetscErrorCode PreconditionerCreate(Fluid f)
{
  struct Preconditioner_s *p;
  PetscMPIInt size;
  PC shell;
  PetscFunctionBeginUser;
  PetscCall(PetscNew(&p));
  f->preconditioner = p;
  PetscCall(MomentumPattern(f->mesh, 3, &p->p));
  PetscCall(MatCreateVecs(p->p, &p->residual, &p->correction));
  PetscCall(PCCreate(f->mesh->comm, &p->pc));
  PetscCall(PCSetOptionsPrefix(p->pc, "momentum_component_"));
  PetscCall(PCSetOperators(p->pc, p->p, p->p));
  PetscCallMPI(MPI_Comm_size(f->mesh->comm, &size));
  /* on several ranks with overlap 1, which keeps the iterations of one rank */
  PetscCall(PCSetType(p->pc, size == 1 ? PCILU : PCASM));
  if (size == 1)
    PetscCall(PCFactorSetLevels(p->pc, 1));
  else
    PetscCall(FluidDefaultOption("-momentum_component_sub_pc_factor_levels", "1"));
  PetscCall(PCSetFromOptions(p->pc));
  PetscCall(KSPGetPC(f->momentum_ksp, &shell));
  PetscCall(PCSetType(shell, PCSHELL));
  PetscCall(PCShellSetName(shell, "component by component"));
  PetscCall(PCShellSetContext(shell, p));
  PetscCall(PCShellSetApply(shell, Apply));
  PetscFunctionReturn(0);
}

static PetscErrorCode CopyBlocks(Mat from, Mat to)
{
  const PetscInt *ia, *ja;
  PetscInt n;
  PetscBool done;
  PetscScalar *a, *p;
  PetscFunctionBeginUser;
  PetscCall(MatGetRowIJ(from, 0, PETSC_FALSE, PETSC_TRUE, &n, &ia, &ja, &done));
  PetscCall(MatSeqBAIJGetArray(from, &a));
  PetscCall(MatSeqBAIJGetArray(to, &p));
  for (PetscInt k = 0; k < ia[n]; k++)
    for (int j = 0; j < 3; j++)
      for (int i = 0; i < 3; i++)
        p[9 * k + 3 * j + i] = 0.5 * (a[36 * k + 6 * j + i] + a[36 * k + 21 + 6 * j + i]);
  PetscCall(MatSeqBAIJRestoreArray(to, &p));
  PetscCall(MatSeqBAIJRestoreArray(from, &a));
  PetscCall(MatRestoreRowIJ(from, 0, PETSC_FALSE, PETSC_TRUE, &n, &ia, &ja, &done));
  PetscFunctionReturn(0);
}

PetscErrorCode PreconditionerUpdate(Fluid f)
{
  struct Preconditioner_s *p = f->preconditioner;
  Mat a[2], b[2];
  const PetscInt *garray;
  PetscBool used;
  PC shell;
  PetscFunctionBeginUser;
  PetscCall(KSPGetPC(f->momentum_ksp, &shell));
  PetscCall(PetscObjectTypeCompare((PetscObject)shell, PCSHELL, &used));
  if (!used) PetscFunctionReturn(0); /* -momentum_pc_type has chosen another one */
  PetscCall(MatrixParts(f->momentum, &a[0], &a[1], &garray));
  PetscCall(MatrixParts(p->p, &b[0], &b[1], &garray));
  for (int k = 0; k < 2 && a[k]; k++) PetscCall(CopyBlocks(a[k], b[k]));
  PetscCall(MatAssemblyBegin(p->p, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(p->p, MAT_FINAL_ASSEMBLY));
  PetscCall(PCSetUp(p->pc));
  PetscFunctionReturn(0);
}

PetscErrorCode PreconditionerDestroy(Fluid f)
{
  struct Preconditioner_s *p = f->preconditioner;
  PetscFunctionBeginUser;
  PetscCall(VecDestroy(&p->residual));
  PetscCall(VecDestroy(&p->correction));
  PetscCall(PCDestroy(&p->pc));
  PetscCall(MatDestroy(&p->p));
  PetscCall(PetscFree(f->preconditioner));
  PetscFunctionReturn(0);
}
