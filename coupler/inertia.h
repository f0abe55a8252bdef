/* The solid's own inertia in the fluid's solve (mode reaction), for solids that tell it (CoracleSetInertia).
 *
 * A node of mass m that moves freely and takes the place of fluid of mass m_f ends the step at
 *
 *     m (v - v^n)/dt = f + Z (u - v) + m_f (u - v^n)/dt
 *
 * with its own forces f, held by the weight a, Z = sum over its pairs of int a N_i; the last term is the
 * inertia of the fluid that is not there (force.h).  If the fluid meets, instead of v^n with the weight a,
 *
 *     v' = v^n + dt f/(m - m_f)    with the weight  b a,    b = 1/(1 + dt Z/(m - m_f)),
 *
 * then u -> v as a grows, and together they weigh m: the exchange is implicit in the solid's inertia, node by
 * node, and a may be as large as one likes.  Explicit, it is stable only for dt Z < m, which is relaxation
 * rho_f < rho_s or so.  The pressure moves solid and fluid together, too (coracle.h: give), and the bulk
 * velocity has the solid's only as far as it is firm, b.  What the fluid loses the solid gains, as ever.
 * Where nothing gives way b = 1 and v' = v^n. */
#ifndef CORACLE_INERTIA_H
#define CORACLE_INERTIA_H
#include "coupler/overlap.h"
#include "coupler/wall_term.h"

/* Collective, if any node has a mobility: firmness[npieces], the mean of b over the piece's vertices; weight
 * *= it; the pieces' velocity becomes v'. */
PetscErrorCode InertiaYield(Overlap overlap, const ServerSolid *solid, double dt, const double gravity[2],
                            WallWeight weight[], double firmness[]);
#endif
