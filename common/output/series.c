#include "common/output/folder.h"
#include "common/output/output.h"
#include "common/output/time_reached.h"
#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

struct Series_s {
  MPI_Comm comm;            /* borrowed */
  FILE *file;               /* rank 0 only */
  long length;              /* of what is kept of a file that goes on, until the first row: then 0 */
  double every, last, next; /* s: from row to row, 0: at each step; time of the last row; when one is due */
  int ncolumn;
  double *passed; /* [ncolumn] the last row, if it was not due */
  PetscBool passes;
  char path[PETSC_MAX_PATH_LEN];
  char length_key[128], last_key[128]; /* in a checkpoint */
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

/* As it was at the checkpoint; `every` may be another one now. */
static PetscErrorCode Load(Series s, Checkpoint from, double *length)
{
  PetscFunctionBeginUser;
  PetscCall(CheckpointGetNumber(from, s->length_key, length));
  PetscCall(CheckpointGetNumber(from, s->last_key, &s->last));
  s->next = TimeNext(s->last, s->every);
  PetscFunctionReturn(0);
}

PetscErrorCode SeriesCreate(MPI_Comm comm, const char *folder, const char *name, const char *columns,
                            double every, Checkpoint from, Series *series)
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
  snprintf(s->length_key, sizeof s->length_key, "length of %s.csv", name);
  snprintf(s->last_key, sizeof s->last_key, "last of %s.csv", name);
  s->every = every;
  s->ncolumn = 1;
  for (const char *c = columns; *c; c++) s->ncolumn += *c == ',';
  PetscCall(PetscMalloc1(s->ncolumn, &s->passed));
  *series = s;
  if (FolderGoesOn(comm, folder, s->path, from)) PetscCall(Load(s, from, &length));
  PetscCall(AgreeWithRoot(comm, rank != 0      ? 0
                                : length > 0.0 ? Continue(s, columns, (long)length)
                                               : Begin(s, columns)));
  PetscFunctionReturn(0);
}

PetscErrorCode SeriesSave(Series s, Checkpoint to)
{
  double kept[2] = {!s->file ? 0.0 : s->length ? (double)s->length : (double)ftell(s->file), s->last};
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Bcast(kept, 2, MPI_DOUBLE, 0, s->comm));
  PetscCall(CheckpointPutNumber(to, s->length_key, kept[0]));
  PetscCall(CheckpointPutNumber(to, s->last_key, kept[1]));
  PetscFunctionReturn(0);
}

/* Each row in the file is flushed, so that a run can be followed and a crash loses no row that was due. */
static PetscErrorCode Append(Series s, const double value[])
{
  PetscFunctionBeginUser;
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

PetscErrorCode SeriesRow(Series s, const double value[])
{
  PetscFunctionBeginUser;
  if (!s->file) PetscFunctionReturn(0);
  s->passes = (PetscBool)!TimeReached(value[0], s->next);
  if (s->passes) {
    PetscCall(PetscArraycpy(s->passed, value, s->ncolumn));
    PetscFunctionReturn(0);
  }
  PetscCall(Append(s, value));
  s->last = value[0];
  s->next = TimeNext(s->last, s->every);
  PetscFunctionReturn(0);
}

PetscErrorCode SeriesDestroy(Series *s)
{
  PetscFunctionBeginUser;
  if (!*s) PetscFunctionReturn(0);
  if ((*s)->passes) PetscCall(Append(*s, (*s)->passed));
  if ((*s)->file)
    PetscCheck(!fclose((*s)->file), PETSC_COMM_SELF, PETSC_ERR_FILE_WRITE, "%s: %s", (*s)->path,
               strerror(errno));
  PetscCall(PetscFree((*s)->passed));
  PetscCall(PetscFree(*s));
  PetscFunctionReturn(0);
}
