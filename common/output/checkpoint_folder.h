/* The folders of a run's checkpoints.
 *
 *     <output.folder>/checkpoint -> checkpoint.1234      the last complete one, made after 1234 steps
 *                     checkpoint.1234/fluid.h5, ..       what each participant saves (checkpoint.h)
 *
 * A new one is made beside it; then the symbolic link is replaced, which is atomic, and the old one removed: a run that is
 * killed leaves a complete checkpoint.  Of one rank, not collective. */
#ifndef CORACLE_CHECKPOINT_FOLDER_H
#define CORACLE_CHECKPOINT_FOLDER_H
#include "common/output/checkpoint.h"

enum { CHECKPOINT_RUN = 40 };

/* A name of this run among others: the time and the process. */
void CheckpointFolderRun(char run[CHECKPOINT_RUN]);
/* Makes the folder path, <link>.<steps>, with the identity of a checkpoint at t, s. */
PetscErrorCode CheckpointFolderMake(const char *path, const char *run, long long steps, double t);
/* All of it has been saved: <link> means it, and those beside it, incomplete ones too, are removed. */
PetscErrorCode CheckpointFolderPublish(const char *path);
/* Removes it and the files in it. */
void CheckpointFolderRemove(const char *path);
#endif
