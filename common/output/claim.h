/* A run's right to its output folder.
 *
 *     <folder>/running        while a run writes there: who; locked, so that it is free again however the run ends
 *              earlier.1/     what the run before has left, when a new one starts (not one that resumes from there)
 *
 * A folder is claimed when all participants have accepted the case: until then nothing in it is touched. */
#ifndef CORACLE_OUTPUT_CLAIM_H
#define CORACLE_OUTPUT_CLAIM_H
#include <petscsys.h>

typedef struct Claim_s *Claim;

/* Collective: makes the folder if missing, locks it, and moves earlier results aside unless `resumes`.  A folder in which
 * another run is writing is an error that names that run. */
PetscErrorCode ClaimFolder(MPI_Comm comm, const char *folder, PetscBool resumes, Claim *claim);
PetscErrorCode ClaimRelease(Claim *claim);
#endif
