/* The two examinations: a run in which an outside solid or an outside fluid meets a coupler without physics, which says
 * what it does wrong.  Collective over the kit's coupler; an error, which ends the job, says what was expected. */
#ifndef CORACLE_CONFORMANCE_EXAMINE_H
#define CORACLE_CONFORMANCE_EXAMINE_H
#include "common/conformance/kit.h"

/* The force on a node is its part of the solid's area times fluid.density |gravity|, in a direction that turns with time,
 * so that it is about the weight of the displaced fluid.  A step that repeats:
 *
 *     RUN force F  ->  REDO force F + G  ->  REDO force F:   the last must give the first's bits, the second must have
 *                                                            moved with G, not against it */
void ExamineSolid(Kit *k);

/* The fluid's elements in a disc inside kit.box are driven towards a velocity V that turns with time; the disc and its box
 * move once.  A step that repeats, with B = int N_i N_j of an element and tau = dt/10^6, so that all but the coupling is
 * negligible (v: velocity at the step's start, |: over all elements of the box):
 *
 *     RUN  a = 9 rho B/dt towards V, as a solid that is held
 *     REDO the same towards V + G                must have moved with G
 *     REDO tau, no coupling                      u* = u_start = v, with the correction of the step before
 *     REDO tau, s = rho B w/tau                  | rho (u* - v) = tau s
 *     REDO tau, a = 9 rho B/tau                  | rho (u* - v) = -tau a u*
 *     REDO tau, ms = B, us = B w                 the fluid around the disc is displaced
 *     REDO tau, implicit inertia 9 rho B/tau,    | rho (u* - v) = tau s - tau (inertia) (u* - u_start); the pressure
 *          s = 10 rho B w/tau, kept = 1          moves the disc a tenth as much
 *     REDO tau, the same, kept and inertia       | rho (u* - v) = tau s - tau (inertia) (inertia_tensor u* - kept u_start)
 *          tensors
 *     REDO tau, the same, covered                | rho (u* - v) = tau s - (tau (inertia) u* + rho B u_start)
 *     REDO as the first                          the first's bits */
void ExamineFluid(Kit *k);
#endif
