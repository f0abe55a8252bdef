/* Notes of a case's check on phases.  On one rank. */
#ifndef FLUID_CHECK_PHASES_H
#define FLUID_CHECK_PHASES_H
#include "fluid/flow/fluid.h"

/* Prints a note on each level that is not within the heights of the mesh, and on each inflow whose phase the case does not say. */
void NoteBoundaries(const Mesh *mesh, const FluidSetup *setup);
/* On each half plane of another phase than the lightest that lies above its edge. */
void NoteRegions(const FluidSetup *setup, int nregions, const Region region[]);
/* On another phase that is as light as the lightest: only one of them fills solids and flows in. */
void NoteLightest(const FluidSetup *setup);
#endif
