#include "coupler/check.h"
#include "common/link/participant.h"
#include "common/output/time_reached.h"
#include "common/program/program.h"
#include "common/program/run_case.h"
#include "coupler/input/coupler_case.h"
#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* What the calls that read them do not say of the coupler's keys. */
static const CoracleCaseKey KEYS[] = {
    {"case", "", "name of the case"},
    {"note", "", "what a reader of the results must know"},
    {"resume", "",
     "a checkpoint's folder from which the run resumes, or last: that of output.folder, if there is one"},
    {"output.trace", "", "trace.json: what each rank did when, for ui.perfetto.dev"},
    {"coupler.mode", "", "how fluid and solid are coupled"},
    {"coupler.shell_thickness", "m",
     "dr: thickness of the shell around the solid in which wall friction acts"},
    {"coupler.max_iterations", "", "most coupling iterations of a step; 1: the first is accepted"},
    {"coupler.tolerance", "", "on the solid's velocity, when iterations have converged"},
    {"coupler.petsc", "", "options for PETSc"},
    {NULL, NULL, NULL}};

/* The folder, or what of it is there, must be one that can be written into; nothing is made. */
static void CheckFolder(CoracleCase c, const char *folder)
{
  char path[PETSC_MAX_PATH_LEN];
  snprintf(path, sizeof path, "%s", folder);
  while (access(path, F_OK) && strrchr(path, '/') > path) *strrchr(path, '/') = 0;
  const char *there = access(path, F_OK) ? "." : path;
  if (access(there, W_OK | X_OK)) CoracleCaseRefuse(c, "output.folder", "%s: %s", there, strerror(errno));
}

/* A twentieth of the fluid's elements is usual (cases/GUIDE.md). */
static void NoteShell(CoracleCase c, double thickness)
{
  if (!CoracleCaseHas(c, "fluid.adapt.size_min")) return;
  const double size = CoracleCasePositive(c, "fluid.adapt.size_min");
  if (thickness > size)
    printf("note: coupler.shell_thickness, %g m, is more than fluid.adapt.size_min, %g m: it thickens the "
           "bodies; a twentieth of that is usual\n",
           thickness, size);
}

static void Read(CoracleCase c, void *command)
{
  static CouplerCase k;
  char checkpoint[PETSC_MAX_PATH_LEN];
  RunCaseDescribe(c, KEYS);
  (void)ParticipantFindResume(c, sizeof checkpoint, checkpoint);
  if (CouplerCaseRead(c, &k)) return;
  CheckFolder(c, k.run.folder);
  if (*(const Command *)command == COMMAND_KEYS || !CoracleCaseFaultless(c)) return;
  printf("coupler: to t = %g s in at least %.15g steps, %.15g snapshots into %s\n", k.run.end,
         TimeSteps(k.run.end, k.dt_max), TimeSteps(k.run.end, k.run.every) + 1.0, k.run.folder);
  RunCaseNoteSteps(k.run.end, k.dt_max);
  RunCaseNoteUnsaved(k.run.walltime, k.run.checkpoint);
  NoteShell(c, k.options.thickness);
}

int CouplerAnswer(Command command, int argc, char **argv)
{
  static const CommandAnswers ANSWERS = {"coupler", "", Read};
  return ProgramAnswer(command, &ANSWERS, argc, argv);
}
