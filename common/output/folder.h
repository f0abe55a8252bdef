/* Private to the output room. */
#ifndef CORACLE_OUTPUT_FOLDER_H
#define CORACLE_OUTPUT_FOLDER_H
#include "common/output/checkpoint.h"

/* Collective: rank 0 makes the folder with those above it, if missing. */
PetscErrorCode FolderMake(MPI_Comm comm, const char *folder);
/* Collective: whether a checkpoint, which is there, is one of the runs in folder. */
PetscBool FolderHolds(MPI_Comm comm, const char *folder, const char *checkpoint);
/* Collective: whether a file of folder resumes from a checkpoint (else NULL): that is of a run in folder, and the
 * file is there. */
PetscBool FolderGoesOn(MPI_Comm comm, const char *folder, const char *file, Checkpoint from);
/* Not collective: a file or folder is on the disk, as far as this computer can say. */
PetscErrorCode FolderSync(const char *path);
/* Not collective: all files of a folder, and the folder itself. */
PetscErrorCode FolderSyncAll(const char *folder);
/* Collective: the same error on all ranks when rank 0 had one; its own message comes from rank 0. */
PetscErrorCode AgreeWithRoot(MPI_Comm comm, PetscErrorCode failed);
#endif
