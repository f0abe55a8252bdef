#include "coupler/checkpoints.h"
#include "common/link/participant.h"
#include "common/output/folder.h"
#include <dirent.h>
#include <errno.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

static PetscErrorCode IsRoot(const Checkpoints *k, PetscBool *root)
{
  PetscMPIInt rank;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(k->comm, &rank));
  *root = rank ? PETSC_FALSE : PETSC_TRUE;
  PetscFunctionReturn(0);
}

/* Removes the folder of a checkpoint and the files in it. */
static void Remove(const char *folder)
{
  char path[PETSC_MAX_PATH_LEN];
  DIR *list = opendir(folder);
  if (!list) return;
  for (const struct dirent *entry; (entry = readdir(list));) {
    snprintf(path, sizeof path, "%s/%s", folder, entry->d_name);
    if (strcmp(entry->d_name, ".") && strcmp(entry->d_name, "..")) unlink(path);
  }
  closedir(list);
  rmdir(folder);
}

/* Removes all checkpoints but `current`: the previous one, and incomplete ones of runs that were killed. */
static void RemoveOthers(const Checkpoints *k, const char *current)
{
  char path[PETSC_MAX_PATH_LEN];
  DIR *list = opendir(k->folder);
  if (!list) return;
  for (const struct dirent *entry; (entry = readdir(list));) {
    const size_t n = strlen(CORACLE_CHECKPOINT ".");
    if (strncmp(entry->d_name, CORACLE_CHECKPOINT ".", n) || !strcmp(entry->d_name, current)) continue;
    if (strspn(entry->d_name + n, "0123456789") != strlen(entry->d_name + n)) continue;
    snprintf(path, sizeof path, "%s/%s", k->folder, entry->d_name);
    Remove(path);
  }
  closedir(list);
}

PetscErrorCode CheckpointsCreate(MPI_Comm comm, Server server, const CouplerCase *c, Checkpoints *k)
{
  PetscFunctionBeginUser;
  *k = (Checkpoints){
      .comm = comm, .server = server, .folder = c->folder, .every = c->checkpoint, .last = MPI_Wtime()};
  snprintf(k->run, sizeof k->run, "%llx-%d", (unsigned long long)time(NULL), (int)getpid());
  PetscFunctionReturn(0);
}

/* Replaces the symbolic link by one to the new checkpoint, atomically. */
static PetscErrorCode Publish(const Checkpoints *k)
{
  const char *name = strrchr(k->due, '/') + 1;
  char link[sizeof k->due], new[sizeof k->due];

  PetscFunctionBeginUser;
  snprintf(link, sizeof link, "%s/" CORACLE_CHECKPOINT, k->folder);
  snprintf(new, sizeof new, "%s/" CORACLE_CHECKPOINT ".new", k->folder);
  PetscCall(FolderSyncAll(k->due));
  unlink(new);
  PetscCheck(!symlink(name, new) && !rename(new, link), PETSC_COMM_SELF, PETSC_ERR_FILE_WRITE, "%s: %s", link,
             strerror(errno));
  PetscCall(FolderSync(k->folder));
  RemoveOthers(k, name);
  PetscFunctionReturn(0);
}

/* Makes the folder `due` with the identity of the checkpoint. */
static PetscErrorCode Make(const Checkpoints *k, long long steps, double t)
{
  char identity[128];

  PetscFunctionBeginUser;
  Remove(k->due);
  PetscCheck(!mkdir(k->due, 0777), PETSC_COMM_SELF, PETSC_ERR_FILE_WRITE, "%s: %s", k->due, strerror(errno));
  snprintf(identity, sizeof identity, "run %s, step %lld, t = %.17g s", k->run, steps, t);
  PetscCall(CheckpointIdentify(k->due, identity));
  PetscFunctionReturn(0);
}

PetscErrorCode CheckpointsRequest(Checkpoints *k, long long steps, double t, PetscBool end)
{
  PetscBool root;
  int due;

  PetscFunctionBeginUser;
  if (k->every <= 0.0 || k->impossible) PetscFunctionReturn(0);
  PetscCall(IsRoot(k, &root));
  due = end || MPI_Wtime() - k->last >= k->every;
  PetscCallMPI(MPI_Bcast(&due, 1, MPI_INT, 0, k->comm));
  if (!due) PetscFunctionReturn(0);
  snprintf(k->due, sizeof k->due, "%s/" CORACLE_CHECKPOINT ".%lld", k->folder, steps);
  if (root) PetscCall(Make(k, steps, t));
  PetscCallMPI(MPI_Barrier(k->comm)); /* the folder exists before a client is told to save there */
  PetscCall(ServerSave(k->server, k->due));
  PetscFunctionReturn(0);
}

PetscErrorCode CheckpointsFinish(Checkpoints *k)
{
  PetscBool root;

  PetscFunctionBeginUser;
  if (!k->due[0]) PetscFunctionReturn(0);
  PetscCall(IsRoot(k, &root));
  const char *unsaved = ServerUnsaved(k->server);
  if (unsaved && root) {
    fprintf(stderr, "coracle: note: no checkpoints: the %s saves none\n", unsaved);
    Remove(k->due);
  }
  if (!unsaved && root) PetscCall(Publish(k));
  k->impossible = unsaved ? PETSC_TRUE : PETSC_FALSE;
  k->due[0] = 0;
  k->last = MPI_Wtime();
  PetscFunctionReturn(0);
}
