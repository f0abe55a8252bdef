#include "common/output/checkpoint.h"
#include "common/output/hdf5_file.h"
#include <limits.h>
#include <string.h>

struct Checkpoint_s {
  MPI_Comm comm; /* duplicated: HDF5's messages do not meet others */
  hid_t file;
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

PetscErrorCode CheckpointCreate(MPI_Comm comm, const char *folder, const char *name, Checkpoint *c)
{
  PetscFunctionBeginUser;
  PetscCall(Create(comm, folder, name, c));
  PetscCall(Hdf5Create((*c)->comm, (*c)->path, &(*c)->file));
  PetscFunctionReturn(0);
}

PetscErrorCode CheckpointOpen(MPI_Comm comm, const char *folder, const char *name, Checkpoint *c)
{
  PetscFunctionBeginUser;
  PetscCall(Create(comm, folder, name, c));
  PetscCall(Hdf5Open((*c)->comm, (*c)->path, PETSC_FALSE, &(*c)->file));
  PetscFunctionReturn(0);
}

PetscErrorCode CheckpointClose(Checkpoint *c)
{
  PetscFunctionBeginUser;
  if (!*c) PetscFunctionReturn(0);
  PetscCall(Hdf5Close(&(*c)->file));
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
             "%s has no number '%s'", c->path, name);
  PetscCall(Hdf5ReadAttribute(c->file, "/", name, value));
  PetscFunctionReturn(0);
}

PetscErrorCode CheckpointPutDoubles(Checkpoint c, const char *name, int n, int ncol, const double value[])
{
  Hdf5Rows rows;
  PetscFunctionBeginUser;
  PetscCall(Hdf5Place(c->comm, n, ncol, &rows));
  PetscCall(Hdf5WriteDoubles(c->file, name, &rows, value));
  PetscFunctionReturn(0);
}

PetscErrorCode CheckpointPutIndices(Checkpoint c, const char *name, int n, int ncol, const long long value[])
{
  Hdf5Rows rows;
  PetscFunctionBeginUser;
  PetscCall(Hdf5Place(c->comm, n, ncol, &rows));
  PetscCall(Hdf5WriteIndices(c->file, name, &rows, LLONG_MAX, value));
  PetscFunctionReturn(0);
}

/* Total rows of a table with ncol columns; ncol 0: of any. */
static PetscErrorCode Find(Checkpoint c, const char *name, int ncol, long long *total)
{
  int found;
  PetscFunctionBeginUser;
  PetscCheck(Hdf5Has(c->file, name), PETSC_COMM_SELF, PETSC_ERR_FILE_UNEXPECTED, "%s has no table '%s'",
             c->path, name);
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
