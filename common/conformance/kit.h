/* What the examinations of an outside solid (solid.h) and of an outside fluid (fluid.h) share: the steps, checkpoints, rows.
 *
 * Step k is dt_max times 1, 1/3, 1/7 or 0.9 long (k mod 4); a fluid's no longer than it has proposed.  Every third step,
 * from the second on, is made several times.  All functions are collective over the kit's coupler; errors end the job.
 *
 * Keys, given by --set coupler.conformance.*: of (solid or fluid), steps (12), save (the step that begins with a
 * checkpoint; 0: none), folder (of the checkpoint and of rows.csv, one row a step), box (xmin, ymin, xmax, ymax: where the
 * fluid is coupled; the middle third of fluid.mesh by default). */
#ifndef CORACLE_CONFORMANCE_KIT_H
#define CORACLE_CONFORMANCE_KIT_H
#include "common/link/case_file.h"
#include "common/link/server.h"
#include <stdbool.h>
#include <stdio.h>

typedef struct {
  Server server;
  MPI_Comm comm;
  int rank, steps, save, first; /* first: step of the run that resumes, else 1 */
  bool of_fluid;
  int changed;             /* how often the participant has given another mesh, beyond the first */
  double t, dt, dt_max;    /* dt: of the current step, s */
  double density, gravity; /* fluid.density, kg/m3; |gravity| (1 where there is none), m/s2 */
  double box[4];           /* m; of a fluid */
  char folder[3000];
  FILE *rows; /* on rank 0 */
} Kit;

/* Joins, reads the case, and finds where the run begins. */
void KitOpen(int argc, char **argv, Kit *k);
/* Leaves after CORACLE_STOP has been sent to both. */
int KitClose(Kit *k);

/* After a flow or a motion has been received: a participant that cannot make the step is refused. */
void KitRefuseRejection(const Kit *k, int step);

double KitStepSize(const Kit *k, int step);
/* Whether the step is made several times. */
static inline bool KitRepeats(int step)
{
  return step % 3 == 2;
}
/* The angle of what the kit prescribes at the end of the current step. */
double KitPhase(const Kit *k);

/* Before the first row: the names of the columns behind step and t. */
void KitOpenRows(Kit *k, const char *columns);
/* value[n], the same on all ranks. */
void KitRow(Kit *k, int step, int n, const double value[]);

/* At the accepted end of `step`, before the next is sent: checkpoints that are due, and who has not saved the last. */
void KitCheckpoint(Kit *k, int step);
#endif
