// ranks: 1 2 3
/* A matrix summed from contributions is that of MatSetValues: entries of many contributions, of none, in rows of
 * other ranks; summed again with other values it has nothing of the first ones. */
#include "fluid/discretization/assembly.h"
#include "tests/check.h"

enum { ROWS = 40, CONTRIBUTIONS = 900 };

static double Random(unsigned *seed)
{
  *seed = *seed * 1664525u + 1013904223u;
  return (double)(*seed >> 8) / (1 << 24);
}

/* |matrix - sum of value| over the largest entry. */
static PetscErrorCode Difference(Mat matrix, const PetscInt row[], const PetscInt column[],
                                 const double value[], double *difference)
{
  Mat expected;
  PetscReal size;
  PetscInt nlocal;
  PetscFunctionBeginUser;
  PetscCall(MatGetLocalSize(matrix, &nlocal, NULL));
  PetscCall(MatCreate(PETSC_COMM_WORLD, &expected));
  PetscCall(MatSetSizes(expected, nlocal, nlocal, PETSC_DETERMINE, PETSC_DETERMINE));
  PetscCall(MatSetType(expected, MATAIJ));
  PetscCall(MatSetUp(expected));
  PetscCall(MatSetOption(expected, MAT_NEW_NONZERO_ALLOCATION_ERR, PETSC_FALSE));
  for (int k = 0; k < CONTRIBUTIONS; k++)
    if (row[k] >= 0) PetscCall(MatSetValue(expected, row[k], column[k], value[k], ADD_VALUES));
  PetscCall(MatAssemblyBegin(expected, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(expected, MAT_FINAL_ASSEMBLY));
  PetscCall(MatNorm(expected, NORM_INFINITY, &size));
  PetscCall(MatAXPY(expected, -1.0, matrix, DIFFERENT_NONZERO_PATTERN));
  PetscCall(MatNorm(expected, NORM_INFINITY, difference));
  *difference /= size;
  PetscCall(MatDestroy(&expected));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  static PetscInt row[CONTRIBUTIONS], column[CONTRIBUTIONS];
  static double value[CONTRIBUTIONS];
  PetscMPIInt rank, size;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCallMPI(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  PetscCallMPI(MPI_Comm_size(PETSC_COMM_WORLD, &size));
  unsigned seed = 1u + (unsigned)rank;
  const PetscInt nrows = ROWS - 7 * rank;
  PetscInt all = 0;
  for (int r = 0; r < size; r++) all += ROWS - 7 * r;
  for (int k = 0; k < CONTRIBUTIONS; k++) {
    row[k] = (PetscInt)(Random(&seed) * (double)all);
    column[k] = k % 3 ? row[k] : (PetscInt)(Random(&seed) * (double)all);
    if (k % 10 == 0) row[k] = -1;
    if (row[k] == 5) row[k] = 6; /* an empty row */
  }
  Assembly assembly;
  Mat matrix;
  PetscCall(AssemblyCreate(PETSC_COMM_WORLD, nrows, CONTRIBUTIONS, row, column, &assembly, &matrix));
  for (int again = 0; again < 2; again++) {
    double difference;
    for (int k = 0; k < CONTRIBUTIONS; k++) value[k] = Random(&seed) - 0.4;
    PetscCall(AssemblySum(assembly, value, matrix));
    PetscCall(Difference(matrix, row, column, value, &difference));
    CHECK(difference < 1e-13, "summed %d times: off by %g", again + 1, difference);
  }
  PetscCall(AssemblyDestroy(&assembly));
  PetscCall(MatDestroy(&matrix));
  PetscCall(PetscFinalize());
  return 0;
}
