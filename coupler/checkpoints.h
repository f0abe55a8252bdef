/* Checkpoints of the whole run: when they are made, and where they are.
 *
 *     <output.folder>/checkpoint -> checkpoint.1234      the last complete one, made after 1234 steps
 *                     checkpoint.1234/fluid.h5, ..       what each participant saves; <role>.state (link)
 *                     checkpoint.1234/fluid.seconds, ..  CPU seconds used by each participant so far
 *
 * A new one is made beside it in a step in which all participants save; then the symbolic link is replaced,
 * which is atomic, and the old one removed: a run that is killed leaves a complete checkpoint.
 * All functions are collective. */
#ifndef CORACLE_CHECKPOINTS_H
#define CORACLE_CHECKPOINTS_H
#include "common/link/server.h"
#include "coupler/input/coupler_case.h"

typedef struct {
  MPI_Comm comm;
  Server server;        /* borrowed */
  const char *folder;   /* output.folder, borrowed */
  char run[40];         /* identifies the run: start time and process id of the coupler's rank 0 */
  double every, last;   /* wall-clock seconds: between two (0: none), and when the last was made */
  char due[600];        /* folder of the one due in the current step, or "" */
  PetscBool impossible; /* a participant saves nothing */
} Checkpoints;

/* The output folder has been claimed (common/output/claim.h). */
PetscErrorCode CheckpointsCreate(MPI_Comm comm, Server server, const CouplerCase *c, Checkpoints *k);
/* Before the step after `steps` steps, at t, or the end, is sent: if a checkpoint is due, requests it from all
 * clients and sets `due`. */
PetscErrorCode CheckpointsRequest(Checkpoints *k, long long steps, double t, PetscBool end);
/* After that step, or when all clients have closed: publishes the checkpoint if all have saved. */
PetscErrorCode CheckpointsFinish(Checkpoints *k);
#endif
