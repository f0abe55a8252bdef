#include "fluid/element_matrix.h"

PetscErrorCode ElementMatrixCreate(const Mesh *m, PetscInt block, Mat *matrix)
{
  double zero[36] = {0};
  PetscFunctionBeginUser;
  PetscCall(MatCreateBAIJ(m->comm, block, block * m->ne, block * m->ne, PETSC_DETERMINE, PETSC_DETERMINE, 4,
                          NULL, 3, NULL, matrix));
  for (int e = 0; e < m->ne; e++) {
    PetscInt cols[4] = {m->egid[e]}, n = 1;
    for (int i = 0; i < 3; i++)
      if (m->neighbor[3 * e + i] >= 0) cols[n++] = m->egid[m->neighbor[3 * e + i]];
    for (PetscInt k = 0; k < n; k++)
      PetscCall(MatSetValuesBlocked(*matrix, 1, &m->egid[e], 1, &cols[k], zero, INSERT_VALUES));
  }
  PetscCall(MatAssemblyBegin(*matrix, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(*matrix, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(0);
}

PetscErrorCode ElementMatrixParts(Mat matrix, Mat *diagonal, Mat *off_diagonal, const PetscInt **garray)
{
  const PetscInt *columns = NULL;
  PetscBool parallel;
  PetscFunctionBeginUser;
  PetscCall(PetscObjectTypeCompare((PetscObject)matrix, MATMPIBAIJ, &parallel));
  *diagonal = matrix;
  *off_diagonal = NULL;
  if (parallel) PetscCall(MatMPIBAIJGetSeqBAIJ(matrix, diagonal, off_diagonal, &columns));
  if (garray) *garray = columns;
  PetscFunctionReturn(0);
}

/* Where the block (row, global column) lies in a sequential part. */
static PetscErrorCode FindSlots(const Mesh *m, Mat part, const PetscInt garray[], PetscInt slot[])
{
  const PetscInt *ia, *ja;
  PetscInt n;
  PetscBool done;
  PetscFunctionBeginUser;
  PetscCall(MatGetRowIJ(part, 0, PETSC_FALSE, PETSC_TRUE, &n, &ia, &ja, &done));
  PetscCheck(done, m->comm, PETSC_ERR_PLIB, "no access to the rows of the element matrix");
  for (int e = 0; e < m->ne; e++)
    for (PetscInt k = ia[e]; k < ia[e + 1]; k++) {
      const PetscInt column = garray ? garray[ja[k]] : ja[k] + m->estart;
      if (column == m->egid[e]) slot[4 * e] = k;
      for (int i = 0; i < 3; i++) {
        const int nb = m->neighbor[3 * e + i];
        if (nb >= 0 && m->egid[nb] == column) slot[4 * e + 1 + i] = garray ? -1 - k : k;
      }
    }
  PetscCall(MatRestoreRowIJ(part, 0, PETSC_FALSE, PETSC_TRUE, &n, &ia, &ja, &done));
  PetscFunctionReturn(0);
}

PetscErrorCode ElementMatrixSlots(const Mesh *m, Mat matrix, PetscInt **slot)
{
  Mat diagonal, off_diagonal;
  const PetscInt *garray;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(4 * m->ne, slot));
  PetscCall(ElementMatrixParts(matrix, &diagonal, &off_diagonal, &garray));
  PetscCall(FindSlots(m, diagonal, NULL, *slot));
  if (off_diagonal) PetscCall(FindSlots(m, off_diagonal, garray, *slot));
  PetscFunctionReturn(0);
}
