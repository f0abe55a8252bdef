#include "common/program/case_copy.h"
#include "common/link/coracle.h"
#include <errno.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

PetscErrorCode CaseCopyTake(int argc, char **argv, CaseCopy *copy)
{
  PetscMPIInt rank;
  PetscFunctionBeginUser;
  copy->n = 0;
  copy->text = NULL;
  PetscCallMPI(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  if (rank || argc < 2) PetscFunctionReturn(0);
  FILE *file = fopen(argv[1], "rb");
  PetscCheck(file && !fseek(file, 0, SEEK_END), PETSC_COMM_SELF, PETSC_ERR_FILE_OPEN, "%s: %s", argv[1],
             strerror(errno));
  const long size = ftell(file);
  rewind(file);
  PetscCall(PetscMalloc1((size_t)size + 1, &copy->text));
  copy->n = fread(copy->text, 1, (size_t)size, file);
  PetscCheck(!ferror(file) && !fclose(file), PETSC_COMM_SELF, PETSC_ERR_FILE_READ, "%s: %s", argv[1],
             strerror(errno));
  PetscFunctionReturn(0);
}

/* What the file alone does not say.  Settings are quoted for a shell, a line each. */
static void WriteHead(FILE *file, const char *ranks, int argc, char **argv)
{
  char now[64], path[PATH_MAX];
  const time_t t = time(NULL);
  strftime(now, sizeof now, "%Y-%m-%d %H:%M:%S", localtime(&t));
  fprintf(file, "# coracle %s, revision %s, %s, %s\n", CORACLE_VERSION, CORACLE_REVISION, now, ranks);
  fprintf(file, "# a copy of %s, with\n", realpath(argv[1], path) ? path : argv[1]);
  for (int k = 2; k + 1 < argc; k += 2) fprintf(file, "#   %s '%s'\n", argv[k], argv[k + 1]);
}

PetscErrorCode CaseCopyWrite(const char *folder, const char *ranks, int argc, char **argv, CaseCopy *copy)
{
  char path[PATH_MAX];
  PetscFunctionBeginUser;
  if (!copy->text) PetscFunctionReturn(0);
  snprintf(path, sizeof path, "%s/case.yaml", folder);
  FILE *file = fopen(path, "wb");
  PetscCheck(file, PETSC_COMM_SELF, PETSC_ERR_FILE_OPEN, "%s: %s", path, strerror(errno));
  WriteHead(file, ranks, argc, argv);
  fwrite(copy->text, 1, copy->n, file);
  const int bad = ferror(file);
  PetscCheck(!fclose(file) && !bad, PETSC_COMM_SELF, PETSC_ERR_FILE_WRITE, "%s: %s", path, strerror(errno));
  PetscCall(PetscFree(copy->text));
  PetscFunctionReturn(0);
}
