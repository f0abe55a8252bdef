#include "common/output/folder.h"
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static PetscErrorCode MakeWithParents(const char *folder)
{
  char path[PETSC_MAX_PATH_LEN];
  struct stat there;
  PetscFunctionBeginUser;
  const int n = snprintf(path, sizeof path, "%s", folder);
  PetscCheck(n > 0 && n < (int)sizeof path, PETSC_COMM_SELF, PETSC_ERR_ARG_SIZ, "output folder '%s'", folder);
  for (char *end = path + 1;; end++) {
    if (*end && *end != '/') continue;
    const char was = *end;
    *end = 0;
    PetscCheck(!mkdir(path, 0777) || errno == EEXIST, PETSC_COMM_SELF, PETSC_ERR_FILE_WRITE,
               "output folder %s: %s", path, strerror(errno));
    if (!was) break;
    *end = was;
  }
  PetscCheck(!stat(path, &there) && S_ISDIR(there.st_mode), PETSC_COMM_SELF, PETSC_ERR_FILE_WRITE,
             "output folder %s: there is a file of that name", path);
  PetscFunctionReturn(0);
}

PetscErrorCode AgreeWithRoot(MPI_Comm comm, PetscErrorCode failed)
{
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Bcast(&failed, 1, MPI_INT, 0, comm));
  PetscFunctionReturn(failed);
}

PetscErrorCode FolderMake(MPI_Comm comm, const char *folder)
{
  PetscMPIInt rank;
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  PetscCall(AgreeWithRoot(comm, rank == 0 ? MakeWithParents(folder) : 0));
  PetscFunctionReturn(0);
}

PetscBool FolderHolds(MPI_Comm comm, const char *folder, const char *checkpoint)
{
  PetscMPIInt rank, holds = 0;
  MPI_Comm_rank(comm, &rank);
  if (rank == 0) {
    char *whole = realpath(folder, NULL), *inside = realpath(checkpoint, NULL);
    char *last = inside ? strrchr(inside, '/') : NULL;
    if (last) *last = 0;
    holds = whole && last && !strcmp(whole, inside);
    free(whole);
    free(inside);
  }
  MPI_Bcast(&holds, 1, MPI_INT, 0, comm);
  return holds ? PETSC_TRUE : PETSC_FALSE;
}

PetscBool FolderGoesOn(MPI_Comm comm, const char *folder, const char *file, Checkpoint from)
{
  PetscMPIInt rank, there;
  if (!from || !FolderHolds(comm, folder, CheckpointFolder(from))) return PETSC_FALSE;
  MPI_Comm_rank(comm, &rank);
  there = rank == 0 && !access(file, F_OK);
  MPI_Bcast(&there, 1, MPI_INT, 0, comm);
  return there ? PETSC_TRUE : PETSC_FALSE;
}

PetscErrorCode FolderSync(const char *path)
{
  PetscFunctionBeginUser;
  const int file = open(path, O_RDONLY | O_CLOEXEC);
  const int wrong =
      file < 0 || (fsync(file) && errno != EINVAL && errno != EROFS); /* some file systems cannot */
  PetscCheck(!wrong, PETSC_COMM_SELF, PETSC_ERR_FILE_WRITE, "%s: %s", path, strerror(errno));
  close(file);
  PetscFunctionReturn(0);
}

PetscErrorCode FolderSyncAll(const char *folder)
{
  char path[PETSC_MAX_PATH_LEN + 256];
  PetscFunctionBeginUser;
  DIR *list = opendir(folder);
  PetscCheck(list, PETSC_COMM_SELF, PETSC_ERR_FILE_OPEN, "%s: %s", folder, strerror(errno));
  for (const struct dirent *entry; (entry = readdir(list));) {
    snprintf(path, sizeof path, "%s/%s", folder, entry->d_name);
    if (strcmp(entry->d_name, ".") && strcmp(entry->d_name, "..")) PetscCall(FolderSync(path));
  }
  closedir(list);
  PetscCall(FolderSync(folder));
  PetscFunctionReturn(0);
}
