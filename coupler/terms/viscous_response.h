/* What a solid's velocity at the step's end owes to the viscous friction of the fluid that the coupling has taken for known (mode reaction).
 *
 * The wall term (wall_term.h) pulls the solid with the velocity that was predicted for it.  An error v - v* of that changes the velocity that the solid gets
 * within the step by - chi (v - v*), so that with chi > 1 the errors of successive steps alternate and grow, whatever the solid's density.  A solid that
 * moves and turns as a whole has the larger one of
 *
 *     chi  =  dt int f dGamma/m,  dt int f r^2 dGamma/int r^2 dm,     f  =  1/(dxw/(WALL_PENALTY mu) + delta/mu),     delta  =  sqrt(mu dt/rho_f),
 *
 * m its mass, r from its centre (the second is twice the first for a disc or a square, and the same for a ring), f the friction of the wall term in series with that of the layer that viscosity reaches within the step (delta is 0 among phases, where an
 * element that the surface crosses moves with the solid).  Beyond VISCOUS_LIMIT coupling iterations find the velocity (coupling_iteration.h), whose explicit fraction is at least
 *
 *     1 - VISCOUS_LIMIT/chi.
 *
 * chi falls with dt: over dt VISCOUS_LIMIT/chi or a little less one iteration is enough.
 *
 * Measured (tests/coupled/viscous.sh): a disc as dense as the fluid that a shear flow turns is stable up to chi of 1.2 and alternates from 1.5 on. */
#ifndef CORACLE_VISCOUS_RESPONSE_H
#define CORACLE_VISCOUS_RESPONSE_H
#include "coupler/terms/wall_term.h"

#define VISCOUS_LIMIT 0.7

/* Collective.  explicit_fraction[nnodes] of free nodes becomes at least that of their part; term[pairs.n]: the wall term of the shell's pairs;
 * thickness: of the shell, m; *single: the longest step that one iteration would be enough for, s, on all ranks: infinite without viscosity, 0 where free nodes need
 * several over any step. */
PetscErrorCode ViscousExplicitFraction(Overlap overlap, const SolidState *solid, const PairTerm term[],
                                       double thickness, double dt, double explicit_fraction[],
                                       double *single);
#endif
