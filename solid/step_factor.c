/* The preconditioner of the step's response. */
#include "solid/step_response_impl.h"

PetscErrorCode StepFactorCreate(StepResponse a)
{
  const int n = a->nnodes, nblocks = a->start[n];
  PetscInt *first, *column;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(2 * (size_t)n + 1, &first, 4 * (size_t)nblocks, &column));
  first[0] = 0;
  for (int row = 0, at = 0; row < 2 * n; row++) {
    for (int k = 2 * a->start[row / 2]; k < 2 * a->start[row / 2 + 1]; k++)
      column[at++] = 2 * a->column[k / 2] + k % 2;
    first[row + 1] = at;
  }
  PetscCall(MatCreateSeqAIJ(PETSC_COMM_SELF, 2 * n, 2 * n, 0, NULL, &a->matrix));
  PetscCall(MatSeqAIJSetPreallocationCSR(a->matrix, first, column, NULL));
  PetscCall(MatSetOption(a->matrix, MAT_SPD, PETSC_TRUE));
  PetscCall(MatCreateVecs(a->matrix, &a->right, &a->left));
  PetscCall(PCCreate(PETSC_COMM_SELF, &a->factor));
  PetscCall(PCSetOptionsPrefix(a->factor, "response_"));
  PetscCall(PCSetType(a->factor, PCCHOLESKY));
  PetscCall(PCFactorSetMatOrderingType(a->factor, MATORDERINGND));
  PetscCall(PCSetOperators(a->factor, a->matrix, a->matrix));
  PetscCall(PCSetFromOptions(a->factor));
  PetscCall(PetscFree2(first, column));
  PetscFunctionReturn(0);
}

PetscErrorCode StepFactorUpdate(StepResponse a, Solid s, double c)
{
  double *value;
  PetscFunctionBeginUser;
  for (int i = 0; i < a->nnodes; i++) a->diagonal[i] = 0.0;
  PetscCall(MatSeqAIJGetArray(a->matrix, &value));
  for (int row = 0, at = 0; row < 2 * a->nnodes; row++) {
    const int i = row / 2, held = a->held[row];
    for (int k = 2 * a->start[i]; k < 2 * a->start[i + 1]; k++, at++) {
      const int column = 2 * a->column[k / 2] + k % 2;
      value[at] = held || a->held[column] ? 0.0 : c * a->block[k / 2][2 * (row % 2) + k % 2];
      if (column != row) continue;
      a->diagonal[i] += c * a->block[k / 2][3 * (row % 2)] + a->part[i] * s->mass[i];
      value[at] += held ? 1.0 : a->part[i] * s->mass[i];
    }
  }
  PetscCall(MatSeqAIJRestoreArray(a->matrix, &value));
  PetscCall(PCSetUp(a->factor));
  PetscFunctionReturn(0);
}

PetscErrorCode StepFactorWeigh(StepResponse a, Solid s)
{
  PetscFunctionBeginUser;
  PetscCall(PetscArraycpy(a->weight, a->diagonal, (size_t)a->nnodes));
  PetscCall(CopiesSum(s->copies, 1, a->weight));
  for (int i = 0; i < a->nnodes; i++) a->weight[i] = a->diagonal[i] / a->weight[i];
  PetscFunctionReturn(0);
}

/* The rotation of the elements around each node: that of the sum of their F. */
void StepFactorTurn(StepResponse a, Solid s, PetscBool turned)
{
  for (int i = 0; i < a->nnodes; i++) a->turn[i][0] = a->turn[i][1] = 0.0;
  for (int k = 0; turned && k < a->nelements; k++) {
    Tensor edges, f;
    SolidElementShape(&s->elements, k, s->x, &edges, &f);
    for (int i = 0; i < 3; i++) {
      a->turn[a->element[3 * k + i]][0] += f.xx + f.yy;
      a->turn[a->element[3 * k + i]][1] += f.yx - f.xy;
    }
  }
  for (int i = 0; i < a->nnodes; i++) {
    const int held = a->held[2 * i] || a->held[2 * i + 1];
    const double size = held ? 0.0 : hypot(a->turn[i][0], a->turn[i][1]);
    for (int c = 0; c < 2; c++) a->turn[i][c] = size > 0.0 ? a->turn[i][c] / size : 1.0 - c;
  }
}

PetscErrorCode StepFactorApply(StepResponse a, Solid s, const double r[], double z[])
{
  double *right;
  const double *left;
  PetscFunctionBeginUser;
  PetscCall(VecGetArrayWrite(a->right, &right));
  for (int i = 0; i < a->nnodes; i++) {
    const double x = a->weight[i] * r[2 * i], y = a->weight[i] * r[2 * i + 1], *t = a->turn[i];
    right[2 * i] = t[0] * x + t[1] * y;
    right[2 * i + 1] = t[0] * y - t[1] * x;
  }
  PetscCall(VecRestoreArrayWrite(a->right, &right));
  PetscCall(PCApply(a->factor, a->right, a->left));
  PetscCall(VecGetArrayRead(a->left, &left));
  for (int i = 0; i < a->nnodes; i++) {
    const double x = a->weight[i] * left[2 * i], y = a->weight[i] * left[2 * i + 1], *t = a->turn[i];
    z[2 * i] = t[0] * x - t[1] * y;
    z[2 * i + 1] = t[0] * y + t[1] * x;
  }
  PetscCall(VecRestoreArrayRead(a->left, &left));
  PetscCall(CopiesSum(s->copies, 2, z));
  PetscFunctionReturn(0);
}
