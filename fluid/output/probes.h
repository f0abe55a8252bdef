/* What is recorded of the flow at points, on lines and at gauges: the list fluid.probes of the case (probe_case.h).
 * fluid_probes.csv has a row a step: the time, then for each probe
 *
 *   point        name_u, name_v [m/s], name_p [Pa]; of several phases also name_rho [kg/m3], the density of the element
 *   line         the same of each of its points, name0_u, ...
 *   solid_point  name_x, name_y [m], where the point of the solid is, and name_p [Pa], the pressure of the fluid before it:
 *                at x + distance n, n out of the solid (by default one edge of fluid.adapt.size_min); where that is not
 *                in the mesh or in another solid, beneath a body that stands on a floor or on another, at x - 0.05 distance n;
 *                nan if that is not in the mesh either (by more than contact needs)
 *   solid_line   the same of each of its gauges, name0_x, ..., then name_force_x, name_force_y [N/m] and name_moment [N]: the force of
 *                the pressure on that side and its moment about the side's first end, where that is (solid_gauge.h)
 *   surface      name_first, name_last, name_length [m]: where the phase first ends along the segment, its
 *                farthest point, and how much of the segment it has (surface_gauge.h)
 *   phase        name_area [m2], name_x, name_y [m], name_u, name_v [m/s], name_interface [m]: of the whole phase its area,
 *                the means of place and velocity over it, and the length of its interface (phase_gauge.h)
 *   flow         name_flow [m2/s]: the volume of the phase, or of all, that flows through the segment, to the right as one
 *                goes from `from` to `to`; what solids displace counts as the lightest phase (flow_gauge.h)
 *
 * Velocity is P1DG (on a face or a vertex the mean over the elements there), pressure P2, both as of the step's end. */
#ifndef FLUID_PROBES_H
#define FLUID_PROBES_H
#include "common/link/case_file.h"
#include "fluid/flow/fluid.h"

typedef struct Probes_s *Probes; /* NULL: a case without probes; every function takes it */

/* Collective over mesh->comm.  Reads the list; refuses a point outside of the mesh. */
PetscErrorCode ProbesCreate(CoracleCase c, const Mesh *mesh, Probes *probes);
/* Collective: the next steps are on this mesh. */
PetscErrorCode ProbesNewMesh(Probes probes, const Mesh *mesh);
/* Collective: the series in output.folder, or as at the checkpoint. */
PetscErrorCode ProbesOpen(Probes probes, CoracleCase c, Checkpoint from);
/* Collective, between two steps. */
PetscErrorCode ProbesSave(Probes probes, Checkpoint to);
/* Collective, after every step that is final: one row.  gauge[n]: the gauges on the solid, in the list's order. */
PetscErrorCode ProbesStep(Probes probes, Fluid fluid, int n, const CoracleGauge gauge[]);
PetscErrorCode ProbesDestroy(Probes *probes);
#endif
