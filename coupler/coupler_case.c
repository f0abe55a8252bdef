#include "coupler/coupler_case.h"
#include "common/output/options.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

static void ReadOptions(Case file, CouplerOptions *o)
{
  o->mode = (CouplerMode)CaseWord(file, "coupler.mode", COUPLER_REACTION, COUPLER_MODES);
  o->thickness = CasePositive(file, "coupler.shell_thickness");
  o->relaxation = CaseNumberOr(file, "coupler.relaxation", 10.0, 0.0, HUGE_VAL);
  if (o->relaxation <= 0.0)
    CaseRefuse(file, "coupler.relaxation", "expected a number > 0, found %g", o->relaxation);
  CaseVector(file, "gravity", 2, o->gravity);
  /* The fluid tells its viscosity with its first flow; until then a single-phase fluid's is the case file's.
   */
  o->viscosity = CaseHas(file, "fluid.viscosity") ? CasePositive(file, "fluid.viscosity") : 0.0;
}

/* Open MPI's shared file pointers (4.1) write names of files into buffers of 256 characters. */
enum { FOLDER_LENGTH = 200 };

static void ReadFolder(Case file, CouplerCase *c)
{
  const char *folder = CaseString(file, "output.folder");
  const size_t n = strlen(folder);
  if (n > FOLDER_LENGTH)
    CaseRefuse(file, "output.folder",
               "its name has %zu characters, more than %d: use a relative path or a link", n,
               (int)FOLDER_LENGTH);
  snprintf(c->folder, sizeof c->folder, "%s", folder);
}

PetscErrorCode CouplerCaseRead(Case file, CouplerCase *c)
{
  static const char *const SECTIONS[] = {"case", "note", "gravity", "time", "coupler", "output", NULL};
  char option[256];

  PetscFunctionBeginUser;
  snprintf(c->name, sizeof c->name, "%s", CaseString(file, "case"));
  snprintf(c->note, sizeof c->note, "%s", CaseStringOr(file, "note", ""));
  ReadFolder(file, c);
  c->every = CasePositive(file, "output.every");
  c->checkpoint = CaseNumberOr(file, "output.checkpoint", 600.0, 0.0, HUGE_VAL);
  c->end = CasePositive(file, "time.end");
  c->dt_max = CasePositive(file, "time.dt_max");
  /* the fluid's, read here so that the whole section can be checked */
  (void)CaseNumberOr(file, "time.cfl", 0.5, 0.0, HUGE_VAL);
  ReadOptions(file, &c->options);
  c->tries = CaseIntegerOr(file, "coupler.tries", 1, 1, 1000);
  c->tolerance = CaseNumberOr(file, "coupler.tolerance", 1e-4, 1e-12, 1.0);
  PetscCall(PetscOptionsInsertString(NULL, CaseStringOr(file, "coupler.petsc", "")));
  PetscCall(CaseFinish(file, SECTIONS));
  PetscCall(OptionsUnused(CaseStringOr(file, "coupler.petsc", ""), sizeof option, option));
  if (option[0]) CaseRefuse(file, "coupler.petsc", "nothing in the coupler has the option %s", option);
  PetscFunctionReturn(0);
}
