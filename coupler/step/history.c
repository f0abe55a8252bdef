#include "coupler/step/history.h"
#include "common/exchange/copies.h"
#include <math.h>
#include <stdlib.h>

static PetscErrorCode Resize(History *h, const SolidState *solid)
{
  const size_t n = (size_t)solid->nnodes;

  PetscFunctionBeginUser;
  PetscCall(HistoryDestroy(h));
  PetscCall(PetscMalloc7(n, &h->gid, n, &h->acceleration, n, &h->earlier, n, &h->lasting, n, &h->outside, n,
                         &h->against, n, &h->retained));
  PetscCall(PetscArrayzero(h->against, n));
  PetscCall(PetscArraycpy(h->gid, solid->gid, n));
  PetscCall(PetscArrayzero(h->acceleration, n));
  PetscCall(PetscArrayzero(h->earlier, n));
  PetscCall(PetscArrayzero(h->lasting, n));
  PetscCall(PetscArrayzero(h->outside, n));
  PetscCall(PetscArrayzero(h->retained, n));
  h->n = solid->nnodes;
  PetscFunctionReturn(0);
}

/* What part of a is in b, 0 .. 1. */
static double Common(const double a[2], const double b[2])
{
  const double common = a[0] * b[0] + a[1] * b[1], square = a[0] * a[0] + a[1] * a[1];
  return common <= 0.0 ? 0.0 : common < square ? common / square : 1.0;
}

PetscErrorCode HistoryStep(History *h, const SolidState *moved, double dt, const double start[],
                           const double outside[], const double against[])
{
  int changed = moved->changed;
  double(*before)[2][2]; /* a^{n-1}, a^{n-2} */
  PetscBool same = (PetscBool)(h->known && h->n == moved->nnodes);

  PetscFunctionBeginUser;
  if (same) PetscCall(PetscArraycmp(h->gid, moved->gid, h->n, &same));
  PetscCall(PetscMalloc1(moved->nnodes, &before));
  for (int i = 0; i < h->n && same; i++) {
    PetscCall(PetscArraycpy(before[i][0], h->acceleration[i], 2));
    PetscCall(PetscArraycpy(before[i][1], h->earlier[i], 2));
  }
  PetscCall(Resize(h, moved));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &changed, 1, MPI_INT, MPI_LOR, h->comm));
  h->known = changed ? PETSC_FALSE : PETSC_TRUE;
  for (int i = 0; i < h->n && h->known; i++) {
    double *a = h->acceleration[i];
    for (int c = 0; c < 2; c++) {
      a[c] = (moved->u[2 * i + c] - start[2 * i + c]) / dt;
      h->outside[i][c] = outside[2 * i + c];
      h->against[i][c] = against[2 * i + c];
    }
    const double part = same ? fmin(Common(a, before[i][0]), Common(a, before[i][1])) : 1.0;
    for (int c = 0; c < 2; c++) {
      h->earlier[i][c] = same ? before[i][0][c] : a[c];
      h->lasting[i][c] = part * a[c];
    }
  }
  PetscCall(PetscFree(before));
  PetscFunctionReturn(0);
}

enum {
  ACCELERATION,
  EARLIER = ACCELERATION + 2,
  LASTING = EARLIER + 2,
  OUTSIDE = LASTING + 2,
  AGAINST = OUTSIDE + 2,
  RETAINED = AGAINST + 2,
  NCOLUMNS = RETAINED + 2
};

typedef struct {
  long long gid;
  double value[NCOLUMNS];
} Row;

static int CompareRows(const void *a, const void *b)
{
  const Row *p = a, *q = b;
  return (p->gid > q->gid) - (p->gid < q->gid);
}

PetscErrorCode HistorySave(const History *h, Checkpoint to)
{
  double(*value)[NCOLUMNS];

  PetscFunctionBeginUser;
  PetscCall(CheckpointPutNumber(to, "history known", h->known));
  PetscCall(PetscMalloc1(h->n, &value));
  for (int i = 0; i < h->n; i++)
    for (int c = 0; c < 2; c++) {
      value[i][ACCELERATION + c] = h->acceleration[i][c];
      value[i][EARLIER + c] = h->earlier[i][c];
      value[i][LASTING + c] = h->lasting[i][c];
      value[i][OUTSIDE + c] = h->outside[i][c];
      value[i][AGAINST + c] = h->against[i][c];
      value[i][RETAINED + c] = h->retained[i][c];
    }
  PetscCall(CheckpointPutIndices(to, "history nodes", h->n, 1, h->gid));
  PetscCall(CheckpointPutDoubles(to, "history", h->n, NCOLUMNS, (const double *)value));
  PetscCall(PetscFree(value));
  PetscFunctionReturn(0);
}

/* All rows, in order of the nodes. */
static PetscErrorCode LoadRows(Checkpoint from, int n, Row row[])
{
  long long *gid;
  double(*value)[NCOLUMNS];

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(n, &gid, n, &value));
  PetscCall(CheckpointGetIndices(from, "history nodes", 0, n, 1, gid));
  PetscCall(CheckpointGetDoubles(from, "history", 0, n, NCOLUMNS, (double *)value));
  for (int i = 0; i < n; i++) {
    row[i].gid = gid[i];
    PetscCall(PetscArraycpy(row[i].value, value[i], NCOLUMNS));
  }
  if (n) qsort(row, (size_t)n, sizeof *row, CompareRows);
  PetscCall(PetscFree2(gid, value));
  PetscFunctionReturn(0);
}

PetscErrorCode HistoryLoad(History *h, const SolidState *solid, Checkpoint from)
{
  double known;
  long long total;
  Row *row;
  Copies copies;

  PetscFunctionBeginUser;
  PetscCall(Resize(h, solid));
  PetscCall(CheckpointGetNumber(from, "history known", &known));
  h->known = known ? PETSC_TRUE : PETSC_FALSE;
  PetscCall(CheckpointRows(from, "history", &total));
  PetscCall(PetscMalloc1((size_t)total, &row));
  PetscCall(LoadRows(from, (int)total, row));
  PetscCall(CopiesCreateByNumber(h->comm, h->n, h->gid, &copies));
  for (int i = 0; i < h->n; i++) {
    const Row key = {.gid = h->gid[i]}, *end = row + total,
              *found = total ? bsearch(&key, row, (size_t)total, sizeof *row, CompareRows) : NULL;
    while (found > row && found[-1].gid == key.gid) found--;
    for (int c = 0; found && c < 2; c++) {
      h->acceleration[i][c] = found->value[ACCELERATION + c];
      h->earlier[i][c] = found->value[EARLIER + c];
      h->lasting[i][c] = found->value[LASTING + c];
      h->outside[i][c] = found->value[OUTSIDE + c];
      h->against[i][c] = found->value[AGAINST + c];
      for (const Row *r = found; CopiesIsFirst(copies, i) && r < end && r->gid == key.gid; r++)
        h->retained[i][c] += r->value[RETAINED + c];
    }
  }
  PetscCall(CopiesDestroy(&copies));
  PetscCall(PetscFree(row));
  PetscFunctionReturn(0);
}

PetscErrorCode HistoryDestroy(History *h)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree7(h->gid, h->acceleration, h->earlier, h->lasting, h->outside, h->against, h->retained));
  h->n = 0;
  h->known = PETSC_FALSE;
  PetscFunctionReturn(0);
}
