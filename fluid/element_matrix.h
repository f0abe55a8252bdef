/* Matrices of the discontinuous velocity (MATBAIJ): a dense block for each element and for each pair of
 * neighbours, written in place.
 *
 *             column blocks             slot[4 e ...]
 *   row e   [ e | nb0 | nb1 | nb2 ]     where e's own block and those of its neighbours across faces 0, 1, 2 lie:
 *                                       k >= 0: block k of the diagonal part; -1 - k: of the off-diagonal one
 *
 * On several ranks a matrix has two sequential parts: columns of this rank, and columns of others (ghosts). */
#ifndef FLUID_ELEMENT_MATRIX_H
#define FLUID_ELEMENT_MATRIX_H
#include "common/mesh/mesh.h"
#include <petscmat.h>

/* At 0, with `block` unknowns an element.  Collective over mesh->comm. */
PetscErrorCode ElementMatrixCreate(const Mesh *mesh, PetscInt block, Mat *matrix);
/* Its sequential parts, borrowed; *off_diagonal is NULL on one rank; garray (may be NULL): its global block
 * columns.  Not collective. */
PetscErrorCode ElementMatrixParts(Mat matrix, Mat *diagonal, Mat *off_diagonal, const PetscInt **garray);
/* slot[4 ne], allocated; unset where there is no neighbour.  Not collective. */
PetscErrorCode ElementMatrixSlots(const Mesh *mesh, Mat matrix, PetscInt **slot);
#endif
