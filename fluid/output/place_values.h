/* Fields of the fluid at places (locate.h). */
#ifndef FLUID_PLACE_VALUES_H
#define FLUID_PLACE_VALUES_H
#include "fluid/flow/fluid.h"
#include "fluid/output/locate.h"

enum { PLACE_U, PLACE_V, PLACE_P, PLACE_RHO, PLACE_VALUES };

/* Collective: value[npoints][PLACE_VALUES], on all ranks; nan outside of the mesh. */
PetscErrorCode PlacesValues(const Places *places, Fluid fluid, double value[][PLACE_VALUES]);
#endif
