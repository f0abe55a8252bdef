#include "fluid/pressure/relaxation.h"

struct Relaxation_s {
  Mat own;     /* borrowed: this rank's block of A */
  Mat between; /* borrowed: B, its columns of other ranks; NULL on one rank */
  VecScatter scatter;
  Vec ghosts;       /* of z in B's columns */
  PetscInt n;       /* rows */
  PetscInt *start;  /* [n + 1] of the rows of L, the lower triangle of `own`; U is its transpose */
  PetscInt *column; /* of L */
  float *value;     /* of L */
  double *inverse;  /* [n] 1/(D + l) */
  double *held;     /* [n] l */
  Vec residual;
};

/* Rows of a sequential matrix, borrowed. */
typedef struct {
  PetscInt n;
  const PetscInt *start, *column;
  const PetscScalar *value;
} Rows;

static PetscErrorCode GetRows(Mat matrix, Rows *rows)
{
  PetscBool done;
  PetscFunctionBeginUser;
  PetscCall(MatGetRowIJ(matrix, 0, PETSC_FALSE, PETSC_FALSE, &rows->n, &rows->start, &rows->column, &done));
  PetscCall(MatSeqAIJGetArrayRead(matrix, &rows->value));
  PetscFunctionReturn(0);
}

static PetscErrorCode RestoreRows(Mat matrix, Rows *rows)
{
  PetscBool done;
  PetscFunctionBeginUser;
  PetscCall(MatSeqAIJRestoreArrayRead(matrix, &rows->value));
  PetscCall(
      MatRestoreRowIJ(matrix, 0, PETSC_FALSE, PETSC_FALSE, &rows->n, &rows->start, &rows->column, &done));
  PetscFunctionReturn(0);
}

/* L's place for `own`: the entries of each row before its diagonal. */
static PetscErrorCode CreateLower(Relaxation s)
{
  Rows own;
  PetscFunctionBeginUser;
  PetscCall(GetRows(s->own, &own));
  s->n = own.n;
  PetscCall(PetscMalloc3(s->n + 1, &s->start, s->n, &s->inverse, s->n, &s->held));
  PetscCall(PetscArrayzero(s->held, s->n));
  s->start[0] = 0;
  for (PetscInt i = 0; i < s->n; i++) {
    PetscInt k = own.start[i];
    while (k < own.start[i + 1] && own.column[k] < i) k++;
    PetscCheck(k < own.start[i + 1] && own.column[k] == i, PETSC_COMM_SELF, PETSC_ERR_ARG_WRONGSTATE,
               "row %d has no diagonal", (int)i);
    s->start[i + 1] = s->start[i] + k - own.start[i];
  }
  PetscCall(PetscMalloc2(s->start[s->n], &s->column, s->start[s->n], &s->value));
  for (PetscInt i = 0; i < s->n; i++)
    PetscCall(
        PetscArraycpy(s->column + s->start[i], own.column + own.start[i], s->start[i + 1] - s->start[i]));
  PetscCall(RestoreRows(s->own, &own));
  PetscFunctionReturn(0);
}

static PetscErrorCode CreateScatter(Relaxation s, Mat matrix)
{
  const PetscInt *column;
  PetscInt n;
  IS from;
  PetscFunctionBeginUser;
  PetscCall(MatMPIAIJGetSeqAIJ(matrix, &s->own, &s->between, &column));
  PetscCall(MatGetSize(s->between, NULL, &n));
  PetscCall(ISCreateGeneral(PETSC_COMM_SELF, n, column, PETSC_COPY_VALUES, &from));
  PetscCall(VecCreateSeq(PETSC_COMM_SELF, n, &s->ghosts));
  PetscCall(VecScatterCreate(s->residual, from, s->ghosts, NULL, &s->scatter));
  PetscCall(ISDestroy(&from));
  PetscFunctionReturn(0);
}

PetscErrorCode RelaxationCreate(Mat matrix, Relaxation *relaxation)
{
  Relaxation s;
  PetscMPIInt ranks;
  PetscFunctionBeginUser;
  PetscCall(PetscNew(&s));
  PetscCallMPI(MPI_Comm_size(PetscObjectComm((PetscObject)matrix), &ranks));
  PetscCall(MatCreateVecs(matrix, NULL, &s->residual));
  s->own = matrix;
  if (ranks > 1) PetscCall(CreateScatter(s, matrix));
  PetscCall(CreateLower(s));
  *relaxation = s;
  PetscFunctionReturn(0);
}

PetscErrorCode RelaxationDestroy(Relaxation *relaxation)
{
  Relaxation s = *relaxation;
  PetscFunctionBeginUser;
  if (!s) PetscFunctionReturn(0);
  PetscCall(PetscFree3(s->start, s->inverse, s->held));
  PetscCall(PetscFree2(s->column, s->value));
  PetscCall(VecDestroy(&s->residual));
  PetscCall(VecDestroy(&s->ghosts));
  PetscCall(VecScatterDestroy(&s->scatter));
  PetscCall(PetscFree(*relaxation));
  PetscFunctionReturn(0);
}

/* l[i] = half of the absolute sum of row i over the columns of other ranks */
static PetscErrorCode SetHeld(Relaxation s)
{
  Rows b;
  PetscFunctionBeginUser;
  PetscCall(GetRows(s->between, &b));
  for (PetscInt i = 0; i < b.n; i++) {
    s->held[i] = 0.0;
    for (PetscInt k = b.start[i]; k < b.start[i + 1]; k++) s->held[i] += 0.5 * PetscAbsScalar(b.value[k]);
  }
  PetscCall(RestoreRows(s->between, &b));
  PetscFunctionReturn(0);
}

PetscErrorCode RelaxationUpdate(Relaxation s)
{
  Rows own;
  PetscFunctionBeginUser;
  if (s->between) PetscCall(SetHeld(s));
  PetscCall(GetRows(s->own, &own));
  for (PetscInt i = 0; i < s->n; i++) {
    const PetscScalar *row = own.value + own.start[i];
    const PetscInt n = s->start[i + 1] - s->start[i];
    for (PetscInt k = 0; k < n; k++) s->value[s->start[i] + k] = (float)row[k];
    s->inverse[i] = 1.0 / (row[n] + s->held[i]);
  }
  PetscCall(RestoreRows(s->own, &own));
  PetscFunctionReturn(0);
}

const double *RelaxationHeld(Relaxation s)
{
  return s->held;
}

/* y -= B z */
static PetscErrorCode SubtractBetween(Relaxation s, Vec z, double y[])
{
  const PetscScalar *ghost;
  Rows b;
  PetscFunctionBeginUser;
  if (!s->between) PetscFunctionReturn(0);
  PetscCall(VecScatterBegin(s->scatter, z, s->ghosts, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecScatterEnd(s->scatter, z, s->ghosts, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(GetRows(s->between, &b));
  PetscCall(VecGetArrayRead(s->ghosts, &ghost));
  for (PetscInt i = 0; i < b.n; i++)
    for (PetscInt k = b.start[i]; k < b.start[i + 1]; k++) y[i] -= b.value[k] * ghost[b.column[k]];
  PetscCall(VecRestoreArrayRead(s->ghosts, &ghost));
  PetscCall(RestoreRows(s->between, &b));
  PetscFunctionReturn(0);
}

/* sum - (L z)_i */
static inline double Above(const Relaxation s, PetscInt i, const double z[], double sum)
{
  for (PetscInt k = s->start[i]; k < s->start[i + 1]; k++) sum -= (double)s->value[k] * z[s->column[k]];
  return sum;
}

/* y -= U z: what z_i alone has in it */
static inline void SubtractColumn(const Relaxation s, PetscInt i, double z, double y[])
{
  for (PetscInt k = s->start[i]; k < s->start[i + 1]; k++) y[s->column[k]] -= (double)s->value[k] * z;
}

PetscErrorCode RelaxationForward(Relaxation s, Vec r, Vec z, Vec *residual)
{
  const PetscScalar *right;
  PetscScalar *x, *left;
  PetscFunctionBeginUser;
  PetscCall(VecGetArrayRead(r, &right));
  PetscCall(VecGetArrayWrite(z, &x));
  PetscCall(VecGetArrayWrite(s->residual, &left));
  for (PetscInt i = 0; i < s->n; i++) {
    x[i] = s->inverse[i] * Above(s, i, x, right[i]);
    left[i] = s->held[i] * x[i];
    SubtractColumn(s, i, x[i], left);
  }
  PetscCall(VecRestoreArrayWrite(z, &x));
  PetscCall(VecRestoreArrayRead(r, &right));
  PetscCall(SubtractBetween(s, z, left));
  PetscCall(VecRestoreArrayWrite(s->residual, &left));
  *residual = s->residual;
  PetscFunctionReturn(0);
}

PetscErrorCode RelaxationBackward(Relaxation s, Vec r, Vec z)
{
  PetscScalar *x, *right;
  PetscFunctionBeginUser;
  PetscCall(VecCopy(r, s->residual));
  PetscCall(VecGetArray(s->residual, &right));
  PetscCall(SubtractBetween(s, z, right));
  PetscCall(VecGetArray(z, &x));
  for (PetscInt i = s->n - 1; i >= 0; i--) {
    x[i] = s->inverse[i] * Above(s, i, x, right[i] + s->held[i] * x[i]);
    SubtractColumn(s, i, x[i], right);
  }
  PetscCall(VecRestoreArray(z, &x));
  PetscCall(VecRestoreArray(s->residual, &right));
  PetscFunctionReturn(0);
}
