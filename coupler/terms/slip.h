/* The fluid's slip along the solid's surface in elements that the surface crosses (mode reaction).
 *
 * 1. One fluid.
 *
 * Such an element K has one linear velocity for the fluid beside the solid and for what fills its part inside the solid.  Were all of that part
 * given the solid's velocity after each step (force.h), the fluid beside it would be slowed down by as much in each step, however short: the
 * solid would become thicker as dt shrinks.  So in K the correction is to the normal velocity alone, and along the surface the flow beside the solid
 * continues into it:
 *
 *     r_K  =  (I - D) (C^T u_s^{n+1} - B u+),     D  =  I - s^8 n n,     s n n  =  M - (1 - s)/2 I,     M = mean of n n over the shell in K,
 *
 * s the difference of M's principal values, n its first direction: s is 1 on a plane, 0.8 where a tenth of the surface in K is of a face at right angles.
 * At corners there is no correction, for one that acts on two directions takes a part of the flow past them in each step.  With D = I - M a block
 * that was let go 2 mm above a floor (le 12.5 mm, tests/coupled/lift.sh) rose by 1.5 mm within 0.1 s with steps of 5 ms, by 0.7 with 1.25, now by 1.8 and 1.0
 * (theory 1.25), and a square of 0.2 m that falls fell 1.4 and 0.5 % slower with steps of 1 than of 4 ms (le 0.02, 0.01 m), now 0.6 and - 0.1 %.
 * D = 0 where K is in the solid as a whole.
 *
 * Between fragments that are as small as elements nearly all elements have faces in several directions.  With D = I in all of them nothing held the water to debris at rest,
 * and it was set in motion again (tests/coupled/debris.sh: to 3.5 m/s within a second).  So where the mean of the normals in K is shorter than 0.6, faces
 * opposing each other,
 *
 *     D  =  q (I - s^8 n n),     q  =  min(1, what is open of K/0.3 + 2 s^2).
 *
 * A corner of a single body of more than 74 degrees has a longer mean, and a slot, s near 1, the same D.  Where all of these faces are held there is no body that D = 0 could
 * hold, and q = min(1, what is open of K/0.3): through the gaps of a row of held discs, which are far narrower than K, a difference of the pressure drove what fills K,
 * the solid's part too, with 2.2 m/s (tests/coupled/row.sh), and in a heap of stones on such a row without limit.
 *
 * At a corner (s < 0.95) of a part of the solid that is itself of the size of K, what the solid's forces, one for each of its nodes, leave in K drove a slip that nothing
 * but viscosity stopped: the water of tests/coupled/debris.sh was set in motion after all in two of four runs that differ in round-off, to 2.6 m/s, with a fifth of the viscosity to
 * 7 m/s.  There D is less by the factor
 *
 *     min(1, max(0, (|part|/|K| - 4)/12)),
 *
 * 0 for fragments of up to four elements, 1 from sixteen on.
 *
 * What brings the slip to rest is viscous, without dt and without a density: the wall term (wall_term.h) and, in the part of K inside the solid,
 *
 *     a    =  SLIP_FRICTION mu/|K| D.
 *
 * The slip that the inner part keeps, rho_f int N_T D (u+ - u_s), is momentum of the fluid.  The next step's added inertia, which takes the inner part to
 * begin with the solid's velocity, is less by it.
 *
 * SLIP_FRICTION moves the place of no slip by a small part of an element.  The disc of cases/falling_cylinder, against body-fitted elements in the
 * reference's tank (le 0.01 m, top at 20 m): with 0 it is 0.8, 0.7, 0.4, -0.1 % fast at 0.1, 0.2, 0.5 and 2.5 s, with 2 0.3, 0.2, 0.1
 * and -0.1 %.
 *
 * 2. Two solids that touch, in one fluid.
 *
 * An element that both cover together (shared) has surfaces in it, too, and D as above.  With D = 0 there the two were held to each other's mean
 * velocity by a part of their momentum in each step: a block on a slope slid with 0.09 of its acceleration when steps were a quarter as long
 * (tests/coupled/slope.sh).  The shell of one solid overlaps the other there.  But the correction is whole: it takes the element to the mean of the two
 * solids' velocities, and what that changes of its momentum the next step's added inertia gives to both.  Left to itself, what is in such elements
 * runs along the gap ten times as fast as the solid that slides, and its pressure presses the two together or apart.
 *
 * 3. Two solids that touch, one of them held, among phases.
 *
 * The same, for the inertia of the one that is held, INERTIA_MOST, would hold the other, too.  Along the surface the inertia begins with the fluid's
 * velocity, the mean that the correction left there, and each pair gets the mean of the reaction (ElementTerm.shared), which is what the
 * pressure's gradient gives to both: with its own, what drives one of them would be held there and would move the other.  Across the surface each has
 * its own: with the mean, a part of the contact's force, much of which acts in these elements, would go to the other solid in each step, and contact
 * could not take over what the pressure has beyond the head (uplift.h).  Normals are those of what is held alone: an element at the foot of a
 * block on a slope slides along the slope.  Two solids that are free accelerate together there, which lets them slide.
 *
 * 4. Otherwise among phases (Overlap.phases).
 *
 * What such an element, of one velocity, one density and one pressure, leaves of forces along a solid adds up where nothing stops it, and water is not
 * viscous enough to.  So slip ends with a rate, that with which gravity moves what is in an element by its size:
 *
 *     D  =  exp(-SLIP_RATE dt sqrt(g/le)) (I - s^8 n n),     le = sqrt(2 |K|),
 *
 * where all of what is open is of phases denser than what fills the solid and the solid is not much heavier (k = 1 in inertia.h).  D = 0 beside air, at an interface,
 * beside what is held, and without gravity.  With D = 0 everywhere all slip was lost in each step, and the coupling depended on dt.  The roll of tests/coupled/roll.sh,
 * error of half a period with le 0.008 m and steps of 2 and 0.5 ms, with le 0.004 m and 1 ms, and the fluid's largest speed with 0.5 ms:
 *
 *     SLIP_RATE         0              1              2              4              8              D = 0
 *     2, 0.5 ms, %      8.3, -         4.2, 4.4       3.6, 3.9       3.9, 3.4       4.1, 3.1       4.0, 2.7
 *     le 0.004 m, %     -              2.3            2.3            2.5            2.7            3.2
 *     speed, m/s        (unstable)     1.06           1.16           0.47           0.88           1.22
 *
 * At an interface, too, the kinetic energy with 0.5 ms is three times as large; in air without a rate what is beside a block at rest reaches 2.9 m/s. */
#ifndef CORACLE_SLIP_H
#define CORACLE_SLIP_H
#include "coupler/terms/wall_term.h"

#define SLIP_FRICTION 2.0
/* The power of s in D. */
#define SLIP_PLANE 8.0
/* There is a corner in K where s is less: 2.5 % of the surface is of a face at right angles.  A disc has none with four elements or more across. */
#define SLIP_CORNER 0.95
/* Of sqrt(g/le): the rate at which slip ends among phases (4). */
#define SLIP_RATE 4.0

/* Local, after InertiaCoefficients and OutsideDensity: D, along, shared, open and corner of element[overlap->ncoupled]. */
void SlipTensors(const Overlap overlap, const SourceTerm source[], const double gravity[2], double dt,
                 ElementTerm element[]);
/* Local: a of the pairs in the solid's volume becomes SLIP_FRICTION mu/|K| D. */
void SlipCoefficients(const Overlap overlap, const ElementTerm element[], PairTerm term[]);
/* Local: r -= D r of all corrections[overlap->ncoupled]. */
void SlipCorrection(const Overlap overlap, const ElementTerm element[], CoracleCorrection correction[]);
/* Local: retained[nsources][3][2] += rho_f int N_T D (u+ - u_s), kg m/s, with u[nsources] the solid's velocity at
 * the step's end, m/s. */
void SlipRetained(const Overlap overlap, const ElementTerm element[], const LinearField u[],
                  const double u_projected[], double retained[][3][2]);
#endif
