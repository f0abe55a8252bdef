/* What the coupler reads from the case file: sections case, note, gravity, time, coupler, output; of the fluid's the gauges on
 * solids. */
#ifndef CORACLE_COUPLER_CASE_H
#define CORACLE_COUPLER_CASE_H
#include "common/program/run_case.h"
#include "coupler/geometry/gauges.h"
#include "coupler/step/coupler.h"

typedef struct {
  char name[128], note[512];
  const char *path; /* of the case file, borrowed until CoracleCaseClose */
  RunCase run;
  double dt_max;      /* s */
  int max_iterations; /* coupling iterations of a step; 1: the first is accepted */
  double tolerance;   /* of the coupling iterations, relative (coupling_iteration.h) */
  CouplerOptions options;
  GaugesCase gauges;
  int argc; /* the command line, borrowed: program, case file, settings */
  char **argv;
} CouplerCase;

/* Any rank; a wrong value ends the job. */
PetscErrorCode CouplerCaseRead(CoracleCase file, CouplerCase *c);
#endif
