/* The fluid's force on the solid's nodes, and the correction of the fluid to the solid's new velocity.  All
 * integrals are the pairs' own (overlap.h), which also make the fluid's coupling (wall_term.h): what the
 * fluid gains the solid loses, to round-off.
 *
 * With C = int N_T N_K^T and M = int N_T N_T^T over one pair (T a source triangle of the solid S or of its
 * shell, K a fluid element), the pair's coefficient a, inertia m and body force q at T's vertices
 * (wall_term.h), u and v the fluid's and the solid's velocity at the step's start:
 *
 *    reaction         R   =  a (C u* - M u_s) + m C (u+ - u) - M q + start (C u - M v)
 *                                                       all pairs: minus what the fluid is given
 *    added inertia    F_i =  rho_f (C u+ - M v)/dt      pairs in S: change of the inner fluid's momentum
 *    buoyancy         F_b = -rho_f g M 1                pairs in S: the pressure is total, also inside S
 *
 *    F = sum over pairs of R + F_i + F_b
 *
 * which is the momentum balance of the fluid inside S.  The correction of element K is
 *
 *    r   =  sum over its pairs in S of  C^T u_s^{n+1} - B u+,     B = int N_K N_K^T,
 *
 * less its part along the surface where that crosses K (slip.h). */
#ifndef CORACLE_FORCE_H
#define CORACLE_FORCE_H
#include "coupler/wall_term.h"

/* Force on a vertex of a source triangle, or on a node: the reaction, and all other parts. */
typedef struct {
  double reaction[2], other[2]; /* N */
} ForceVertex;

/* Totals over all ranks of one step. */
typedef struct {
  /* N, momentum per time given to the fluid, evaluated on the fluid's side: the sum over K of
   * s - a u* - I (u+ - kept u start), I the implicit inertia; where K is covered, less rho_f M/dt u start */
  double gain[2];
  double reaction[2]; /* N, the reaction summed over the solid's nodes */
  double force[2];    /* N, the whole force on the solid */
  double imbalance;   /* |gain + reaction| / sum over K of |K's gain| */
  double displaced;   /* kg, fluid mass inside the solid */
  double speed;       /* m/s, root mean square of u* near the solid */
  long long npairs;
} ForceTotals;

/* Local: vertex[nsources][3].reaction += R of all pairs; start_velocity[nsources][3][2]: v, m/s. */
void ForceReaction(const Overlap overlap, const PairTerm term[], const double start_velocity[][3][2],
                   const CoracleFlow *flow, ForceVertex vertex[]);
/* Local: vertex[nsources][3].other += F_i + F_b of the volume pairs; start_velocity[nsources][3][2]: v,
 * m/s. */
void ForceInertia(const Overlap overlap, double dt, const double gravity[2], const double u_projected[],
                  const double start_velocity[][3][2], ForceVertex vertex[]);
/* Collective: sums the vertices' forces on the nodes of their owner ranks, node[nnodes] (overwritten). */
PetscErrorCode ForceAssembleToOwners(Overlap overlap, const ForceVertex vertex[], int nnodes,
                                     ForceVertex node[]);
/* Collective: the totals; coupling[ncoupled] is what the fluid was sent, flow what came back. */
PetscErrorCode ForceSum(const Overlap overlap, double dt, const CoracleCoupling coupling[],
                        const CoracleFlow *flow, int nnodes, const ForceVertex node[], ForceTotals *totals);
/* Local: correction[ncoupled].r += r; u[nsources][3][2]: u_s^{n+1} at the source triangles' vertices, m/s. */
void ForceCorrection(const Overlap overlap, const double u[][3][2], const double u_projected[],
                     CoracleCorrection correction[]);
#endif
