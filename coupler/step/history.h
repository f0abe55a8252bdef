/* What the coupler keeps of the last step at the solid's nodes: their acceleration over the step, a^n, that before it, and what of it lasts,
 *
 *     min(1, max(0, a^n.a^{n-1}/|a^n|^2), max(0, a^n.a^{n-2}/|a^n|^2)) a^n,
 *
 * which predicts the velocity at the end of the coming step; their acceleration by what is outside of the solid but moves its inside
 * too, the shell's reaction (inertia.h) and the load of the pressure outside, if there is one (pressure_load.h); that which holds them against
 * the fluid inside, minus the rest of the fluid's force over their mass; and the
 * momentum that the fluid inside has kept of its slip (slip.h), which the caller adds after HistoryStep.  In checkpoints.
 *
 * With all of a^n vibrations that alternate from step to step grow where the fluid's friction stops a wall within a step (a skin of
 * 0.05 kg/m2 in a fluid of 0.1 Pa s with steps of 1 ms, cases/elastic_membrane).  With what a^n and a^{n-1} have in common they do not grow, but go on
 * with a period of three steps: the skin's force on the fluid, le 0.004 m, jumps by 0.28 N (second difference, rms from 0.012 to 0.04 s) instead of 0.04.  Without
 * prediction by 0.006, but then the disc of cases/falling_cylinder is 1.8 % fast at 0.1 s with steps of 10 ms. */
#ifndef CORACLE_HISTORY_H
#define CORACLE_HISTORY_H
#include "common/output/checkpoint.h"
#include "coupler/geometry/solid_state.h"

typedef struct {
  MPI_Comm comm;
  int n;                     /* nodes on this rank */
  PetscBool known;           /* the same on all ranks */
  long long *gid;            /* [n] */
  double (*acceleration)[2]; /* [n] m/s2 */
  double (*earlier)[2];      /* [n] of the step before, m/s2 */
  double (*lasting)[2];      /* [n] m/s2 */
  double (*outside)[2];      /* [n] m/s2 */
  double (*against)[2];      /* [n] m/s2 */
  double (*retained)[2];     /* [n] kg m/s, known after cracks, too; each copy of a node has a part of it */
} History;                   /* zero-initialise but for comm: nothing is known */

/* Collective: a step of dt seconds has ended with `moved`; start[n][2]: the velocity at its start, m/s;
 * outside[n][2], against[n][2]: those accelerations, m/s2.  After cracks, which make other nodes, nothing
 * is known but what is retained, 0 at first. */
PetscErrorCode HistoryStep(History *h, const SolidState *moved, double dt, const double start[],
                           const double outside[], const double against[]);
/* Collective.  Load gives this rank's nodes, those of `solid`, what any rank has saved of them; 0 for nodes
 * that nobody has. */
PetscErrorCode HistorySave(const History *h, Checkpoint to);
PetscErrorCode HistoryLoad(History *h, const SolidState *solid, Checkpoint from);
PetscErrorCode HistoryDestroy(History *h);
#endif
