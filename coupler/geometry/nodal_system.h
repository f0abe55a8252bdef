/* Symmetric linear systems for values at nodes of the solid, where they are not given: one row for each free node, with the first of its
 * copies.  Conjugate gradients to 1e-10 of the first residual, in the preconditioner's norm; the preconditioner is the factor of each rank's
 * rows in the first matrix, its diagonal larger by 1e-10 so that there is one where no node is given. */
#ifndef CORACLE_COUPLER_NODAL_SYSTEM_H
#define CORACLE_COUPLER_NODAL_SYSTEM_H
#include "common/exchange/copies.h"

typedef struct NodalSystem_s *NodalSystem;

/* Collective.  is_free[nnodes], the same for all copies of a node; the copies are borrowed. */
PetscErrorCode NodalSystemCreate(MPI_Comm comm, Copies nodes, int nnodes, const char is_free[],
                                 NodalSystem *system);
PetscErrorCode NodalSystemDestroy(NodalSystem *system);
/* Not collective: [nnodes] the rows of the nodes over all ranks, -1 where they are not free; borrowed. */
const PetscInt *NodalSystemRows(NodalSystem system);

/* Collective: of which rows the matrix is, n blocks of row[n][size] of any rank; negative rows are left out. */
PetscErrorCode NodalSystemSetBlocks(NodalSystem system, int n, int size, const PetscInt row[]);
/* Collective: the matrix is the sum of the blocks value[n][size][size]; the factor is that of the first matrix. */
PetscErrorCode NodalSystemSetMatrix(NodalSystem system, const double value[]);
/* Not collective: adds value[n] to the right-hand side in row[n] of any rank; negative rows are left out. */
PetscErrorCode NodalSystemAdd(NodalSystem system, int n, const PetscInt row[], const double value[]);
/* Collective: value[stride * i] of each free node i; of those that no given one is connected with, and where nothing was added, 0.  The
 * right-hand side is 0 again afterwards. */
PetscErrorCode NodalSystemSolve(NodalSystem system, int stride, double value[]);
#endif
