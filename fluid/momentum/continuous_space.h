/* The continuous linear functions (P1) within the discontinuous ones (P1DG), with a solver of their own: the coarse space of the
 * momentum equation's preconditioner.  Interior penalty keeps jumps between elements small, so that what a
 * relaxation element by element leaves over is nearly continuous.
 *
 *     P1DG, 3 values an element             P1, one value a vertex
 *        restrict:  r_v = sum of r over the elements around v
 *        extend:    z at each element's vertex v  =  z_v
 *
 * In continuous functions jumps vanish, and with them every interior face: the matrix is the sum of the elements' volume blocks. */
#ifndef FLUID_CONTINUOUS_SPACE_H
#define FLUID_CONTINUOUS_SPACE_H
#include "common/mesh/mesh.h"
#include "fluid/momentum/single.h"
#include <petscksp.h>

typedef struct ContinuousSpace_s *ContinuousSpace;

/* mesh is borrowed.  Collective, like all of this. */
PetscErrorCode ContinuousSpaceCreate(const Mesh *mesh, ContinuousSpace *s);
PetscErrorCode ContinuousSpaceDestroy(ContinuousSpace *s);
/* The matrix from the elements' blocks, [ne][9], column-major, and its solver: an incomplete factor, or
 * multigrid (prefixes momentum_factor_ and momentum_multigrid_). */
PetscErrorCode ContinuousSpaceUpdate(ContinuousSpace s, PetscBool multigrid, const double block[][9]);
/* z[ne] = extension of the solution for the restriction of r[ne][2][3]. */
PetscErrorCode ContinuousSpaceCorrect(ContinuousSpace s, const double r[], SingleVector z[]);
#endif
