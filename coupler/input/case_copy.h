/* A copy of the case in the output folder, case.yaml, led by what it was run with: version, revision, ranks, settings.
 *
 *     CaseCopyTake     before earlier results are moved aside, for the case file may be among them; nothing where there is none
 *     CaseCopyWrite    once the folder is this run's */
#ifndef CORACLE_CASE_COPY_H
#define CORACLE_CASE_COPY_H
#include "common/link/server.h"
#include "coupler/input/coupler_case.h"
#include <petscsys.h>

typedef struct {
  size_t n;
  char *text; /* [n], on rank 0 of the coupler */
} CaseCopy;

/* Collective over the coupler, both; errors: a file that cannot be read or written.  CaseCopyWrite frees the copy. */
PetscErrorCode CaseCopyTake(const CouplerCase *c, CaseCopy *copy);
PetscErrorCode CaseCopyWrite(Server server, const CouplerCase *c, CaseCopy *copy);
#endif
