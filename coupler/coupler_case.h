/* What the coupler reads from the case file: sections case, note, gravity, time, coupler, output. */
#ifndef CORACLE_COUPLER_CASE_H
#define CORACLE_COUPLER_CASE_H
#include "common/link/case_file.h"
#include "coupler/coupler.h"

typedef struct {
  char name[128], note[512], folder[512];
  double end, dt_max, every; /* s */
  double checkpoint;         /* seconds by the clock from one to the next, 0: none */
  int tries;                 /* of a step, at most; 1: staggered */
  double tolerance;          /* on the solid's velocity, when tries agree */
  CouplerOptions options;
} CouplerCase;

/* Any rank; a wrong value ends the job. */
PetscErrorCode CouplerCaseRead(CoracleCase file, CouplerCase *c);
#endif
