#include "coupler/geometry/nodal_system.h"
#include <petscksp.h>

#define TOLERANCE 1e-10
#define SHIFT 1e-10

struct NodalSystem_s {
  MPI_Comm comm;
  Copies nodes; /* borrowed */
  int nnodes, nrows;
  PetscInt first, nall; /* this rank's first row; rows of all ranks */
  PetscInt *row;        /* [nnodes] */
  Mat matrix;
  Vec right, solution;
  KSP solver;
};

PetscErrorCode NodalSystemCreate(MPI_Comm comm, Copies nodes, int nnodes, const char is_free[],
                                 NodalSystem *system)
{
  NodalSystem s;
  double *row; /* counted from 1 where this rank has it, else 0: the sum over a node's copies is its row */

  PetscFunctionBeginUser;
  PetscCall(PetscNew(&s));
  PetscCall(PetscMalloc1(nnodes, &s->row));
  PetscCall(PetscCalloc1(nnodes, &row));
  s->comm = comm;
  s->nodes = nodes;
  s->nnodes = nnodes;
  for (int i = 0; i < nnodes; i++)
    if (is_free[i] && CopiesIsFirst(nodes, i)) row[i] = ++s->nrows;
  const PetscInt mine = s->nrows;
  PetscCallMPI(MPI_Exscan(&mine, &s->first, 1, MPIU_INT, MPI_SUM, comm));
  PetscCallMPI(MPI_Allreduce(&mine, &s->nall, 1, MPIU_INT, MPI_SUM, comm));
  for (int i = 0; i < nnodes; i++)
    if (row[i] > 0.0) row[i] += s->first;
  PetscCall(CopiesSum(nodes, 1, row));
  for (int i = 0; i < nnodes; i++) s->row[i] = (PetscInt)row[i] - 1;
  PetscCall(PetscFree(row));
  *system = s;
  PetscFunctionReturn(0);
}

PetscErrorCode NodalSystemDestroy(NodalSystem *system)
{
  NodalSystem s = *system;

  PetscFunctionBeginUser;
  if (!s) PetscFunctionReturn(0);
  PetscCall(PetscFree(s->row));
  PetscCall(KSPDestroy(&s->solver));
  PetscCall(MatDestroy(&s->matrix));
  PetscCall(VecDestroy(&s->right));
  PetscCall(VecDestroy(&s->solution));
  PetscCall(PetscFree(*system));
  PetscFunctionReturn(0);
}

const PetscInt *NodalSystemRows(NodalSystem s)
{
  return s->row;
}

PetscErrorCode NodalSystemSetBlocks(NodalSystem s, int n, int size, const PetscInt row[])
{
  const int nvalues = n * size * size;
  PetscInt *i, *j;

  PetscFunctionBeginUser;
  if (s->nall == 0) PetscFunctionReturn(0);
  PetscCall(PetscMalloc2(nvalues, &i, nvalues, &j));
  for (int k = 0; k < nvalues; k++) {
    i[k] = row[k / size];
    j[k] = row[k / (size * size) * size + k % size];
  }
  PetscCall(MatCreate(s->comm, &s->matrix));
  PetscCall(MatSetSizes(s->matrix, s->nrows, s->nrows, PETSC_DETERMINE, PETSC_DETERMINE));
  PetscCall(MatSetType(s->matrix, MATAIJ));
  PetscCall(MatSetPreallocationCOO(s->matrix, nvalues, i, j));
  PetscCall(PetscFree2(i, j));
  PetscCall(MatCreateVecs(s->matrix, &s->right, &s->solution));
  PetscCall(VecSetOption(s->right, VEC_IGNORE_NEGATIVE_INDICES, PETSC_TRUE));
  PetscFunctionReturn(0);
}

static PetscErrorCode CreateSolver(NodalSystem s)
{
  Mat shifted;
  Vec diagonal;
  KSP *block;
  PC pc;

  PetscFunctionBeginUser;
  PetscCall(MatDuplicate(s->matrix, MAT_COPY_VALUES, &shifted));
  PetscCall(VecDuplicate(s->right, &diagonal));
  PetscCall(MatGetDiagonal(s->matrix, diagonal));
  PetscCall(VecScale(diagonal, 1.0 + SHIFT));
  PetscCall(MatDiagonalSet(shifted, diagonal, INSERT_VALUES));
  PetscCall(VecDestroy(&diagonal));
  PetscCall(MatSetOption(shifted, MAT_SPD, PETSC_TRUE));
  PetscCall(KSPCreate(s->comm, &s->solver));
  PetscCall(KSPSetType(s->solver, KSPCG));
  PetscCall(KSPSetNormType(s->solver, KSP_NORM_NATURAL));
  PetscCall(KSPSetErrorIfNotConverged(s->solver, PETSC_TRUE));
  PetscCall(KSPSetTolerances(s->solver, TOLERANCE, PETSC_DEFAULT, PETSC_DEFAULT, s->nall));
  PetscCall(KSPSetOperators(s->solver, s->matrix, shifted));
  PetscCall(MatDestroy(&shifted));
  PetscCall(KSPGetPC(s->solver, &pc));
  PetscCall(PCSetType(pc, PCBJACOBI));
  PetscCall(KSPSetUp(s->solver));
  PetscCall(PCBJacobiGetSubKSP(pc, NULL, NULL, &block));
  PetscCall(KSPGetPC(block[0], &pc));
  PetscCall(PCSetType(pc, PCCHOLESKY));
  PetscCall(PCFactorSetMatOrderingType(pc, MATORDERINGND));
  PetscFunctionReturn(0);
}

PetscErrorCode NodalSystemSetMatrix(NodalSystem s, const double value[])
{
  PetscFunctionBeginUser;
  if (s->nall == 0) PetscFunctionReturn(0);
  PetscCall(MatSetValuesCOO(s->matrix, value, INSERT_VALUES));
  if (!s->solver) PetscCall(CreateSolver(s));
  PetscFunctionReturn(0);
}

PetscErrorCode NodalSystemAdd(NodalSystem s, int n, const PetscInt row[], const double value[])
{
  PetscFunctionBeginUser;
  if (s->nall > 0) PetscCall(VecSetValues(s->right, n, row, value, ADD_VALUES));
  PetscFunctionReturn(0);
}

PetscErrorCode NodalSystemSolve(NodalSystem s, int stride, double value[])
{
  const double *solution;
  double *sum;

  PetscFunctionBeginUser;
  if (s->nall == 0) PetscFunctionReturn(0);
  PetscCall(VecAssemblyBegin(s->right));
  PetscCall(VecAssemblyEnd(s->right));
  PetscCall(KSPSolve(s->solver, s->right, s->solution));
  PetscCall(VecZeroEntries(s->right));
  PetscCall(PetscCalloc1(s->nnodes, &sum));
  PetscCall(VecGetArrayRead(s->solution, &solution));
  for (int i = 0; i < s->nnodes; i++)
    if (s->row[i] >= s->first && s->row[i] < s->first + s->nrows && CopiesIsFirst(s->nodes, i))
      sum[i] = solution[s->row[i] - s->first];
  PetscCall(VecRestoreArrayRead(s->solution, &solution));
  PetscCall(CopiesSum(s->nodes, 1, sum));
  for (int i = 0; i < s->nnodes; i++)
    if (s->row[i] >= 0) value[stride * i] = sum[i];
  PetscCall(PetscFree(sum));
  PetscFunctionReturn(0);
}
