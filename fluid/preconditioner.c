#include "fluid/preconditioner.h"
#include "fluid/element_matrix.h"
#include "fluid/solver_options.h"

struct Preconditioner_s {
  Mat p; /* BAIJ like the momentum matrix, 3 unknowns an element: block k of the one is block k of the other */
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

PetscErrorCode PreconditionerCreate(const Mesh *m, KSP ksp, Preconditioner *preconditioner)
{
  struct Preconditioner_s *p;
  PetscMPIInt size;
  PC shell;
  PetscFunctionBeginUser;
  PetscCall(PetscNew(&p));
  *preconditioner = p;
  PetscCall(ElementMatrixCreate(m, 3, &p->p));
  PetscCall(MatCreateVecs(p->p, &p->residual, &p->correction));
  PetscCall(PCCreate(m->comm, &p->pc));
  PetscCall(PCSetOptionsPrefix(p->pc, "momentum_component_"));
  PetscCall(PCSetOperators(p->pc, p->p, p->p));
  PetscCallMPI(MPI_Comm_size(m->comm, &size));
  /* on several ranks with overlap 1, which keeps the iterations of one rank */
  PetscCall(PCSetType(p->pc, size == 1 ? PCILU : PCASM));
  if (size == 1)
    PetscCall(PCFactorSetLevels(p->pc, 1));
  else
    PetscCall(SolverDefaultOption("momentum_component_", "sub_pc_factor_levels", "1"));
  PetscCall(PCSetFromOptions(p->pc));
  PetscCall(KSPGetPC(ksp, &shell));
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

PetscErrorCode PreconditionerUpdate(Preconditioner p, KSP ksp, Mat matrix)
{
  Mat a[2], b[2];
  PetscBool used;
  PC shell;
  PetscFunctionBeginUser;
  PetscCall(KSPGetPC(ksp, &shell));
  PetscCall(PetscObjectTypeCompare((PetscObject)shell, PCSHELL, &used));
  if (!used) PetscFunctionReturn(0); /* -momentum_pc_type has chosen another one */
  PetscCall(ElementMatrixParts(matrix, &a[0], &a[1], NULL));
  PetscCall(ElementMatrixParts(p->p, &b[0], &b[1], NULL));
  for (int k = 0; k < 2 && a[k]; k++) PetscCall(CopyBlocks(a[k], b[k]));
  PetscCall(MatAssemblyBegin(p->p, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(p->p, MAT_FINAL_ASSEMBLY));
  PetscCall(PCSetUp(p->pc));
  PetscFunctionReturn(0);
}

PetscErrorCode PreconditionerDestroy(Preconditioner *preconditioner)
{
  Preconditioner p = *preconditioner;
  PetscFunctionBeginUser;
  if (!p) PetscFunctionReturn(0);
  PetscCall(VecDestroy(&p->residual));
  PetscCall(VecDestroy(&p->correction));
  PetscCall(PCDestroy(&p->pc));
  PetscCall(MatDestroy(&p->p));
  PetscCall(PetscFree(*preconditioner));
  PetscFunctionReturn(0);
}
