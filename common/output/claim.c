#include "common/output/claim.h"
#include "common/output/folder.h"
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

struct Claim_s {
  int lock; /* rank 0's open file, -1 elsewhere */
  char path[PETSC_MAX_PATH_LEN];
};

/* --- the lock ------------------------------------------------------------------------------------------- */

static void Holder(int lock, char who[256])
{
  const ssize_t n = pread(lock, who, 255, 0);
  who[n > 0 ? n : 0] = 0;
  who[strcspn(who, "\n")] = 0;
}

/* Opens and locks the file; again when the run that held it has just taken it away. */
static PetscErrorCode Lock(const char *path, int *lock)
{
  struct stat mine, there;
  char who[256];
  PetscFunctionBeginUser;
  for (;;) {
    *lock = open(path, O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    PetscCheck(*lock >= 0, PETSC_COMM_SELF, PETSC_ERR_FILE_OPEN, "%s: %s", path, strerror(errno));
    if (flock(*lock, LOCK_EX | LOCK_NB) && errno == EWOULDBLOCK) {
      Holder(*lock, who);
      close(*lock);
      SETERRQ(PETSC_COMM_SELF, PETSC_ERR_FILE_WRITE,
              "key 'output.folder': another run is writing there (%s, says %s): give this one a folder of "
              "its own",
              who, path);
    } /* file systems without locks go without */
    if (!fstat(*lock, &mine) && !stat(path, &there) && mine.st_ino == there.st_ino) break;
    close(*lock);
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode Sign(const char *path, int lock)
{
  char who[256], host[64] = "?", when[32] = "?";
  const time_t now = time(NULL);
  struct tm local;
  PetscFunctionBeginUser;
  gethostname(host, sizeof host - 1);
  if (localtime_r(&now, &local)) strftime(when, sizeof when, "%Y-%m-%d %H:%M:%S", &local);
  const int n = snprintf(who, sizeof who, "process %d on %s since %s\n", (int)getpid(), host, when);
  PetscCheck(!ftruncate(lock, 0) && pwrite(lock, who, (size_t)n, 0) == n, PETSC_COMM_SELF,
             PETSC_ERR_FILE_WRITE, "%s: %s", path, strerror(errno));
  PetscFunctionReturn(0);
}

/* --- earlier results ------------------------------------------------------------------------------------ */

static PetscBool EndsWith(const char *name, const char *ending)
{
  const size_t n = strlen(name), m = strlen(ending);
  return (PetscBool)(n >= m && !strcmp(name + n - m, ending));
}

/* <participant>.<kind>, <participant>_<name>.csv and <participant>.<grid>.xdmf; <participant>.h5-<number>.lock, which Open MPI leaves of a run that
 * is killed. */
static PetscBool IsOf(const char *name, const char *participant)
{
  static const char *const KINDS[] = {".h5", ".xdmf", ".xdmf.part", ".csv"};
  const size_t led = strlen(participant);
  if (strncmp(name, participant, led)) return PETSC_FALSE;
  for (int k = 0; k < 4; k++)
    if (!strcmp(name + led, KINDS[k])) return PETSC_TRUE;
  if (!strncmp(name + led, ".h5-", 4) && EndsWith(name + led, ".lock")) return PETSC_TRUE;
  return (PetscBool)((name[led] == '_' && EndsWith(name + led, ".csv")) ||
                     (name[led] == '.' && EndsWith(name + led, ".xdmf")));
}

/* What runs leave: files of each participant, summary.json, trace.json, case.yaml, checkpoints. */
static PetscBool IsResult(const char *name)
{
  static const char CHECKPOINT[] = "checkpoint";
  if (!strcmp(name, "summary.json") || !strcmp(name, "trace.json") || !strcmp(name, "case.yaml"))
    return PETSC_TRUE;
  if (!strncmp(name, CHECKPOINT, sizeof CHECKPOINT - 1) &&
      (!name[sizeof CHECKPOINT - 1] || name[sizeof CHECKPOINT - 1] == '.'))
    return PETSC_TRUE;
  return IsOf(name, "fluid") || IsOf(name, "coupler") || IsOf(name, "solid") ? PETSC_TRUE : PETSC_FALSE;
}

/* The first <folder>/earlier.N that does not exist. */
static PetscErrorCode MakeEarlier(const char *folder, char earlier[PETSC_MAX_PATH_LEN])
{
  PetscFunctionBeginUser;
  for (int k = 1;; k++) {
    PetscCheck(snprintf(earlier, PETSC_MAX_PATH_LEN, "%s/earlier.%d", folder, k) < PETSC_MAX_PATH_LEN,
               PETSC_COMM_SELF, PETSC_ERR_ARG_SIZ, "output folder %s: its name is too long", folder);
    if (!mkdir(earlier, 0777)) break;
    PetscCheck(errno == EEXIST, PETSC_COMM_SELF, PETSC_ERR_FILE_WRITE, "%s: %s", earlier, strerror(errno));
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode Move(const char *folder, const char *name, const char *earlier)
{
  char from[PETSC_MAX_PATH_LEN + 256], to[PETSC_MAX_PATH_LEN + 256];
  PetscFunctionBeginUser;
  snprintf(from, sizeof from, "%s/%s", folder, name);
  snprintf(to, sizeof to, "%s/%s", earlier, name);
  PetscCheck(!rename(from, to), PETSC_COMM_SELF, PETSC_ERR_FILE_WRITE, "%s: %s", to, strerror(errno));
  PetscFunctionReturn(0);
}

static PetscErrorCode MoveAside(const char *folder)
{
  char earlier[PETSC_MAX_PATH_LEN] = "";
  PetscFunctionBeginUser;
  DIR *list = opendir(folder);
  PetscCheck(list, PETSC_COMM_SELF, PETSC_ERR_FILE_OPEN, "%s: %s", folder, strerror(errno));
  for (const struct dirent *entry; (entry = readdir(list));) {
    if (!IsResult(entry->d_name)) continue;
    if (!earlier[0]) PetscCall(MakeEarlier(folder, earlier));
    PetscCall(Move(folder, entry->d_name, earlier));
  }
  closedir(list);
  if (earlier[0]) printf("coracle: note: results of an earlier run are now in %s\n", earlier);
  PetscFunctionReturn(0);
}

/* --- claiming ------------------------------------------------------------------------------------------- */

static PetscErrorCode Take(Claim c, const char *folder, PetscBool resumes)
{
  PetscFunctionBeginUser;
  PetscCall(Lock(c->path, &c->lock));
  PetscCall(Sign(c->path, c->lock));
  if (!resumes) PetscCall(MoveAside(folder));
  PetscFunctionReturn(0);
}

PetscErrorCode ClaimFolder(MPI_Comm comm, const char *folder, PetscBool resumes, Claim *claim)
{
  PetscMPIInt rank;
  Claim c;
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  PetscCall(PetscNew(&c));
  c->lock = -1;
  snprintf(c->path, sizeof c->path, "%s/running", folder);
  PetscCall(FolderMake(comm, folder));
  PetscCall(AgreeWithRoot(comm, rank == 0 ? Take(c, folder, resumes) : 0));
  *claim = c;
  PetscFunctionReturn(0);
}

PetscErrorCode ClaimRelease(Claim *claim)
{
  PetscFunctionBeginUser;
  if (!*claim) PetscFunctionReturn(0);
  if ((*claim)->lock >= 0) {
    unlink((*claim)->path);
    close((*claim)->lock);
  }
  PetscCall(PetscFree(*claim));
  PetscFunctionReturn(0);
}
