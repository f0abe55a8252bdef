/* The boundaries of a case file (fluid.boundaries). */
#ifndef FLUID_BOUNDARY_CASE_H
#define FLUID_BOUNDARY_CASE_H
#include "fluid/discretization/boundary.h"
#include "fluid/input/phase_case.h"

/* boundary[mesh->ntags] in the mesh's order.  Refuses names that the mesh has not, and prescribed velocities that fill or empty a
 * domain without an open boundary.  names, properties: of the phases (PhaseCaseRead).  Collective over mesh->comm. */
PetscErrorCode BoundaryCaseRead(CoracleCase c, const Mesh *mesh, const PhaseNames *names,
                                const PhaseProperties *properties, Boundary boundary[]);
/* Refuses the checkpoint in `folder`, whose mesh this is, unless its boundaries are those of the case.  Not collective. */
void BoundaryCaseCheckResumed(CoracleCase c, const Mesh *mesh, const char *folder);
#endif
