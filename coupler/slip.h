/* The fluid's slip along the solid's surface in elements that the surface crosses (mode reaction).
 *
 * Such an element K has one linear velocity for the fluid beside the solid and for what fills the part of K inside
 * the solid.  Were all of that part given the solid's velocity after each step (force.h), the fluid beside it would be
 * slowed down by as much in each step, however short: the solid would become thicker as dt shrinks.  So in K the
 * correction is to the normal velocity alone; tangentially the flow beside the solid continues into it,
 *
 *     r_K  =  (I - D) (C^T u_s^{n+1} - B u+),     D = I - mean of n n over the shell in K;  D = 0 where K is in the
 *                                                 solid as a whole
 *
 * and what brings it to rest is viscous: the wall term (wall_term.h) and, in the part of K inside the solid,
 *
 *     a    =  SLIP_FRICTION mu/|K| D,
 *
 * which has neither dt nor a density in it.  What the inner part keeps of its slip, rho_f int N_T D (u+ - u_s), is
 * momentum of the fluid: the added inertia of the next step, which takes the inner part to begin with the solid's
 * velocity, is less by it.
 *
 * Among phases D is scaled by what is beside the solid (outside.h).
 *
 * SLIP_FRICTION moves the place of no slip by a small part of an element.  The disc of cases/falling_cylinder, against
 * body-fitted elements in the reference's tank (le 0.01 m, top at 20 m): with 0 it is 0.8, 0.7, 0.4, -0.1 % fast at
 * 0.1, 0.2, 0.5 and 2.5 s, with 2 0.3, 0.2, 0.1 and -0.1 %. */
#ifndef CORACLE_SLIP_H
#define CORACLE_SLIP_H
#include "coupler/outside.h"

#define SLIP_FRICTION 2.0

/* Local.  tangential[overlap->ncoupled]: D, without unit, scaled by outside[overlap->ncoupled].slip. */
PetscErrorCode SlipTensors(const Overlap overlap, const OutsideFluid outside[], WallCoefficient tangential[]);
/* Local: a of the pairs in the solid's volume, isotropic so far, becomes (I - D) a + SLIP_FRICTION mu/|K| D. */
void SlipCoefficients(const Overlap overlap, const WallCoefficient tangential[], PairTerm term[]);
/* Local: r -= D r of all corrections[overlap->ncoupled]. */
void SlipCorrection(const Overlap overlap, const WallCoefficient tangential[],
                    CoracleCorrection correction[]);
/* Local: retained[nsources][3][2] += rho_f int N_T D (u+ - u_s), kg m/s, with u[nsources][3][2] the solid's velocity at
 * the step's end, m/s. */
void SlipRetained(const Overlap overlap, const WallCoefficient tangential[], const double u[][3][2],
                  const double u_projected[], double retained[][3][2]);
#endif
