#include "fluid/discretization/assembly.h"
#include "common/exchange/scatter.h"

/* The local parts of a matrix: its columns of this rank (DIAGONAL), and the others. */
enum { DIAGONAL, OTHER, NPARTS };

struct Assembly_s {
  PetscInt n, start, end; /* contributions of this rank; its rows */
  Scatter scatter;        /* to the ranks of their rows */
  double *arrived;
  PetscInt
      *place; /* [n and those that arrive] in the values of DIAGONAL, -1: none, below: -2 - place in OTHER */
  PetscInt nvalues[NPARTS]; /* of the rows that have their pattern */
};

/* Contributions to the rows of other ranks. */
static PetscErrorCode FindLeaving(Assembly a, MPI_Comm comm, PetscInt nrows, const PetscInt row[])
{
  PetscLayout layout;
  PetscMPIInt owner;
  int *rank, *item, nleaving = 0;
  PetscFunctionBeginUser;
  PetscCall(PetscLayoutCreate(comm, &layout));
  PetscCall(PetscLayoutSetLocalSize(layout, nrows));
  PetscCall(PetscLayoutSetUp(layout));
  PetscCall(PetscLayoutGetRange(layout, &a->start, &a->end));
  for (PetscInt k = 0; k < a->n; k++) nleaving += row[k] >= 0 && (row[k] < a->start || row[k] >= a->end);
  PetscCall(PetscMalloc2(nleaving, &rank, nleaving, &item));
  nleaving = 0;
  for (PetscInt k = 0; k < a->n; k++) {
    if (row[k] < 0 || (row[k] >= a->start && row[k] < a->end)) continue;
    PetscCall(PetscLayoutFindOwner(layout, row[k], &owner));
    rank[nleaving] = owner;
    item[nleaving++] = (int)k;
  }
  PetscCall(ScatterCreate(comm, nleaving, rank, item, &a->scatter));
  PetscCall(PetscFree2(rank, item));
  PetscCall(PetscLayoutDestroy(&layout));
  PetscFunctionReturn(0);
}

/* All contributions on this rank by row: of row r contribution[first[r] .. first[r + 1] - 1], in their order. */
static void SortByRow(const Assembly a, PetscInt n, const PetscInt row[], PetscInt first[],
                      PetscInt contribution[])
{
  const PetscInt nrows = a->end - a->start;
  for (PetscInt r = 0; r <= nrows; r++) first[r] = 0;
  for (PetscInt k = 0; k < n; k++)
    if (row[k] >= a->start && row[k] < a->end) first[row[k] - a->start + 1]++;
  for (PetscInt r = 0; r < nrows; r++) first[r + 1] += first[r];
  for (PetscInt k = 0; k < n; k++)
    if (row[k] >= a->start && row[k] < a->end) contribution[first[row[k] - a->start]++] = k;
  for (PetscInt r = nrows; r > 0; r--) first[r] = first[r - 1];
  first[0] = 0;
}

/* The place of c in sorted[n], or where it belongs: rows are short. */
static PetscInt Find(PetscInt n, const PetscInt sorted[], PetscInt c)
{
  PetscInt i = n;
  while (i > 0 && sorted[i - 1] >= c) i--;
  return i;
}

/* The columns of one row, ascending: distinct[], their number returned. */
static PetscInt Distinct(PetscInt n, const PetscInt contribution[], const PetscInt column[],
                         PetscInt distinct[])
{
  PetscInt m = 0;
  for (PetscInt k = 0; k < n; k++) {
    const PetscInt c = column[contribution[k]], at = Find(m, distinct, c);
    if (at < m && distinct[at] == c) continue;
    for (PetscInt i = m++; i > at; i--) distinct[i] = distinct[i - 1];
    distinct[at] = c;
  }
  return m;
}

/* Where the contributions of one row with the columns distinct[m] go; the parts grow by its values. */
static void PlaceRow(Assembly a, PetscInt n, const PetscInt contribution[], const PetscInt column[],
                     PetscInt m, const PetscInt distinct[], PetscInt place[])
{
  for (PetscInt i = 0; i < m; i++)
    place[i] =
        distinct[i] >= a->start && distinct[i] < a->end ? a->nvalues[DIAGONAL]++ : -2 - a->nvalues[OTHER]++;
  for (PetscInt k = 0; k < n; k++)
    a->place[contribution[k]] = place[Find(m, distinct, column[contribution[k]])];
}

/* The pattern, and the places of all n contributions on this rank. */
static PetscErrorCode FindPattern(Assembly a, PetscInt n, const PetscInt row[], const PetscInt column[],
                                  Mat matrix)
{
  const PetscInt nrows = a->end - a->start;
  PetscInt *first, *contribution, *begin, *distinct, *place;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc5(nrows + 1, &first, n, &contribution, nrows + 1, &begin, n, &distinct, n, &place));
  SortByRow(a, n, row, first, contribution);
  for (PetscInt k = 0; k < n; k++) a->place[k] = -1;
  begin[0] = 0;
  for (PetscInt r = 0; r < nrows; r++) {
    const PetscInt *mine = contribution + first[r], count = first[r + 1] - first[r];
    PetscInt *columns = distinct + begin[r];
    begin[r + 1] = begin[r] + Distinct(count, mine, column, columns);
    PlaceRow(a, count, mine, column, begin[r + 1] - begin[r], columns, place);
  }
  PetscCall(MatSeqAIJSetPreallocationCSR(matrix, begin, distinct, NULL));
  PetscCall(MatMPIAIJSetPreallocationCSR(matrix, begin, distinct, NULL));
  PetscCall(PetscFree5(first, contribution, begin, distinct, place));
  PetscFunctionReturn(0);
}

PetscErrorCode AssemblyCreate(MPI_Comm comm, PetscInt nrows, PetscInt n, const PetscInt row[],
                              const PetscInt column[], Assembly *assembly, Mat *matrix)
{
  Assembly a;
  PetscInt *all_rows, *all_columns;
  PetscFunctionBeginUser;
  PetscCall(PetscNew(&a));
  a->n = n;
  PetscCall(FindLeaving(a, comm, nrows, row));
  const PetscInt narrived = ScatterArriving(a->scatter), all = n + narrived;
  PetscCall(PetscMalloc2(narrived, &a->arrived, all, &a->place));
  PetscCall(PetscMalloc2(all, &all_rows, all, &all_columns));
  PetscCall(PetscArraycpy(all_rows, row, n));
  PetscCall(PetscArraycpy(all_columns, column, n));
  PetscCall(ScatterForward(a->scatter, sizeof *row, row, all_rows + n));
  PetscCall(ScatterForward(a->scatter, sizeof *column, column, all_columns + n));
  PetscCall(MatCreate(comm, matrix));
  PetscCall(MatSetSizes(*matrix, nrows, nrows, PETSC_DETERMINE, PETSC_DETERMINE));
  PetscCall(MatSetType(*matrix, MATAIJ));
  PetscCall(FindPattern(a, all, all_rows, all_columns, *matrix));
  PetscCall(PetscFree2(all_rows, all_columns));
  *assembly = a;
  PetscFunctionReturn(0);
}

PetscErrorCode AssemblyDestroy(Assembly *assembly)
{
  PetscFunctionBeginUser;
  if (!*assembly) PetscFunctionReturn(0);
  PetscCall(ScatterDestroy(&(*assembly)->scatter));
  PetscCall(PetscFree2((*assembly)->arrived, (*assembly)->place));
  PetscCall(PetscFree(*assembly));
  PetscFunctionReturn(0);
}

static void Add(PetscInt n, const PetscInt place[], const double value[], double diagonal[], double other[])
{
  for (PetscInt k = 0; k < n; k++) {
    if (place[k] >= 0)
      diagonal[place[k]] += value[k];
    else if (place[k] < -1)
      other[-2 - place[k]] += value[k];
  }
}

PetscErrorCode AssemblySum(Assembly a, const double value[], Mat matrix)
{
  Mat part[NPARTS] = {matrix, NULL};
  PetscScalar *sum[NPARTS] = {NULL, NULL};
  PetscBool several;
  PetscFunctionBeginUser;
  PetscCall(PetscObjectTypeCompare((PetscObject)matrix, MATMPIAIJ, &several));
  if (several) PetscCall(MatMPIAIJGetSeqAIJ(matrix, &part[DIAGONAL], &part[OTHER], NULL));
  PetscCall(ScatterForward(a->scatter, sizeof *value, value, a->arrived));
  PetscCall(MatZeroEntries(matrix));
  for (int k = 0; k < NPARTS && part[k]; k++) PetscCall(MatSeqAIJGetArray(part[k], &sum[k]));
  Add(a->n, a->place, value, sum[DIAGONAL], sum[OTHER]);
  Add(ScatterArriving(a->scatter), a->place + a->n, a->arrived, sum[DIAGONAL], sum[OTHER]);
  for (int k = 0; k < NPARTS && part[k]; k++) PetscCall(MatSeqAIJRestoreArray(part[k], &sum[k]));
  PetscFunctionReturn(0);
}
