#include "fluid/pressure/patch_correction.h"
#include "fluid/discretization/solver_options.h"

struct PatchCorrection_s {
  Mat matrix; /* borrowed */
  PetscBool active;
  PetscInt n, *own; /* [n] the patches' rows, from the rank's first on */
  Mat rows;         /* R A */
  KSP solver;       /* of R A R^T + l, this rank's */
  Vec left, delta;  /* R residual, what z changes by: as the rank's solver sees them */
  Vec image, part;  /* A R^T delta; R A change */
};

PetscErrorCode PatchCorrectionCreate(Mat matrix, PatchCorrection *patch)
{
  PatchCorrection p;
  PetscFunctionBeginUser;
  PetscCall(PetscNew(&p));
  p->matrix = matrix;
  PetscCall(MatCreateVecs(matrix, NULL, &p->image));
  *patch = p;
  PetscFunctionReturn(0);
}

PetscErrorCode PatchCorrectionClear(PatchCorrection p)
{
  PetscFunctionBeginUser;
  p->active = PETSC_FALSE;
  PetscCall(PetscFree(p->own));
  PetscCall(MatDestroy(&p->rows));
  PetscCall(KSPDestroy(&p->solver));
  PetscCall(VecDestroy(&p->left));
  PetscCall(VecDestroy(&p->delta));
  PetscCall(VecDestroy(&p->part));
  PetscFunctionReturn(0);
}

PetscErrorCode PatchCorrectionDestroy(PatchCorrection *patch)
{
  PatchCorrection p = *patch;
  PetscFunctionBeginUser;
  if (!p) PetscFunctionReturn(0);
  PetscCall(PatchCorrectionClear(p));
  PetscCall(VecDestroy(&p->image));
  PetscCall(PetscFree(*patch));
  PetscFunctionReturn(0);
}

/* R A */
static PetscErrorCode TakeRows(PatchCorrection p, const PetscInt row[])
{
  const MPI_Comm comm = PetscObjectComm((PetscObject)p->matrix);
  PetscInt first, last;
  IS patches, all;
  PetscFunctionBeginUser;
  PetscCall(MatGetOwnershipRangeColumn(p->matrix, &first, &last));
  PetscCall(ISCreateGeneral(comm, p->n, row, PETSC_USE_POINTER, &patches));
  PetscCall(ISCreateStride(comm, last - first, first, 1, &all));
  PetscCall(MatCreateSubMatrix(p->matrix, patches, all, MAT_INITIAL_MATRIX, &p->rows));
  PetscCall(MatCreateVecs(p->rows, NULL, &p->part));
  PetscCall(ISDestroy(&all));
  PetscCall(ISDestroy(&patches));
  PetscFunctionReturn(0);
}

/* R A R^T + l and its factor */
static PetscErrorCode MakeSolver(PatchCorrection p, const double held[])
{
  Mat block, own;
  IS patches;
  PetscFunctionBeginUser;
  PetscCall(MatGetDiagonalBlock(p->matrix, &block));
  PetscCall(ISCreateGeneral(PETSC_COMM_SELF, p->n, p->own, PETSC_USE_POINTER, &patches));
  PetscCall(MatCreateSubMatrix(block, patches, patches, MAT_INITIAL_MATRIX, &own));
  PetscCall(ISDestroy(&patches));
  PetscCall(MatCreateVecs(own, &p->delta, &p->left));
  for (PetscInt k = 0; k < p->n; k++) PetscCall(MatSetValue(own, k, k, held[p->own[k]], ADD_VALUES));
  PetscCall(MatAssemblyBegin(own, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(own, MAT_FINAL_ASSEMBLY));
  PetscCall(MatSetOption(own, MAT_SPD, PETSC_TRUE));
  PetscCall(SolverCreateDirect(PETSC_COMM_SELF, "pressure_patch_", KSPPREONLY, &p->solver));
  PetscCall(KSPSetOperators(p->solver, own, own));
  PetscCall(KSPSetFromOptions(p->solver));
  if (p->n > 0) PetscCall(KSPSetUp(p->solver));
  PetscCall(MatDestroy(&own));
  PetscFunctionReturn(0);
}

PetscErrorCode PatchCorrectionUpdate(PatchCorrection p, PetscInt n, const PetscInt row[], const double held[])
{
  PetscInt first;
  PetscFunctionBeginUser;
  PetscCall(PatchCorrectionClear(p));
  p->active = PETSC_TRUE;
  p->n = n;
  PetscCall(MatGetOwnershipRange(p->matrix, &first, NULL));
  PetscCall(PetscMalloc1(n, &p->own));
  for (PetscInt k = 0; k < n; k++) p->own[k] = row[k] - first;
  PetscCall(TakeRows(p, row));
  PetscCall(MakeSolver(p, held));
  PetscFunctionReturn(0);
}

PetscBool PatchCorrectionActive(PatchCorrection p)
{
  return p->active;
}

/* delta = (R A R^T + l)^-1 R residual, z += R^T delta */
static PetscErrorCode Correct(PatchCorrection p, Vec residual, Vec z)
{
  const PetscScalar *from;
  PetscScalar *to;
  PetscFunctionBeginUser;
  if (p->n == 0) PetscFunctionReturn(0);
  PetscCall(VecGetArrayRead(residual, &from));
  PetscCall(VecGetArrayWrite(p->left, &to));
  for (PetscInt k = 0; k < p->n; k++) to[k] = from[p->own[k]];
  PetscCall(VecRestoreArrayWrite(p->left, &to));
  PetscCall(VecRestoreArrayRead(residual, &from));
  PetscCall(KSPSolve(p->solver, p->left, p->delta));
  PetscCall(VecGetArrayRead(p->delta, &from));
  PetscCall(VecGetArray(z, &to));
  for (PetscInt k = 0; k < p->n; k++) to[p->own[k]] += from[k];
  PetscCall(VecRestoreArray(z, &to));
  PetscCall(VecRestoreArrayRead(p->delta, &from));
  PetscFunctionReturn(0);
}

PetscErrorCode PatchCorrectionFirst(PatchCorrection p, Vec residual, Vec z)
{
  const PetscScalar *delta;
  PetscScalar *part;
  PetscFunctionBeginUser;
  PetscCall(Correct(p, residual, z));
  PetscCall(VecGetArrayRead(p->delta, &delta));
  PetscCall(VecGetArrayWrite(p->part, &part));
  PetscCall(PetscArraycpy(part, delta, p->n));
  PetscCall(VecRestoreArrayWrite(p->part, &part));
  PetscCall(VecRestoreArrayRead(p->delta, &delta));
  PetscCall(MatMultTranspose(p->rows, p->part, p->image));
  PetscCall(VecAXPY(residual, -1.0, p->image));
  PetscFunctionReturn(0);
}

PetscErrorCode PatchCorrectionSecond(PatchCorrection p, Vec change, Vec residual, Vec z)
{
  const PetscScalar *part;
  PetscScalar *left;
  PetscFunctionBeginUser;
  PetscCall(MatMult(p->rows, change, p->part));
  PetscCall(VecGetArrayRead(p->part, &part));
  PetscCall(VecGetArray(residual, &left));
  for (PetscInt k = 0; k < p->n; k++) left[p->own[k]] -= part[k];
  PetscCall(VecRestoreArray(residual, &left));
  PetscCall(VecRestoreArrayRead(p->part, &part));
  PetscCall(Correct(p, residual, z));
  PetscFunctionReturn(0);
}
