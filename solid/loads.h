/* The loads on boundaries of bodies (boundary_load.h), on this rank's elements.  The sides are those of the start: new faces of
 * cracks have no load, and a fragment keeps its own. */
#ifndef SOLID_LOADS_H
#define SOLID_LOADS_H
#include "solid/solid_impl.h"

/* Not collective: the model's loads, and the sides of this rank's elements; local[a->nelements]: its number of those in part. */
PetscErrorCode LoadsTake(Solid s, const Model *a, const int part[], const int local[]);
PetscErrorCode LoadsFree(Solid s);
/* Not collective: adds to force what they are at the present time and positions. */
void LoadsAddForces(Solid s);
/* Not collective, the same on all ranks: how long, s, of the coming window no load becomes more than twice what it is now, by the rows of its table:
 * until the row before the first that is. */
double LoadsSteadyFor(const Solid s, double window);
/* Not collective: what the last forces do in the substep, after its nodes have moved. */
void LoadsAddBudget(Solid s);
#endif
