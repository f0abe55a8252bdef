// ranks: 1 2 3
/* Gauss-Seidel within the ranks converges for any symmetric positive definite matrix, also where the entries between
 * ranks outweigh the diagonal: the error's energy falls in each pair of sweeps. */
#include "fluid/pressure/relaxation.h"
#include <petscksp.h>

enum { N = 4 };    /* rows a rank */
#define WITHIN 0.5 /* entries of a rank's block beside its diagonal of 1 */
#define BETWEEN                                                                                              \
  2.4 /* sum over a row's columns of other ranks, negative: the least eigenvalue is 1 + 3 WITHIN - BETWEEN */

static PetscErrorCode CreateMatrix(int rank, int ranks, Mat *matrix)
{
  PetscFunctionBeginUser;
  PetscCall(MatCreateAIJ(PETSC_COMM_WORLD, N, N, PETSC_DETERMINE, PETSC_DETERMINE, N, NULL, N * ranks, NULL,
                         matrix));
  for (PetscInt i = N * rank; i < N * (rank + 1); i++)
    for (PetscInt j = 0; j < N * ranks; j++) {
      const double between = -BETWEEN / (N * PetscMax(ranks - 1, 1));
      const double value = j / N == rank ? WITHIN : between;
      PetscCall(MatSetValue(*matrix, i, j, i == j ? 1.0 : value, INSERT_VALUES));
    }
  PetscCall(MatAssemblyBegin(*matrix, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(*matrix, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(0);
}

static PetscErrorCode Energy(Mat matrix, Vec e, double *energy)
{
  Vec ae;
  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(e, &ae));
  PetscCall(MatMult(matrix, e, ae));
  PetscCall(VecDot(e, ae, energy));
  PetscCall(VecDestroy(&ae));
  PetscFunctionReturn(0);
}

/* e -= M^-T (...) M^-1 A e */
static PetscErrorCode Sweep(Mat matrix, Relaxation relaxation, Vec e)
{
  Vec r, z, residual;
  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(e, &r));
  PetscCall(VecDuplicate(e, &z));
  PetscCall(MatMult(matrix, e, r));
  PetscCall(RelaxationForward(relaxation, r, z, &residual));
  PetscCall(RelaxationBackward(relaxation, r, z));
  PetscCall(VecAXPY(e, -1.0, z));
  PetscCall(VecDestroy(&r));
  PetscCall(VecDestroy(&z));
  PetscFunctionReturn(0);
}

/* Alternating between ranks, the error that the entries between them bear most; and a row of its own. */
static PetscErrorCode SetError(int rank, Vec e)
{
  PetscScalar *v;
  PetscFunctionBeginUser;
  PetscCall(VecGetArray(e, &v));
  for (int i = 0; i < N; i++) v[i] = (rank % 2 ? -1.0 : 1.0) + 0.1 * i;
  PetscCall(VecRestoreArray(e, &v));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  PetscMPIInt rank, ranks;
  Relaxation relaxation;
  double before, after;
  Mat matrix;
  Vec e;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCallMPI(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  PetscCallMPI(MPI_Comm_size(PETSC_COMM_WORLD, &ranks));
  PetscCall(CreateMatrix(rank, ranks, &matrix));
  PetscCall(MatCreateVecs(matrix, &e, NULL));
  PetscCall(RelaxationCreate(matrix, &relaxation));
  PetscCall(RelaxationUpdate(relaxation));
  PetscCall(SetError(rank, e));
  PetscCall(Energy(matrix, e, &before));
  for (int k = 0; k < 6 && before > 1e-20; k++, before = after) {
    PetscCall(Sweep(matrix, relaxation, e));
    PetscCall(Energy(matrix, e, &after));
    PetscCheck(after >= 0.0 && after < before, PETSC_COMM_WORLD, PETSC_ERR_PLIB,
               "sweep %d: the error's energy was %g, it is %g", k, before, after);
  }
  PetscCall(RelaxationDestroy(&relaxation));
  PetscCall(VecDestroy(&e));
  PetscCall(MatDestroy(&matrix));
  return PetscFinalize();
}
