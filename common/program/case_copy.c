#include "common/program/case_copy.h"
#include "common/link/coracle.h"
#include <errno.h>
#include <limits.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

PetscErrorCode CaseCopyTake(const char *path, CaseCopy *copy)
{
  PetscMPIInt rank;
  PetscFunctionBeginUser;
  copy->path = path;
  copy->n = 0;
  copy->text = NULL;
  PetscCallMPI(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  if (rank || !path) PetscFunctionReturn(0);
  FILE *file = fopen(path, "rb");
  PetscCheck(file && !fseek(file, 0, SEEK_END), PETSC_COMM_SELF, PETSC_ERR_FILE_OPEN, "%s: %s", path,
             strerror(errno));
  const long size = ftell(file);
  rewind(file);
  PetscCall(PetscMalloc1((size_t)size + 1, &copy->text));
  copy->n = fread(copy->text, 1, (size_t)size, file);
  PetscCheck(!ferror(file) && !fclose(file), PETSC_COMM_SELF, PETSC_ERR_FILE_READ, "%s: %s", path,
             strerror(errno));
  PetscFunctionReturn(0);
}

/* In the quotes of a shell, on one line: a line's end and its like need those of $'...'. */
static void WriteQuoted(FILE *file, const char *s)
{
  bool plain = true;
  for (const char *c = s; *c; c++) plain = plain && (unsigned char)*c >= 0x20;
  fprintf(file, plain ? "'" : "$'");
  for (; *s; s++) {
    if ((unsigned char)*s < 0x20)
      fprintf(file, "\\%03o", (unsigned)*s);
    else if (*s == '\'')
      fprintf(file, plain ? "'\\''" : "\\'");
    else
      fprintf(file, *s == '\\' && !plain ? "\\\\" : "%c", *s);
  }
  fprintf(file, "'");
}

/* What the file alone does not say: settings, a line each. */
static void WriteHead(FILE *file, const char *path, const char *ranks, int argc, char **argv)
{
  char now[64], whole[PATH_MAX];
  const time_t t = time(NULL);
  strftime(now, sizeof now, "%Y-%m-%d %H:%M:%S", localtime(&t));
  fprintf(file, "# coracle %s, revision %s, %s, %s\n", CORACLE_VERSION, CORACLE_REVISION, now, ranks);
  fprintf(file, "# a copy of %s, with\n", realpath(path, whole) ? whole : path);
  for (int k = 1; k + 1 < argc; k++) {
    if (strcmp(argv[k], "--set")) continue;
    fprintf(file, "#   --set ");
    WriteQuoted(file, argv[++k]);
    fprintf(file, "\n");
  }
}

PetscErrorCode CaseCopyWrite(const char *folder, const char *ranks, int argc, char **argv, CaseCopy *copy)
{
  char path[PATH_MAX];
  PetscFunctionBeginUser;
  if (!copy->text) PetscFunctionReturn(0);
  snprintf(path, sizeof path, "%s/case.yaml", folder);
  FILE *file = fopen(path, "wb");
  PetscCheck(file, PETSC_COMM_SELF, PETSC_ERR_FILE_OPEN, "%s: %s", path, strerror(errno));
  WriteHead(file, copy->path, ranks, argc, argv);
  fwrite(copy->text, 1, copy->n, file);
  const int bad = ferror(file);
  PetscCheck(!fclose(file) && !bad, PETSC_COMM_SELF, PETSC_ERR_FILE_WRITE, "%s: %s", path, strerror(errno));
  PetscCall(PetscFree(copy->text));
  PetscFunctionReturn(0);
}
