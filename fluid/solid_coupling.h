/* The solid in the fluid: the coupling of the current step (CoracleCoupling of coracle.h) by elements.  Most
 * elements have none; SolidCouplingAt finds an element's entry.  Momentum takes a and s, the projection ms, us
 * and the implicit inertia, adaptation the surface and its velocity.
 *
 *   element   0   1   2   3   4   5 ...
 *   index    -1  -1   0  -1   1  -1         entry[0].element = 2, entry[1].element = 4 */
#ifndef FLUID_SOLID_COUPLING_H
#define FLUID_SOLID_COUPLING_H
#include "common/link/coracle.h"
#include "fluid/kernels.h"
#include <petscsys.h>

typedef struct SolidCoupling_s *SolidCoupling;

/* For ne elements, without a solid.  Not collective, like all of this. */
PetscErrorCode SolidCouplingCreate(int ne, SolidCoupling *s);
PetscErrorCode SolidCouplingDestroy(SolidCoupling *s);
/* Replaces all entries by entry[n], which is copied; entry[k].element < ne, none twice. */
PetscErrorCode SolidCouplingSet(SolidCoupling s, int n, const CoracleCoupling entry[]);
/* The entries, *n of them, borrowed. */
const CoracleCoupling *SolidCouplingEntries(SolidCoupling s, int *n);
/* The index of element e's entry, or -1; the entry, or NULL. */
int SolidCouplingIndex(SolidCoupling s, int e);
const CoracleCoupling *SolidCouplingAt(SolidCoupling s, int e);
/* alpha_s[ne], borrowed. */
const double *SolidCouplingFraction(SolidCoupling s);
/* u[ne][2][3] += M^-1 r, one correction an entry. */
void SolidCouplingCorrect(SolidCoupling s, const ElementGeometry geometry[],
                          const CoracleCorrection correction[], double u[]);
#endif
