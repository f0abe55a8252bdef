#include "coupler/coupler_case.h"
#include "common/output/options.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

static void ReadOptions(CoracleCase file, CouplerOptions *o)
{
  o->mode = (CouplerMode)CoracleCaseWord(file, "coupler.mode", COUPLER_REACTION, COUPLER_MODES);
  o->thickness = CoracleCasePositive(file, "coupler.shell_thickness");
  CouplerModesReadOptions(file, o);
  CoracleCaseVector(file, "gravity", 2, o->gravity);
}

/* Open MPI's shared file pointers (4.1) write names of files into buffers of 256 characters. */
enum { FOLDER_LENGTH = 200 };

static void ReadFolder(CoracleCase file, CouplerCase *c)
{
  const char *folder = CoracleCaseString(file, "output.folder");
  const size_t n = strlen(folder);
  if (n > FOLDER_LENGTH)
    CoracleCaseRefuse(file, "output.folder",
                      "its name has %zu characters, more than %d: use a relative path or a link", n,
                      (int)FOLDER_LENGTH);
  snprintf(c->folder, sizeof c->folder, "%s", folder);
}

PetscErrorCode CouplerCaseRead(CoracleCase file, CouplerCase *c)
{
  static const char *const SECTIONS[] = {"case", "note", "gravity", "time", "coupler", "output", NULL};
  char option[256];

  PetscFunctionBeginUser;
  snprintf(c->name, sizeof c->name, "%s", CoracleCaseString(file, "case"));
  snprintf(c->note, sizeof c->note, "%s", CoracleCaseStringOr(file, "note", ""));
  ReadFolder(file, c);
  c->every = CoracleCasePositive(file, "output.every");
  c->checkpoint = CoracleCaseNumberOr(file, "output.checkpoint", 600.0, 0.0, HUGE_VAL);
  (void)CoracleCaseBoolOr(file, "output.trace", false); /* the library's */
  c->end = CoracleCasePositive(file, "time.end");
  c->dt_max = CoracleCasePositive(file, "time.dt_max");
  /* the fluid's, read here so that the whole section can be checked */
  (void)CoracleCaseNumberOr(file, "time.cfl", 0.5, 0.0, HUGE_VAL);
  ReadOptions(file, &c->options);
  GaugesReadCase(file, &c->gauges);
  CoracleCaseRenamed(file, "coupler.tries", "coupler.max_iterations");
  c->max_iterations = CoracleCaseIntegerOr(file, "coupler.max_iterations", 30, 1, 1000);
  c->tolerance = CoracleCaseNumberOr(file, "coupler.tolerance", 1e-4, 1e-12, 1.0);
  PetscCall(PetscOptionsInsertString(NULL, CoracleCaseStringOr(file, "coupler.petsc", "")));
  PetscCall(CoracleCaseFinish(file, SECTIONS));
  PetscCall(OptionsUnused(CoracleCaseStringOr(file, "coupler.petsc", ""), sizeof option, option));
  if (option[0]) CoracleCaseRefuse(file, "coupler.petsc", "nothing in the coupler has the option %s", option);
  PetscFunctionReturn(0);
}
