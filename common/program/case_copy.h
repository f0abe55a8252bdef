/* A copy of the case in the output folder, case.yaml, led by what it was run with: version, revision, ranks, settings.
 *
 *     CaseCopyTake     before earlier results are moved aside, for the case file may be among them; nothing where there is none
 *     CaseCopyWrite    once the folder is this run's */
#ifndef CORACLE_CASE_COPY_H
#define CORACLE_CASE_COPY_H
#include <petscsys.h>

typedef struct {
  const char *path; /* of the case file, borrowed; NULL: there is none */
  size_t n;
  char *text; /* [n], on rank 0 */
} CaseCopy;

/* Collective over PETSC_COMM_WORLD, both; path: of the case file; argv: program, case file, settings, in any order; ranks: for the first
 * line.  Errors: a file that cannot be read or written.  CaseCopyWrite frees the copy. */
PetscErrorCode CaseCopyTake(const char *path, CaseCopy *copy);
PetscErrorCode CaseCopyWrite(const char *folder, const char *ranks, int argc, char **argv, CaseCopy *copy);
#endif
