/* The springs of a solid's setup, on the subdomains: each end acts where its element is. */
#ifndef SOLID_SPRINGS_H
#define SOLID_SPRINGS_H
#include "solid/element.h"
#include "solid/solid.h"

/* Which of this rank's elements have springs; after the elements are there.  Not collective. */
PetscErrorCode SpringsFind(Solid s);
/* s->force += what they do; kept for the budget.  Collective. */
PetscErrorCode SpringsAddForces(Solid s);
/* Their impulses and work of the substep of those forces, after the nodes have moved.  Not collective. */
void SpringsAddBudget(Solid s);
/* K of each spring as it is, N/m: stiffness[nsprings][2][2] of spring.h.  Collective. */
PetscErrorCode SpringsStiffness(Solid s, double stiffness[][4]);
/* kd[nnodes][2] += this rank's part of what those K make of d[nnodes][2].  Collective. */
PetscErrorCode SpringsMultiply(Solid s, double stiffness[][4], const double d[], double kd[]);
/* What they add to the bound of the substep: sum of k w^2/m over all springs and nodes, and of c w^2/m.  Collective. */
PetscErrorCode SpringsRate(Solid s, ElementRates *rates);
#endif
