/* The exact correction of a residual in patches: the nodes that relaxation is slow in, those of elements whose coefficient
 * has a direction or a jump inside (a solid's surface among phases, a cut element).
 *
 *   z += R^T (R A R^T + l)^-1 R (r - A z),      R: the patches' nodes of this rank
 *
 * Patches of two ranks correct at the same time; l, half of the absolute sum of a row's entries between ranks, is what relaxation.h has
 * it for: with it the correction, too, makes the error's energy less. */
#ifndef FLUID_PATCH_CORRECTION_H
#define FLUID_PATCH_CORRECTION_H
#include <petscksp.h>

typedef struct PatchCorrection_s *PatchCorrection;

/* Of the symmetric positive definite matrix A, AIJ, borrowed.  Without patches until the first Update.  Collective, like all of this. */
PetscErrorCode PatchCorrectionCreate(Mat matrix, PatchCorrection *p);
PetscErrorCode PatchCorrectionDestroy(PatchCorrection *p);
/* A has other values, and the patches are row[n], ascending, owned by this rank, global, some on any rank; held[own rows]: l. */
PetscErrorCode PatchCorrectionUpdate(PatchCorrection p, PetscInt n, const PetscInt row[],
                                     const double held[]);
/* There are no patches. */
PetscErrorCode PatchCorrectionClear(PatchCorrection p);
/* There are.  Not collective. */
PetscBool PatchCorrectionActive(PatchCorrection p);
/* z as above, residual = r - A z of the z before, and becomes that of the new one. */
PetscErrorCode PatchCorrectionFirst(PatchCorrection p, Vec residual, Vec z);
/* The same after z += change; residual = r - A z of the z before that, and is not kept up to date. */
PetscErrorCode PatchCorrectionSecond(PatchCorrection p, Vec change, Vec residual, Vec z);
#endif
