/* The correction of the pressure in P1, the linear functions of the mesh:  E A1^-1 E^T r,  A1 = E^T A E.
 *
 * E: a P1 function's values at the P2 nodes.  A1 is the matrix of the P1 functions with the same coefficients on the same elements.
 *
 * A1 has a quarter of the unknowns and is factored on one rank or, where it is large, solved by algebraic multigrid on all
 * (prefix pressure_coarse_), which relaxes forwards on the way down and backwards on the way up: symmetric, as CG needs it.  That is done
 * again when an element's coefficient has changed by a factor, or when the old one has cost as many iterations more as the set-up takes
 * time for. */
#ifndef FLUID_COARSE_CORRECTION_H
#define FLUID_COARSE_CORRECTION_H
#include "fluid/discretization/domain.h"
#include <petscksp.h>

typedef struct CoarseCorrection_s *CoarseCorrection;

/* is_fixed[n of the P2 space] nodes where the pressure is known; closed: there are none on any rank; domain is borrowed.  Collective. */
PetscErrorCode CoarseCorrectionCreate(const FluidDomain *domain, const char is_fixed[], PetscBool closed,
                                      CoarseCorrection *c);
PetscErrorCode CoarseCorrectionDestroy(CoarseCorrection *c);
/* A has changed; block[ne][6][6] are its elements' contributions.  Collective. */
PetscErrorCode CoarseCorrectionUpdate(CoarseCorrection c, const double block[][36]);
/* change: the correction by the residual, both of P2; borrowed until the next call.  Collective. */
PetscErrorCode CoarseCorrectionApply(CoarseCorrection c, Vec residual, Vec *change);
/* What the last solve with this correction took.  Not collective. */
void CoarseCorrectionCount(CoarseCorrection c, int iterations);
#endif
