/* Notes of a case's check on phases.  On one rank. */
#ifndef FLUID_CHECK_PHASES_H
#define FLUID_CHECK_PHASES_H
#include "fluid/flow/fluid.h"

/* Prints a note on each level that is not within the heights of the mesh, and on each inflow whose phase the case does not say. */
void NoteBoundaries(const Mesh *mesh, const FluidSetup *setup);
/* On each half plane of another phase than the lightest that lies above its edge. */
void NoteRegions(const FluidSetup *setup, int nregions, const Region region[]);
/* On each region that lies outside of the box around the mesh. */
void NoteOutside(const Mesh *mesh, const FluidSetup *setup, int nregions, const Region region[]);
/* On each phase but the lightest that no region has and that comes in at no boundary. */
void NoteAbsent(const Mesh *mesh, const FluidSetup *setup, int nregions, const Region region[]);
/* On each gas of a lower pressure than the heaviest phase has at the bottom of the domain, filled to its top. */
void NoteGases(const Mesh *mesh, const FluidSetup *setup);
/* On another phase that is as light as the lightest: only one of them fills solids and flows in. */
void NoteLightest(const FluidSetup *setup);
#endif
