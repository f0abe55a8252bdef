#include "common/output/checkpoint.h"
#include "common/output/folder.h"
#include "common/output/hdf5_file.h"
#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <string.h>

struct Checkpoint_s {
  MPI_Comm comm; /* duplicated: HDF5's messages do not meet others */
  hid_t file;
  PetscBool writes;
  char folder[PETSC_MAX_PATH_LEN - 64], path[PETSC_MAX_PATH_LEN];
};

static PetscErrorCode Create(MPI_Comm comm, const char *folder, const char *name, Checkpoint *checkpoint)
{
  Checkpoint c;
  PetscFunctionBeginUser;
  PetscCall(PetscNew(&c));
  PetscCallMPI(MPI_Comm_dup(comm, &c->comm));
  PetscCheck(strlen(folder) < sizeof c->folder && strlen(name) < 60, comm, PETSC_ERR_ARG_SIZ,
             "checkpoint in %s", folder);
  strcpy(c->folder, folder);
  snprintf(c->path, sizeof c->path, "%s/%s.h5", folder, name);
  *checkpoint = c;
  PetscFunctionReturn(0);
}

/* --- the identity: which run, step and time --------------------------------------------------------------- */

enum { IDENTITY = 128 };
static const char NAME[] = "identity";

/* The first line of <folder>/identity, "" where there is none; the same on all ranks. */
static PetscErrorCode ReadIdentity(Checkpoint c, char identity[IDENTITY])
{
  char path[PETSC_MAX_PATH_LEN];
  PetscMPIInt rank;
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(c->comm, &rank));
  memset(identity, 0, IDENTITY);
  snprintf(path, sizeof path, "%s/%s", c->folder, NAME);
  FILE *file = rank ? NULL : fopen(path, "r");
  if (file) {
    if (!fgets(identity, IDENTITY, file)) identity[0] = 0;
    identity[strcspn(identity, "\n")] = 0;
    fclose(file);
  }
  PetscCallMPI(MPI_Bcast(identity, IDENTITY, MPI_CHAR, 0, c->comm));
  PetscFunctionReturn(0);
}

static PetscErrorCode CheckIdentity(Checkpoint c)
{
  char expected[IDENTITY], found[IDENTITY] = "";
  PetscFunctionBeginUser;
  PetscCall(ReadIdentity(c, expected));
  if (Hdf5HasAttribute(c->file, "/", NAME)) PetscCall(Hdf5ReadText(c->file, "/", NAME, sizeof found, found));
  PetscCheck(!strcmp(expected, found), PETSC_COMM_SELF, PETSC_ERR_FILE_UNEXPECTED,
             "cannot resume: %s is not of this checkpoint: expected %s, found %s", c->path,
             expected[0] ? expected : "no identity", found[0] ? found : "none");
  PetscFunctionReturn(0);
}

PetscErrorCode CheckpointIdentify(const char *folder, const char *identity)
{
  char path[PETSC_MAX_PATH_LEN];
  PetscFunctionBeginUser;
  PetscCheck(strlen(identity) < IDENTITY, PETSC_COMM_SELF, PETSC_ERR_ARG_SIZ, "identity '%s'", identity);
  snprintf(path, sizeof path, "%s/%s", folder, NAME);
  FILE *file = fopen(path, "w");
  const int wrong = !file || fprintf(file, "%s\n", identity) < 0;
  PetscCheck((!file || !fclose(file)) && !wrong, PETSC_COMM_SELF, PETSC_ERR_FILE_WRITE, "%s: %s", path,
             strerror(errno));
  PetscFunctionReturn(0);
}

/* --- opening and closing -------------------------------------------------------------------------------- */

PetscErrorCode CheckpointCreate(MPI_Comm comm, const char *folder, const char *name, Checkpoint *c)
{
  char identity[IDENTITY];
  PetscFunctionBeginUser;
  PetscCall(Create(comm, folder, name, c));
  (*c)->writes = PETSC_TRUE;
  PetscCall(Hdf5Create((*c)->comm, (*c)->path, HDF5_CHECKPOINT, &(*c)->file));
  PetscCall(ReadIdentity(*c, identity));
  if (identity[0]) PetscCall(Hdf5Text((*c)->file, "/", NAME, identity));
  PetscFunctionReturn(0);
}

PetscErrorCode CheckpointOpen(MPI_Comm comm, const char *folder, const char *name, Checkpoint *c)
{
  PetscFunctionBeginUser;
  PetscCall(Create(comm, folder, name, c));
  PetscCall(Hdf5Open((*c)->comm, (*c)->path, PETSC_FALSE, &(*c)->file));
  PetscCall(CheckIdentity(*c));
  PetscFunctionReturn(0);
}

PetscErrorCode CheckpointClose(Checkpoint *c)
{
  PetscFunctionBeginUser;
  if (!*c) PetscFunctionReturn(0);
  PetscCall(Hdf5Close(&(*c)->file));
  if ((*c)->writes) PetscCall(FolderSync((*c)->path));
  PetscCallMPI(MPI_Comm_free(&(*c)->comm));
  PetscCall(PetscFree(*c));
  PetscFunctionReturn(0);
}

const char *CheckpointFolder(Checkpoint c)
{
  return c->folder;
}

PetscBool CheckpointHasNumber(Checkpoint c, const char *name)
{
  return Hdf5HasAttribute(c->file, "/", name);
}

PetscErrorCode CheckpointPutNumber(Checkpoint c, const char *name, double value)
{
  return Hdf5Attribute(c->file, "/", name, value);
}

PetscErrorCode CheckpointGetNumber(Checkpoint c, const char *name, double *value)
{
  PetscFunctionBeginUser;
  PetscCheck(CheckpointHasNumber(c, name), PETSC_COMM_SELF, PETSC_ERR_FILE_UNEXPECTED,
             "%s has no number '%s': another version of the program made it", c->path, name);
  PetscCall(Hdf5ReadAttribute(c->file, "/", name, value));
  PetscFunctionReturn(0);
}

PetscErrorCode CheckpointPutDoubles(Checkpoint c, const char *name, int n, int ncol, const double value[])
{
  Hdf5Rows rows;
  PetscFunctionBeginUser;
  PetscCall(Hdf5Place(c->comm, n, ncol, &rows));
  rows.store = HDF5_CHECKED;
  PetscCall(Hdf5WriteDoubles(c->file, name, &rows, value));
  PetscFunctionReturn(0);
}

PetscErrorCode CheckpointPutIndices(Checkpoint c, const char *name, int n, int ncol, const long long value[])
{
  Hdf5Rows rows;
  PetscFunctionBeginUser;
  PetscCall(Hdf5Place(c->comm, n, ncol, &rows));
  rows.store = HDF5_CHECKED;
  PetscCall(Hdf5WriteIndices(c->file, name, &rows, LLONG_MAX, value));
  PetscFunctionReturn(0);
}

/* Total rows of a table with ncol columns; ncol 0: of any. */
static PetscErrorCode Find(Checkpoint c, const char *name, int ncol, long long *total)
{
  int found;
  PetscFunctionBeginUser;
  PetscCheck(Hdf5Has(c->file, name), PETSC_COMM_SELF, PETSC_ERR_FILE_UNEXPECTED,
             "%s has no table '%s': another version of the program made it", c->path, name);
  PetscCall(Hdf5Shape(c->file, name, total, &found));
  PetscCheck(!ncol || found == ncol, PETSC_COMM_SELF, PETSC_ERR_FILE_UNEXPECTED,
             "%s: table '%s' has %d columns instead of %d", c->path, name, found, ncol);
  PetscFunctionReturn(0);
}

PetscErrorCode CheckpointRows(Checkpoint c, const char *name, long long *total)
{
  return Find(c, name, 0, total);
}

/* Checks that the rows are there. */
static PetscErrorCode Choose(Checkpoint c, const char *name, long long start, int n, int ncol, Hdf5Rows *rows)
{
  PetscFunctionBeginUser;
  *rows = (Hdf5Rows){.start = start, .n = n, .ncol = ncol};
  PetscCall(Find(c, name, ncol, &rows->total));
  PetscCheck(start >= 0 && start + n <= rows->total, PETSC_COMM_SELF, PETSC_ERR_FILE_UNEXPECTED,
             "%s: table '%s' has %lld rows, %lld to %lld are wanted", c->path, name, rows->total, start,
             start + n);
  PetscFunctionReturn(0);
}

PetscErrorCode CheckpointGetDoubles(Checkpoint c, const char *name, long long start, int n, int ncol,
                                    double value[])
{
  Hdf5Rows rows;
  PetscFunctionBeginUser;
  PetscCall(Choose(c, name, start, n, ncol, &rows));
  PetscCall(Hdf5ReadDoubles(c->file, name, &rows, value));
  PetscFunctionReturn(0);
}

PetscErrorCode CheckpointGetIndices(Checkpoint c, const char *name, long long start, int n, int ncol,
                                    long long value[])
{
  Hdf5Rows rows;
  PetscFunctionBeginUser;
  PetscCall(Choose(c, name, start, n, ncol, &rows));
  PetscCall(Hdf5ReadIndices(c->file, name, &rows, value));
  PetscFunctionReturn(0);
}
