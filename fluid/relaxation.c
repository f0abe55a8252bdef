#include "fluid/relaxation.h"

struct Relaxation_s {
  Mat matrix; /* borrowed: A */
  Mat raised; /* A with l on its diagonal; on one rank A itself */
  Vec residual, update;
};

PetscErrorCode RelaxationCreate(Mat matrix, Relaxation *relaxation)
{
  Relaxation s;
  PetscMPIInt ranks;
  PetscFunctionBeginUser;
  PetscCall(PetscNew(&s));
  PetscCallMPI(MPI_Comm_size(PetscObjectComm((PetscObject)matrix), &ranks));
  s->matrix = matrix;
  s->raised = ranks == 1 ? matrix : NULL;
  PetscCall(MatCreateVecs(matrix, &s->update, &s->residual));
  *relaxation = s;
  PetscFunctionReturn(0);
}

PetscErrorCode RelaxationDestroy(Relaxation *relaxation)
{
  Relaxation s = *relaxation;
  PetscFunctionBeginUser;
  if (!s) PetscFunctionReturn(0);
  if (s->raised != s->matrix) PetscCall(MatDestroy(&s->raised));
  PetscCall(VecDestroy(&s->residual));
  PetscCall(VecDestroy(&s->update));
  PetscCall(PetscFree(*relaxation));
  PetscFunctionReturn(0);
}

/* l[i] = half of the absolute sum of row i over the columns of other ranks */
static PetscErrorCode HalfOffRankSums(Mat matrix, Vec l)
{
  Mat off;
  PetscInt rows;
  PetscScalar *sum;
  PetscFunctionBeginUser;
  PetscCall(MatMPIAIJGetSeqAIJ(matrix, NULL, &off, NULL));
  PetscCall(MatGetSize(off, &rows, NULL));
  PetscCall(VecGetArrayWrite(l, &sum));
  for (PetscInt i = 0; i < rows; i++) {
    const PetscScalar *value;
    PetscInt n;
    sum[i] = 0.0;
    PetscCall(MatGetRow(off, i, &n, NULL, &value));
    for (PetscInt k = 0; k < n; k++) sum[i] += 0.5 * PetscAbsScalar(value[k]);
    PetscCall(MatRestoreRow(off, i, &n, NULL, &value));
  }
  PetscCall(VecRestoreArrayWrite(l, &sum));
  PetscFunctionReturn(0);
}

PetscErrorCode RelaxationUpdate(Relaxation s)
{
  PetscFunctionBeginUser;
  if (s->raised == s->matrix) PetscFunctionReturn(0);
  if (!s->raised) PetscCall(MatDuplicate(s->matrix, MAT_DO_NOT_COPY_VALUES, &s->raised));
  PetscCall(MatCopy(s->matrix, s->raised, SAME_NONZERO_PATTERN));
  PetscCall(HalfOffRankSums(s->matrix, s->update));
  PetscCall(MatDiagonalSet(s->raised, s->update, ADD_VALUES));
  PetscFunctionReturn(0);
}

PetscErrorCode RelaxationForward(Relaxation s, Vec r, Vec z)
{
  const MatSORType forward = (MatSORType)(SOR_LOCAL_FORWARD_SWEEP | SOR_ZERO_INITIAL_GUESS);
  PetscFunctionBeginUser;
  PetscCall(MatSOR(s->raised, r, 1.0, forward, 0.0, 1, 1, z));
  PetscFunctionReturn(0);
}

PetscErrorCode RelaxationResidual(Relaxation s, Vec r, Vec z, Vec *residual)
{
  PetscFunctionBeginUser;
  PetscCall(MatMult(s->matrix, z, s->residual));
  PetscCall(VecAYPX(s->residual, -1.0, r));
  *residual = s->residual;
  PetscFunctionReturn(0);
}

/* On one rank that is a sweep over z itself. */
PetscErrorCode RelaxationBackward(Relaxation s, Vec r, Vec z)
{
  const MatSORType backward = (MatSORType)(SOR_LOCAL_BACKWARD_SWEEP | SOR_ZERO_INITIAL_GUESS);
  Vec residual = NULL;
  PetscFunctionBeginUser;
  if (s->raised == s->matrix) {
    PetscCall(MatSOR(s->matrix, r, 1.0, SOR_LOCAL_BACKWARD_SWEEP, 0.0, 1, 1, z));
    PetscFunctionReturn(0);
  }
  PetscCall(RelaxationResidual(s, r, z, &residual));
  PetscCall(MatSOR(s->raised, residual, 1.0, backward, 0.0, 1, 1, s->update));
  PetscCall(VecAXPY(z, 1.0, s->update));
  PetscFunctionReturn(0);
}
