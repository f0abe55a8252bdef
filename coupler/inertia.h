/* Coupling that is implicit in the solid's inertia, node by node (mode reaction), for solids that send their
 * nodes' mobility 1/m and acceleration f/m (CoracleSetInertia).
 *
 * A node of mass m that is free to move and displaces fluid of mass m_f ends the step at v with
 *
 *     m (v - v^n)/dt  =  f + Z (u - v) + m_f (u - v^n)/dt - m_f g
 *
 *     f    its forces other than the fluid's, N          Z    impedance: sum over its pairs of int a N_i, kg/s
 *     u    the fluid's velocity there                    the last two terms: added inertia and buoyancy (force.h)
 *
 * Elimination of v gives the fluid the effective velocity v' and the effective coefficient b a in place of v^n
 * and a:
 *
 *     v' = v^n + dt/(m - m_f) (f - m_f g),        b = 1/(1 + dt Z/(m - m_f)).
 *
 * As a grows u tends to v' with a total mass of m, so a may be arbitrarily large; with v^n and a the exchange
 * is explicit and stable for dt Z < m only, about relaxation rho_f < rho_s.  b is the implicit factor: it
 * scales the solid's part of the bulk velocity (ms, us), and (1 - b) a is the implicit inertia block that the
 * pressure correction moves with the fluid (coracle.h).  b = 1 and v' = v^n where the mobility is 0. */
#ifndef CORACLE_INERTIA_H
#define CORACLE_INERTIA_H
#include "coupler/overlap.h"
#include "coupler/wall_term.h"

/* Collective.  When some node has a mobility: implicit_factor[nsources] = b, the mean over the source triangle's
 * vertices; coefficient[pairs.n] *= b; the source triangles' velocity u becomes v'.  Else nothing changes.
 * gravity[2], m/s2; dt, s. */
PetscErrorCode InertiaMakeImplicit(Overlap overlap, const SolidState *solid, double dt,
                                   const double gravity[2], WallCoefficient coefficient[],
                                   double implicit_factor[]);
#endif
