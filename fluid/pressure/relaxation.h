/* Gauss-Seidel over the rows of each rank, one forward and one backward sweep around what a preconditioner does between them:
 *
 *   z = M^-1 r      ...      z += M^-T (r - A z),      M = L + D + l
 *
 * L and D: the lower triangle and the diagonal of this rank's block of A.  The entries between ranks, B, are left out of M;
 * l_i, half of their absolute sum in row i, takes their place: M + M^T - A = D + 2 l - B is positive definite, row
 * by row, and so is the preconditioner, whatever the coefficients (Baker, Falgout, Kolev and Yang 2011).  On one rank l
 * is 0.
 *
 * What the forward sweep leaves is known without a product, r - A z = l z - (U + B) z, and the backward sweep takes r - A z
 * of its rows on its way.  The rank's block is in single precision: the sweeps take what its bytes take. */
#ifndef FLUID_RELAXATION_H
#define FLUID_RELAXATION_H
#include <petscmat.h>

typedef struct Relaxation_s *Relaxation;

/* Of the symmetric positive definite matrix A, borrowed, AIJ with all of its diagonal; RelaxationUpdate before the first sweep.
 * Collective, like all of this. */
PetscErrorCode RelaxationCreate(Mat matrix, Relaxation *relaxation);
PetscErrorCode RelaxationDestroy(Relaxation *relaxation);
/* A has other values. */
PetscErrorCode RelaxationUpdate(Relaxation relaxation);
/* l[rows of this rank], borrowed until the next update.  Not collective. */
const double *RelaxationHeld(Relaxation relaxation);
/* From z = 0; *residual = r - A z, borrowed until the next call of one of these. */
PetscErrorCode RelaxationForward(Relaxation relaxation, Vec r, Vec z, Vec *residual);
PetscErrorCode RelaxationBackward(Relaxation relaxation, Vec r, Vec z);
#endif
