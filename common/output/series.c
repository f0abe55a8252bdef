#include "common/output/folder.h"
#include "common/output/output.h"
#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

struct Series_s {
  MPI_Comm comm; /* borrowed */
  FILE *file;    /* rank 0 only */
  long length;   /* of what is kept of a file that goes on, until the first row: then 0 */
  int ncolumn;
  char path[PETSC_MAX_PATH_LEN];
  char key[128]; /* of its length in a checkpoint */
};

PetscBool SeriesCanName(const char *name)
{
  return (PetscBool)(name[0] && strlen(name) <= SERIES_NAME_MAX && !strpbrk(name, ",\"\n"));
}

static PetscErrorCode Begin(Series s, const char *columns)
{
  PetscFunctionBeginUser;
  s->file = fopen(s->path, "w");
  PetscCheck(s->file, PETSC_COMM_SELF, PETSC_ERR_FILE_OPEN, "%s: %s", s->path, strerror(errno));
  fprintf(s->file, "%s\n", columns);
  PetscCheck(!fflush(s->file), PETSC_COMM_SELF, PETSC_ERR_FILE_WRITE, "%s: %s", s->path, strerror(errno));
  PetscFunctionReturn(0);
}

/* Whether the file begins with this header. */
static PetscBool HasColumns(FILE *file, const char *columns)
{
  rewind(file);
  for (const char *c = columns; *c; c++)
    if (fgetc(file) != *c) return PETSC_FALSE;
  return (PetscBool)(fgetc(file) == '\n');
}

/* The first row will follow the first `length` bytes of what is there. */
static PetscErrorCode Continue(Series s, const char *columns, long length)
{
  PetscFunctionBeginUser;
  s->file = fopen(s->path, "r+");
  PetscCheck(s->file && !fseek(s->file, 0, SEEK_END), PETSC_COMM_SELF, PETSC_ERR_FILE_OPEN, "%s: %s", s->path,
             strerror(errno));
  PetscCheck(ftell(s->file) >= length, PETSC_COMM_SELF, PETSC_ERR_FILE_UNEXPECTED,
             "%s is shorter than when it was checkpointed", s->path);
  PetscCheck(
      HasColumns(s->file, columns), PETSC_COMM_SELF, PETSC_ERR_FILE_UNEXPECTED,
      "%s has other columns than this case: resume with the same probes, or into another output.folder",
      s->path);
  s->length = length;
  PetscFunctionReturn(0);
}

PetscErrorCode SeriesCreate(MPI_Comm comm, const char *folder, const char *name, const char *columns,
                            Checkpoint from, Series *series)
{
  Series s;
  PetscMPIInt rank;
  double length = 0.0;
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  PetscCall(FolderMake(comm, folder));
  PetscCall(PetscNew(&s));
  s->comm = comm;
  snprintf(s->path, sizeof s->path, "%s/%s.csv", folder, name);
  snprintf(s->key, sizeof s->key, "length of %s.csv", name);
  s->ncolumn = 1;
  for (const char *c = columns; *c; c++) s->ncolumn += *c == ',';
  *series = s;
  if (FolderGoesOn(comm, folder, s->path, from)) PetscCall(CheckpointGetNumber(from, s->key, &length));
  PetscCall(AgreeWithRoot(comm, rank != 0      ? 0
                                : length > 0.0 ? Continue(s, columns, (long)length)
                                               : Begin(s, columns)));
  PetscFunctionReturn(0);
}

PetscErrorCode SeriesSave(Series s, Checkpoint to)
{
  double length = !s->file ? 0.0 : s->length ? (double)s->length : (double)ftell(s->file);
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Bcast(&length, 1, MPI_DOUBLE, 0, s->comm));
  PetscCall(CheckpointPutNumber(to, s->key, length));
  PetscFunctionReturn(0);
}

/* Each row is flushed, so that a run can be followed and a crash loses nothing. */
PetscErrorCode SeriesRow(Series s, const double value[])
{
  PetscFunctionBeginUser;
  if (!s->file) PetscFunctionReturn(0);
  if (s->length) {
    PetscCheck(!ftruncate(fileno(s->file), s->length) && !fseek(s->file, s->length, SEEK_SET),
               PETSC_COMM_SELF, PETSC_ERR_FILE_WRITE, "%s: %s", s->path, strerror(errno));
    s->length = 0;
  }
  for (int k = 0; k < s->ncolumn; k++) fprintf(s->file, k ? ",%.15g" : "%.15g", value[k]);
  fputc('\n', s->file);
  PetscCheck(!fflush(s->file) && !ferror(s->file), PETSC_COMM_SELF, PETSC_ERR_FILE_WRITE, "%s: %s", s->path,
             strerror(errno));
  PetscFunctionReturn(0);
}

PetscErrorCode SeriesDestroy(Series *s)
{
  PetscFunctionBeginUser;
  if (!*s) PetscFunctionReturn(0);
  if ((*s)->file)
    PetscCheck(!fclose((*s)->file), PETSC_COMM_SELF, PETSC_ERR_FILE_WRITE, "%s: %s", (*s)->path,
               strerror(errno));
  PetscCall(PetscFree(*s));
  PetscFunctionReturn(0);
}
