#include "common/output/checkpoint_folder.h"
#include "common/output/folder.h"
#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

enum { LONGEST = PETSC_MAX_PATH_LEN };

void CheckpointFolderRun(char run[CHECKPOINT_RUN])
{
  snprintf(run, CHECKPOINT_RUN, "%llx-%d", (unsigned long long)time(NULL), (int)getpid());
}

void CheckpointFolderRemove(const char *path)
{
  char file[LONGEST];
  DIR *list = opendir(path);
  if (!list) return;
  for (const struct dirent *entry; (entry = readdir(list));) {
    snprintf(file, sizeof file, "%s/%s", path, entry->d_name);
    if (strcmp(entry->d_name, ".") && strcmp(entry->d_name, "..")) unlink(file);
  }
  closedir(list);
  rmdir(path);
}

PetscErrorCode CheckpointFolderMake(const char *path, const char *run, long long steps, double t)
{
  char identity[128];

  PetscFunctionBeginUser;
  CheckpointFolderRemove(path);
  PetscCheck(!mkdir(path, 0777), PETSC_COMM_SELF, PETSC_ERR_FILE_WRITE, "%s: %s", path, strerror(errno));
  snprintf(identity, sizeof identity, "run %s, step %lld, t = %.17g s", run, steps, t);
  PetscCall(CheckpointIdentify(path, identity));
  PetscFunctionReturn(0);
}

/* Removes all checkpoints of a folder but `current`: the previous one, and incomplete ones of runs that were killed. */
static void RemoveOthers(const char *folder, const char *current)
{
  char path[LONGEST + 256];
  const size_t n = (size_t)(strrchr(current, '.') - current) + 1;
  DIR *list = opendir(folder);
  if (!list) return;
  for (const struct dirent *entry; (entry = readdir(list));) {
    if (strncmp(entry->d_name, current, n) || !strcmp(entry->d_name, current)) continue;
    if (strspn(entry->d_name + n, "0123456789") != strlen(entry->d_name + n)) continue;
    snprintf(path, sizeof path, "%s/%s", folder, entry->d_name);
    CheckpointFolderRemove(path);
  }
  closedir(list);
}

PetscErrorCode CheckpointFolderPublish(const char *path)
{
  const char *name = strrchr(path, '/') + 1;
  char folder[LONGEST], link[LONGEST], new[LONGEST];

  PetscFunctionBeginUser;
  snprintf(folder, sizeof folder, "%.*s", (int)(name - 1 - path), path);
  snprintf(link, sizeof link, "%.*s", (int)(strrchr(path, '.') - path), path);
  PetscCheck(snprintf(new, sizeof new, "%s.new", link) < LONGEST, PETSC_COMM_SELF, PETSC_ERR_ARG_SIZ, "%s",
             link);
  PetscCall(FolderSyncAll(path));
  unlink(new);
  PetscCheck(!symlink(name, new) && !rename(new, link), PETSC_COMM_SELF, PETSC_ERR_FILE_WRITE, "%s: %s", link,
             strerror(errno));
  PetscCall(FolderSync(folder));
  RemoveOthers(folder, name);
  PetscFunctionReturn(0);
}
