/* Checkpoints of the whole run: when they are made, and where they are (common/output/checkpoint_folder.h).
 *
 *     <output.folder>/checkpoint.1234/fluid.h5, ..       what each participant saves; <role>.state (link)
 *                                     fluid.seconds, ..  CPU seconds used by each participant so far
 *
 * One is made in a step in which all participants save.  All functions are collective. */
#ifndef CORACLE_CHECKPOINTS_H
#define CORACLE_CHECKPOINTS_H
#include "common/link/server.h"
#include "common/output/checkpoint_folder.h"
#include "coupler/input/coupler_case.h"

typedef struct {
  MPI_Comm comm;
  Server server;            /* borrowed */
  const char *folder;       /* output.folder, borrowed */
  char run[CHECKPOINT_RUN]; /* of the coupler's rank 0 */
  double every, last;       /* wall-clock seconds: between two (0: none), and when the last was made */
  char due[600];            /* folder of the one due in the current step, or "" */
  PetscBool rejected;       /* an attempt at the current step has been */
  PetscBool impossible;     /* a participant saves nothing */
} Checkpoints;

/* The output folder has been claimed (common/output/claim.h). */
PetscErrorCode CheckpointsCreate(MPI_Comm comm, Server server, const CouplerCase *c, Checkpoints *k);
/* Before the step after `steps` steps, at t, or the end, is sent: if a checkpoint is due, requests it from all
 * clients and sets `due`. */
PetscErrorCode CheckpointsRequest(Checkpoints *k, long long steps, double t, PetscBool end);
/* A participant rejects an attempt at the current step: it may not have come to where it saves. */
void CheckpointsReject(Checkpoints *k);
/* After that step, or when all clients have closed: publishes the checkpoint if all have saved; after a rejection one that has not
 * may do so in the next step. */
PetscErrorCode CheckpointsFinish(Checkpoints *k);
#endif
