/* The fluid's force on the solid's nodes, and the correction of the fluid to the solid's new velocity.  All
 * integrals are the pairs' own (overlap.h), which also make the fluid's coupling (wall_term.h): what the
 * fluid gains the solid loses, to round-off.
 *
 * With int over one pair (T a source triangle of the solid S or of its shell, K a fluid element), the pair's coefficient a,
 * inertia m G and body force q (wall_term.h), u and v the fluid's and the solid's velocity at the step's start:
 *
 *    reaction         R   =  int N_T (a (u* - u_s) + m G (u+ - u) - q + start (u - v))
 *                                                            all pairs: minus what the fluid is given
 *    added inertia    F_i =  int N_T rho_f (u+ - v)/dt       pairs in S: change of the inner fluid's momentum
 *    buoyancy         F_b = -int N_T rho_f g                 pairs in S: the pressure is total, also inside S
 *
 *    remainder        F_r =  r |pair|/|K and S|              pairs in S: CoracleFlow.remainder r of K, which is 0 in one fluid
 *
 *    F = sum over pairs of R + F_i + F_b + F_r
 *
 * which is the momentum balance of the fluid inside S.  The correction of element K is
 *
 *    r   =  sum over its pairs in S of  int N_K (u_s^{n+1} - u+),
 *
 * less its part along the surface where that crosses K (slip.h). */
#ifndef CORACLE_FORCE_H
#define CORACLE_FORCE_H
#include "coupler/terms/wall_term.h"

/* Force on a vertex of a source triangle, or on a node: the reaction, and all other parts. */
typedef struct {
  double reaction[2], other[2]; /* N */
} ForceVertex;

/* Totals over all ranks of one step. */
typedef struct {
  double reaction[2]; /* N, the reaction summed over the solid's nodes */
  double force[2];    /* N, the whole force on the solid, but for uplift */
  double uplift[2];   /* N, what the solid has beside it where it stands on a wall (uplift.h) */
  /* |gain + reaction| / sum over K of |K's gain|, the momentum per time given to the fluid, evaluated on the fluid's side: the sum over K of
   * s - a u* - I (G u+ - kept u start), I the implicit inertia, G its tensor; where K is covered, less rho_f M/dt u start */
  double imbalance;
  double displaced; /* kg, fluid mass inside the solid */
  double speed;     /* m/s, root mean square of u* near the solid */
  long long npairs;
} ForceTotals;

/* Local: vertex[nsources][3] of all pairs (overwritten): R, and F_i + F_b + F_r. */
PetscErrorCode ForceOfPairs(const Overlap overlap, const PairTerm term[], const ElementTerm element[],
                            const SourceTerm source[], const double gravity[2], double dt,
                            const CoracleFlow *flow, ForceVertex vertex[]);
/* Collective: the totals; coupling[ncoupled] is what the fluid was sent, flow what came back. */
PetscErrorCode ForceSum(const Overlap overlap, double dt, const CoracleCoupling coupling[],
                        const CoracleFlow *flow, int nnodes, const ForceVertex node[], ForceTotals *totals);
/* Local: correction[ncoupled].r += r; u[nsources]: u_s^{n+1}, m/s. */
void ForceCorrection(const Overlap overlap, const LinearField u[], const double u_projected[],
                     CoracleCorrection correction[]);
#endif
