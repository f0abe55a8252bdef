/* The solid in the fluid: the coupling of the current step (CoracleCoupling of coracle.h) by elements.  Most
 * elements have none; SolidCouplingAt finds an element's entry.  Momentum takes a and s, the projection ms, us
 * and the implicit inertia, adaptation the surface and its velocity.
 *
 *   element   0   1   2   3   4   5 ...
 *   index    -1  -1   0  -1   1  -1         entry[0].element = 2, entry[1].element = 4 */
#ifndef FLUID_SOLID_COUPLING_H
#define FLUID_SOLID_COUPLING_H
#include "common/link/coracle.h"
#include "fluid/discretization/kernels.h"
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
/* Held, and not moving as prescribed. */
static inline int SolidCouplingIsAtRest(const CoracleCoupling *entry)
{
  return entry->flags & CORACLE_IS_HELD && entry->velocity[0] == 0.0 && entry->velocity[1] == 0.0;
}
/* Whether the solid begins to move in the coming step (false at first): see SolidCouplingStart. */
void SolidCouplingSetStarting(SolidCoupling s, PetscBool starting);
/* start[2][3]: where the implicit inertia of element e starts from: the fluid's velocity u[2][3] at
 * the start of the step; in the step in which the solid begins the solid's mean there, because the fluid beside it has
 * not moved with it so far. */
void SolidCouplingStart(SolidCoupling s, int e, const double u[], double start[]);
/* load[2][3] += s + I kept start, less rho M/dt start where the solid covers element e and s has the start: what of the coupling
 * does not depend on the velocity at the step's end.  u[2][3]: the fluid's at its start; area of e, m2; rho/dt, kg/(m3 s). */
void SolidCouplingLoad(SolidCoupling s, int e, const double u[6], double area, double rho_dt, double load[6]);
/* What of it does: matrix[row][column] = a + I of an entry, rows and columns [2][3]. */
void SolidCouplingMatrix(const CoracleCoupling *entry, double matrix[6][6]);
/* alpha_s[ne], borrowed. */
const double *SolidCouplingFraction(SolidCoupling s);
/* u[ne][2][3] += M^-1 r, one correction an entry. */
void SolidCouplingCorrect(SolidCoupling s, const ElementGeometry geometry[],
                          const CoracleCorrection correction[], double u[]);
#endif
