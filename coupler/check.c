#include "coupler/check.h"
#include "common/program/program.h"
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
    {"gravity", "m/s2", "acceleration of gravity, x and y; or rows of time and both"},
    {"gravity[]", "s, m/s2",
     "time, x and y, linear between rows; of an accelerated frame gravity less its acceleration"},
    {"time.end", "s", "when the run ends"},
    {"time.dt_max", "s", "largest time step"},
    {"time.cfl", "",
     "largest time step over the time that the flow takes through an element, largest over the mesh"},
    {"output.folder", "", "where results go; made if missing"},
    {"output.every", "s", "time from one snapshot of the fields to the next; there is one at the end, too"},
    {"output.checkpoint", "s", "by the clock, from one checkpoint to the next; 0: none"},
    {"output.trace", "", "trace.json: what each rank did when, for ui.perfetto.dev"},
    {"fluid.viscosity", "Pa s", "dynamic viscosity"},
    {"fluid.phases", "", "two phases that do not mix, instead of density and viscosity"},
    {"fluid.probes", "", "list of points, lines and pressure gauges whose values are in fluid_probes.csv"},
    {"fluid.probes[].solid_point", "m",
     "a point of the solid's surface at the start: a pressure gauge that moves with it"},
    {"solid.walls.lower", "m", "lower left corner of four rigid walls around all bodies"},
    {"solid.walls.upper", "m", "upper right corner of the walls"},
    {"coupler.mode", "", "how fluid and solid are coupled"},
    {"coupler.shell_thickness", "m",
     "dr: thickness of the shell around the solid in which wall friction acts"},
    {"coupler.relaxation", "", "sigma dt/rho: how firmly the fluid inside follows the solid"},
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

static void Read(CoracleCase c, void *command)
{
  static CouplerCase k;
  CoracleCaseDescribe(c, KEYS);
  (void)CoracleCaseStringOr(c, "resume", "");
  if (CouplerCaseRead(c, &k)) return;
  CheckFolder(c, k.folder);
  if (*(const Command *)command == COMMAND_KEYS || !CoracleCaseFaultless(c)) return;
  printf("coupler: to t = %g s in at least %.0f steps, %.0f snapshots into %s\n", k.end,
         ceil(k.end / k.dt_max), ceil(k.end / k.every * (1.0 - 1e-9)) + 1.0, k.folder);
}

int CouplerAnswer(Command command, int argc, char **argv)
{
  static const CommandAnswers ANSWERS = {"coupler", "", Read};
  return ProgramAnswer(command, &ANSWERS, argc, argv);
}
