/* Notes of a case's check on boundaries among phases.  On one rank. */
#ifndef FLUID_CHECK_BOUNDARIES_H
#define FLUID_CHECK_BOUNDARIES_H
#include "fluid/flow/fluid.h"

/* Prints a note on each level that is not within the heights of the mesh, and on each inflow whose phase the case does not say. */
void NoteBoundaries(const Mesh *mesh, const FluidSetup *setup);
#endif
