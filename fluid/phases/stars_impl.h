/* Private to stars.c and stars_gather.c. */
#ifndef CORACLE_PHASES_STARS_IMPL_H
#define CORACLE_PHASES_STARS_IMPL_H
#include "fluid/phases/stars.h"

enum { RINGS = 2 };

/* Collective: element[nl], allocated: owned elements in the Mesh's order, then those within RINGS rings around them by
 * ascending global number. */
PetscErrorCode StarsGather(const Mesh *mesh, int *nl, StarElement **element);
#endif
