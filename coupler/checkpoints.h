/* When checkpoints are made, and where they are:
 *
 *     <output.folder>/checkpoint -> checkpoint.1234   the last whole one, made after 1234 steps
 *                     checkpoint.1234/fluid.h5 coupler.h5 solid.h5    or what else clients save; .state (link)
 *                                     fluid.seconds ..                what they have used
 *
 * A new one is made beside it in a step in which all participants save; the link is then moved, which
 * happens at once or not at all, and the old one removed.  A run that is killed leaves a whole checkpoint. */
#ifndef CORACLE_CHECKPOINTS_H
#define CORACLE_CHECKPOINTS_H
#include "common/link/server.h"
#include "coupler/coupler_case.h"

typedef struct {
  MPI_Comm comm;
  Server server;        /* borrowed */
  const char *folder;   /* the output's, borrowed */
  char run[40];         /* names the run: when and by which process it was started */
  double every, last;   /* seconds between two, 0: none; clock when the last was made */
  char due[600];        /* the one in the step in hand, or "" */
  PetscBool impossible; /* a participant saves nothing */
} Checkpoints;

/* All collective.  The folder has been claimed (common/output/claim.h). */
PetscErrorCode CheckpointsCreate(MPI_Comm comm, Server server, const CouplerCase *c, Checkpoints *k);
/* Before the step after `steps`, or the end, is sent: if it is time, has all clients save, and `due` is
 * where to save, too. */
PetscErrorCode CheckpointsAsk(Checkpoints *k, long long steps, double t, PetscBool end);
/* After that step, or when all clients have closed. */
PetscErrorCode CheckpointsFinish(Checkpoints *k);
#endif
