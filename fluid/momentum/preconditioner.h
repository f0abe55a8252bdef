/* The momentum equation's preconditioner.  Both components of the velocity are nearly decoupled, by the same
 * scalar operator S (momentum_operator.h), on which it works with two right-hand sides at once, in single
 * precision.  One application, z ~ S^-1 r:
 *
 *   coarse      z   = correction in continuous functions (continuous_space.h)
 *   forward     z_e = S_ee^-1 (r_e - sum over neighbours n of S_en z_n)          e = 0, 1, ...
 *   backward    the same                                                         e = ..., 1, 0
 *
 * and where an element has a dense block D_e, z_e = (S_ee + D_e)^-1 (...): what a solid's surface does to one direction may be a thousand
 * times what it does to the other.
 *
 * The coarse correction removes what viscosity spreads over many elements, relaxation the jumps and advected
 * errors.  Whether the former is needed, and its solver, follow from the largest number
 * D = theta mu dt/(rho |K|) of any element:
 *
 *   D < DIFFUSION_COARSE         no correction: an element hardly sees its neighbours
 *   D < DIFFUSION_MULTIGRID      incomplete factor
 *   else                         algebraic multigrid
 *
 * Neighbours on other ranks count with their values of the last exchange (before each sweep).  It is made anew
 * in every step: advection and the solid's stiff terms move. */
#ifndef FLUID_PRECONDITIONER_H
#define FLUID_PRECONDITIONER_H
#include "fluid/momentum/momentum_operator.h"
#include <petscksp.h>

#define DIFFUSION_COARSE 0.1
#define DIFFUSION_MULTIGRID 8.0

typedef struct Preconditioner_s *Preconditioner;

/* Becomes the preconditioner of ksp, unless its options choose another one.  Collective, like all of this. */
PetscErrorCode PreconditionerCreate(MomentumOperator *op, KSP ksp, Preconditioner *p);
/* For the operator as it has been assembled. */
PetscErrorCode PreconditionerUpdate(Preconditioner p);
/* z = (S_ee + D_e)^-1 r, [2][3], of the last PreconditionerUpdate, in double precision.  Not collective. */
void PreconditionerSolveElement(Preconditioner p, int e, const double r[6], double z[6]);
PetscErrorCode PreconditionerDestroy(Preconditioner *p);
#endif
