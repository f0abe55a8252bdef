/* The springs of a solid's setup, on the subdomains: each acts where its element is. */
#ifndef SOLID_SPRINGS_H
#define SOLID_SPRINGS_H
#include "solid/element.h"
#include "solid/solid.h"

/* Which of this rank's elements have springs; after the elements are there.  Not collective. */
PetscErrorCode SpringsFind(Solid s);
/* s->force += what they do; kept for the budget.  Not collective. */
void SpringsAddForces(Solid s);
/* Their impulses and work of the substep of those forces, after the nodes have moved.  Not collective. */
void SpringsAddBudget(Solid s);
/* Spring k's nodes and its K as it is, N/m, [2 i + c] of node i along axis c; false where another rank has it.  Not collective. */
PetscBool SpringsStiffness(Solid s, int k, int node[3], double stiffness[6][6]);
/* What they add to the bound of the substep: sum of k w^2/m over all springs and nodes, and of c w^2/m.  Collective. */
PetscErrorCode SpringsRate(Solid s, ElementRates *rates);
#endif
