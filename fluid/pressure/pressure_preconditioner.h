/* The preconditioner of the pressure's matrix in P2: relaxation of all nodes and a correction in P1, the linear
 * functions of the same mesh.
 *
 *   forward     Gauss-Seidel over the nodes of this rank from z = 0 (relaxation.h)
 *   patches     an exact correction in the nodes of uneven elements (patch_correction.h), if some are very uneven
 *   coarse      z += E A1^-1 E^T (r - A z)   (coarse_correction.h)
 *   patches     again
 *   backward    Gauss-Seidel in the other order
 *
 * Both spaces see the same coefficients on the same elements, so that the iterations know neither their contrast nor the size of the
 * elements: 6 to 8 of CG for 1e-7.  Relaxation does not see a coefficient with a direction in an element (a cut one, one with a solid's
 * surface among phases): without patches a tank with an elastic gate and a wall took 98 iterations, with them 12, the patches having a
 * tenth of the nodes. */
#ifndef FLUID_PRESSURE_PRECONDITIONER_H
#define FLUID_PRESSURE_PRECONDITIONER_H
#include "fluid/discretization/domain.h"
#include <petscksp.h>

typedef struct PressurePreconditioner_s *PressurePreconditioner;

/* For ksp, whose matrix is A; is_fixed[n of the P2 space] nodes where the pressure is known; domain is borrowed.  Collective, like all of this. */
PetscErrorCode PressurePreconditionerCreate(const FluidDomain *domain, const char is_fixed[],
                                            PetscBool closed, KSP ksp, PressurePreconditioner *p);
PetscErrorCode PressurePreconditionerDestroy(PressurePreconditioner *p);
/* A has changed; block[ne][6][6] are its elements' contributions, unevenness[ne]: pressure_solver.h. */
PetscErrorCode PressurePreconditionerUpdate(PressurePreconditioner p, const double block[][36],
                                            const double unevenness[]);
/* What the last solve took.  Not collective. */
void PressurePreconditionerCount(PressurePreconditioner p, int iterations);
#endif
