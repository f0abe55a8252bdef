/* Harmonic functions inside the solid: from values at some of its nodes, those at the others by the Laplacian's linear elements on the
 * solid's mesh as it is now (nodal_system.h).  The Laplacian does not know rotations and deformation changes it little, so that the factor of the
 * first solve serves: on one rank three iterations at the start of FSI3 (cases/flexible_beam), six when the beam swings. */
#ifndef CORACLE_COUPLER_HARMONIC_H
#define CORACLE_COUPLER_HARMONIC_H
#include "common/exchange/copies.h"
#include "coupler/geometry/solid_state.h"

typedef struct Harmonic_s *Harmonic;

/* Not collective: for the solid's elements on this rank, which stay the same. */
PetscErrorCode HarmonicCreate(MPI_Comm comm, const SolidState *solid, Harmonic *harmonic);
PetscErrorCode HarmonicDestroy(Harmonic *harmonic);
/* Collective.  x[nnodes][2]: where the nodes are, m; is_given[nnodes], the same for all copies of a node; value[nnodes][nfields]: of those,
 * and on return of all.  Nodes that no given one is connected with get 0. */
PetscErrorCode HarmonicSolve(Harmonic harmonic, Copies nodes, const double x[], const char is_given[],
                             int nfields, double value[]);
#endif
