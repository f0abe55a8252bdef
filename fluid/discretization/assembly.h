/* A matrix whose entries are sums of contributions with places that stay: made once a mesh, summed anew in every step.
 *
 *     contribution   0    1    2    3  ...                  row    (0,0) (0,2) (1,1) ...
 *     (row, column) (0,0)(0,2) -   (0,0)        matrix            c0+c3  c1    ...
 *
 * The pattern is found by counting, without sorting all contributions; those to other ranks' rows travel there. */
#ifndef FLUID_ASSEMBLY_H
#define FLUID_ASSEMBLY_H
#include <petscmat.h>

typedef struct Assembly_s *Assembly;

/* Collective.  A square matrix of type AIJ with nrows rows of this rank, and where its contributions go: number k of n on this rank
 * to (row[k], column[k]), numbers in the whole matrix; one with row[k] < 0 to none.  The matrix is the caller's. */
PetscErrorCode AssemblyCreate(MPI_Comm comm, PetscInt nrows, PetscInt n, const PetscInt row[],
                              const PetscInt column[], Assembly *assembly, Mat *matrix);
PetscErrorCode AssemblyDestroy(Assembly *assembly);
/* Collective: matrix, the one that was made with it, becomes the sum of value[n]; the same bits for the same values. */
PetscErrorCode AssemblySum(Assembly assembly, const double value[], Mat matrix);
#endif
