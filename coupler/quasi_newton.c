#include "coupler/quasi_newton.h"

/* More columns, of other contacts than those now, make the system ill-conditioned: fragments that lie on each other took 12 iterations a step
 * with 30 columns, and made steps of 90 times the residual, 5 with 4 to 12.  Light discs take as many with 8 as with 30. */
enum { MAX_COLUMNS = 8 };

/* A column is dropped when its part orthogonal to newer columns is smaller than this fraction of it. */
#define FILTER 1e-3

/* Relaxation of an iteration without columns: the first of the first solve. */
#define RELAXATION 0.5

typedef struct {
  double *v, *w; /* [n] */
} Column;

struct QuasiNewton_s {
  MPI_Comm comm;
  int n, ncolumns;
  Column column[MAX_COLUMNS]; /* the newest first */
  double *q[MAX_COLUMNS];     /* [n] */
  double *r, *hx;             /* [n] residual and H(x) of the previous iteration */
  PetscBool has_previous;     /* in this solve */
};

static PetscErrorCode FreeColumn(Column *c)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree2(c->v, c->w));
  PetscFunctionReturn(0);
}

static PetscErrorCode Reset(QuasiNewton a, int n)
{
  PetscFunctionBeginUser;
  for (int k = 0; k < a->ncolumns; k++) PetscCall(FreeColumn(&a->column[k]));
  for (int k = 0; k < MAX_COLUMNS; k++) PetscCall(PetscFree(a->q[k]));
  PetscCall(PetscFree2(a->r, a->hx));
  a->ncolumns = 0;
  a->n = n;
  if (n < 0) PetscFunctionReturn(0);
  PetscCall(PetscMalloc2((size_t)n, &a->r, (size_t)n, &a->hx));
  for (int k = 0; k < MAX_COLUMNS; k++) PetscCall(PetscMalloc1((size_t)n, &a->q[k]));
  PetscFunctionReturn(0);
}

PetscErrorCode QuasiNewtonCreate(MPI_Comm comm, QuasiNewton *acceleration)
{
  PetscFunctionBeginUser;
  PetscCall(PetscNew(acceleration));
  (*acceleration)->comm = comm;
  (*acceleration)->n = -1;
  PetscFunctionReturn(0);
}

PetscErrorCode QuasiNewtonDestroy(QuasiNewton *acceleration)
{
  PetscFunctionBeginUser;
  if (!*acceleration) PetscFunctionReturn(0);
  PetscCall(Reset(*acceleration, -1));
  PetscCall(PetscFree(*acceleration));
  PetscFunctionReturn(0);
}

PetscErrorCode QuasiNewtonBegin(QuasiNewton a, int n)
{
  int other = a->n != n;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &other, 1, MPI_INT, MPI_LOR, a->comm));
  if (other) PetscCall(Reset(a, n));
  a->has_previous = PETSC_FALSE;
  PetscFunctionReturn(0);
}

/* The differences to the previous iteration become column 0. */
static PetscErrorCode AddColumn(QuasiNewton a, const double x[], const double hx[])
{
  Column c;

  PetscFunctionBeginUser;
  if (a->ncolumns == MAX_COLUMNS) PetscCall(FreeColumn(&a->column[--a->ncolumns]));
  PetscCall(PetscMalloc2((size_t)a->n, &c.v, (size_t)a->n, &c.w));
  for (int i = 0; i < a->n; i++) {
    c.v[i] = hx[i] - x[i] - a->r[i];
    c.w[i] = hx[i] - a->hx[i];
  }
  for (int k = a->ncolumns++; k > 0; k--) a->column[k] = a->column[k - 1];
  a->column[0] = c;
  PetscFunctionReturn(0);
}

static PetscErrorCode Dot(QuasiNewton a, const double x[], const double y[], double *dot)
{
  PetscFunctionBeginUser;
  *dot = 0.0;
  for (int i = 0; i < a->n; i++) *dot += x[i] * y[i];
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, dot, 1, MPI_DOUBLE, MPI_SUM, a->comm));
  PetscFunctionReturn(0);
}

/* Gram-Schmidt: q[k] from column k, and r[0 .. k][k] of V = Q R; *independent: it passes the filter. */
static PetscErrorCode Orthogonal(QuasiNewton a, int k, double r[][MAX_COLUMNS], PetscBool *independent)
{
  double norm2, remainder2;

  PetscFunctionBeginUser;
  PetscCall(PetscArraycpy(a->q[k], a->column[k].v, a->n));
  PetscCall(Dot(a, a->q[k], a->q[k], &norm2));
  for (int j = 0; j < k; j++) {
    PetscCall(Dot(a, a->q[j], a->q[k], &r[j][k]));
    for (int i = 0; i < a->n; i++) a->q[k][i] -= r[j][k] * a->q[j][i];
  }
  PetscCall(Dot(a, a->q[k], a->q[k], &remainder2));
  *independent = remainder2 > FILTER * FILTER * norm2 ? PETSC_TRUE : PETSC_FALSE;
  if (!*independent) PetscFunctionReturn(0);
  r[k][k] = sqrt(remainder2);
  for (int i = 0; i < a->n; i++) a->q[k][i] /= r[k][k];
  PetscFunctionReturn(0);
}

/* V = Q R of the independent columns; the others are dropped. */
static PetscErrorCode Factor(QuasiNewton a, double r[][MAX_COLUMNS])
{
  PetscFunctionBeginUser;
  for (int k = 0; k < a->ncolumns;) {
    PetscBool independent = PETSC_FALSE;
    PetscCall(Orthogonal(a, k, r, &independent));
    if (independent) {
      k++;
      continue;
    }
    PetscCall(FreeColumn(&a->column[k]));
    a->ncolumns--;
    for (int j = k; j < a->ncolumns; j++) a->column[j] = a->column[j + 1];
  }
  PetscFunctionReturn(0);
}

PetscErrorCode QuasiNewtonNext(QuasiNewton a, const double x[], const double hx[], double next[])
{
  double r[MAX_COLUMNS][MAX_COLUMNS], c[MAX_COLUMNS];

  PetscFunctionBeginUser;
  if (a->has_previous) PetscCall(AddColumn(a, x, hx));
  for (int i = 0; i < a->n; i++) {
    a->r[i] = hx[i] - x[i];
    a->hx[i] = hx[i];
  }
  a->has_previous = PETSC_TRUE;
  PetscCall(Factor(a, r));
  for (int k = a->ncolumns - 1; k >= 0; k--) { /* R c = -Q^T r */
    PetscCall(Dot(a, a->q[k], a->r, &c[k]));
    c[k] = -c[k];
    for (int j = k + 1; j < a->ncolumns; j++) c[k] -= r[k][j] * c[j];
    c[k] /= r[k][k];
  }
  for (int i = 0; i < a->n; i++) next[i] = a->ncolumns ? hx[i] : x[i] + RELAXATION * a->r[i];
  for (int k = 0; k < a->ncolumns; k++)
    for (int i = 0; i < a->n; i++) next[i] += c[k] * a->column[k].w[i];
  PetscFunctionReturn(0);
}
