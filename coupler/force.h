/* What the fluid does to the solid, on the solid's nodes, and the solid's new velocity for the fluid.  All
 * integrals are the pairs' own (overlap.h), so that momentum is neither made nor lost (method.md sections 8
 * and 9).
 *
 * With C = int N_T N_K^T and M = int N_T N_T^T over one pair (T a piece, K a fluid element, a the pair's
 * weight):
 *
 *    reaction         R = a (C u* - M u_s)                    what s_c gives to the fluid, with the opposite
 * sign added inertia    rho_f (C u+ - M u_s) / dt               volume pairs: the fluid that moves with the
 * solid buoyancy         -rho_f g M 1                            volume pairs: the fluid carries total
 * pressure, also inside
 *
 * F_hydro = R + d/dt (momentum of the fluid inside) - M_f g follows from the momentum balance of the fluid
 * inside the solid. */
#ifndef CORACLE_FORCE_H
#define CORACLE_FORCE_H
#include "coupler/wall_term.h"

/* Contributions of pieces' vertices: the reaction, and everything else. */
typedef struct {
  double reaction[2], rest[2]; /* N */
} ForceVertex;

/* Totals over all ranks of one step. */
typedef struct {
  double gain[2]; /* N, momentum per time given to the fluid, from the fluid's side: sum over K of s - a u* -
                     give (u+ - u*) */
  double reaction[2]; /* N, the reaction summed over the solid's nodes */
  double force[2];    /* N, the whole force on the solid */
  double imbalance;   /* |gain + reaction| / sum over K of |s - a u*| */
  double displaced;   /* kg, fluid mass inside the solid */
  long long npairs;
} ForceTotals;

/* Local: vertex[npieces][3].reaction += of all pairs, to u* where the solid is firm (firmness[npieces] 1), to
 * u+ as far as it gives way. */
void ForceReaction(const Overlap overlap, const WallWeight weight[], const double firmness[],
                   const CoracleFlow *flow, ForceVertex vertex[]);
/* Local: vertex[npieces][3].rest += added inertia and buoyancy of the volume pairs; now[npieces][3][2]: the
 * solid's velocity when the step began. */
void ForceInertia(const Overlap overlap, double dt, const double gravity[2], const double u_projected[],
                  const double now[][3][2], ForceVertex vertex[]);
/* Collective: brings the contributions home: node[nnodes]. */
PetscErrorCode ForceAssembleToOwners(Overlap overlap, const ForceVertex vertex[], int nnodes,
                                     ForceVertex node[]);
/* Collective: the totals; coupling is what the fluid was sent, flow what came back. */
PetscErrorCode ForceSum(const Overlap overlap, const CoracleCoupling coupling[], const CoracleFlow *flow,
                        int nnodes, const ForceVertex node[], ForceTotals *totals);
/* Local: adds to r (coracle.h); u[npieces][3][2]: the solid's new velocity on the old overlap. */
void ForceCorrection(const Overlap overlap, const double u[][3][2], const double u_projected[],
                     CoracleCorrection correction[]);
#endif
