/* The momentum equation's preconditioner: both components of the velocity are nearly decoupled, by the same
 * scalar operator P, whose block for elements K and N is the mean of the xx and the yy part of the full one:
 *
 *     A_KN ~ [ P_KN   0   ]      6 x 6 from 3 x 3
 *            [  0    P_KN ]
 *
 * An incomplete factorisation of P is eight times cheaper than one of A, and moves a quarter of the memory,
 * which is what the iterations wait for.  It is made anew in every step: the solid's stiff terms move with
 * it. */
#ifndef FLUID_PRECONDITIONER_H
#define FLUID_PRECONDITIONER_H
#include "common/mesh/mesh.h"
#include <petscksp.h>

typedef struct Preconditioner_s *Preconditioner;

/* Becomes the preconditioner of ksp, unless its options choose another one.  Collective, like all of this. */
PetscErrorCode PreconditionerCreate(const Mesh *mesh, KSP ksp, Preconditioner *p);
/* For the assembled matrix of the momentum equation. */
PetscErrorCode PreconditionerUpdate(Preconditioner p, KSP ksp, Mat matrix);
PetscErrorCode PreconditionerDestroy(Preconditioner *p);
#endif
