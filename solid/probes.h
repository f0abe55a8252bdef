/* What is followed of the solid: points, the list solid.probes of the case, the lists solid.springs and solid.contact_probes, and prescribed motions that have a name.  solid_probes.csv has a row a step: the
 * time, for each probe its displacement from rest, m, and its velocity, m/s, interpolated in the element that has
 * the point at rest; on an edge or a node, the mean over the elements there; for each spring its length, m, and tension, N/m; for each name of a
 * motion the force that holds or moves its nodes, N/m, its moment about the pivot (or the origin), N, and its power, W/m; last, for each contact probe what SolidContactProbes
 * has. */
#ifndef SOLID_PROBES_H
#define SOLID_PROBES_H
#include "common/link/case_file.h"
#include "common/output/checkpoint.h"
#include "solid/solid.h"

typedef struct Probes_s *Probes; /* NULL: a case without any; every function takes it */

/* Not collective.  Reads the lists, so that the case can be checked before anything is made of it. */
void ProbesCheckCase(CoracleCase c);
/* Collective.  Reads the lists and refuses a point that is in no body at rest. */
PetscErrorCode ProbesCheckPoints(CoracleCase c, MPI_Comm comm, Solid solid);
/* Collective.  Reads the lists and output.folder; refuses a point that is in no body at rest. */
PetscErrorCode ProbesCreate(CoracleCase c, MPI_Comm comm, Solid solid, Checkpoint from, Probes *probes);
PetscErrorCode ProbesDestroy(Probes *probes);
/* Collective, between two steps. */
PetscErrorCode ProbesSave(Probes probes, Checkpoint to);
/* Collective, after every step that is final: one row. */
PetscErrorCode ProbesStep(Probes probes, Solid solid);
#endif
