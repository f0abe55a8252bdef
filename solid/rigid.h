/* Bodies of rigid materials (`law: rigid`): their elements have no stiffness, and what holds their nodes together is
 *
 *     f_i  =  m_i (A + a x r_i - w^2 r_i) - F_i,      A = sum F_i/M,   a = sum r_i x F_i/I,
 *
 * beside all other forces F_i (contact, springs, loads, the fluid's), r_i from the mass centre, w the angular velocity: without resultant and without moment.  Each substep moves
 * them rigidly: with the momentum and angular momentum about the centre that the nodes have by then, M V and I w,
 *
 *     x_i  +=  h v_i,     v_i  =  V + (R - 1) r_i/h,     R the rotation by asin(h w),
 *
 * the chords of a rotation, with which sum m_i r_i x v_i about the new centre is I w again: both momenta are kept to round-off.
 *
 * A body that moves as prescribed in one component alone (a guide) does not turn; the moment that this takes is the motion's.
 *
 * Substeps are a tenth of the step at most, and turn a body by no more than a twentieth; else contact and springs limit them.  On a bed of stiffness k per area the squared frequency is at
 * most k int (1/M + (r x n)^2/I) over the surface, the trace of M^-1 K (RigidBody.surface_compliance). */
#ifndef SOLID_RIGID_H
#define SOLID_RIGID_H
#include "solid/solid_impl.h"

/* Of the subdomain that has just been taken; not collective.  Freed by RigidFree. */
PetscErrorCode RigidFind(Solid s);
PetscErrorCode RigidFree(Solid s);
/* Collective, where any body is rigid.  Adds to the complete forces those that hold such bodies together. */
PetscErrorCode RigidConstrain(Solid s);
/* Collective: after all nodes have moved, those of rigid bodies move so in place of it. */
PetscErrorCode RigidMove(Solid s);
/* Not collective: the longest substep, s; infinite without rigid bodies. */
double RigidLongestSubstep(Solid s);
/* Collective.  value[nnodes][2], forces, becomes m (A + a x r) of them in rigid bodies. */
PetscErrorCode RigidDistribute(Solid s, double value[]);
#endif
