#include "common/program/run_case.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

/* Open MPI's shared file pointers (4.1) write names of files into buffers of 256 characters. */
enum { FOLDER_LENGTH = 200 };

void RunCaseRead(CoracleCase c, RunCase *r)
{
  r->folder = CoracleCaseString(c, "output.folder");
  if (!r->folder[0])
    CoracleCaseRefuse(c, "output.folder", "expected the name of a folder, found an empty one");
  if (strlen(r->folder) > FOLDER_LENGTH)
    CoracleCaseRefuse(c, "output.folder",
                      "its name has %zu characters, more than %d: use a relative path or a link",
                      strlen(r->folder), (int)FOLDER_LENGTH);
  r->every = CoracleCasePositive(c, "output.every");
  r->series_every = CoracleCaseNumberOr(c, "output.series_every", 0.0, 0.0, HUGE_VAL);
  r->end = CoracleCasePositive(c, "time.end");
  r->checkpoint = CoracleCaseNumberOr(c, "output.checkpoint", 600.0, 0.0, HUGE_VAL);
  r->walltime = CoracleCaseHas(c, "time.walltime") ? CoracleCasePositive(c, "time.walltime") : 0.0;
}

void RunCaseNoteSteps(double end, double longest)
{
  if (longest > end)
    printf("note: time.dt_max, %g s, is more than time.end, %g s: one step may be all of the run\n", longest,
           end);
}

void RunCaseNoteUnsaved(double walltime, double checkpoint)
{
  if (walltime > 0.0 && checkpoint <= 0.0)
    printf(
        "note: output.checkpoint is 0: a run that time.walltime ends leaves no checkpoint to resume from\n");
}

void RunCaseDescribe(CoracleCase c, const CoracleCaseKey own[])
{
  static const CoracleCaseKey KEYS[] = {
      {"gravity", "m/s2", "acceleration of gravity, x and y; or rows of time and both"},
      {"gravity[]", "s, m/s2",
       "time, x and y, linear between rows; of an accelerated frame gravity less its acceleration"},
      {"time.end", "s", "when the run ends"},
      {"time.walltime", "s",
       "by the clock from the start, after which the run ends with a checkpoint, as it does within a second "
       "when there is a file stop in "
       "output.folder; absent: at time.end"},
      {"time.dt_max", "s", "largest time step"},
      {"time.cfl", "",
       "largest time step over the time that the flow takes through an element, largest over the mesh"},
      {"output.folder", "", "where results go; made if missing"},
      {"output.checkpoint", "s", "by the clock, from one checkpoint to the next; 0: none"},
      {"output.every", "s", "time from one snapshot of the fields to the next; there is one at the end, too"},
      {"output.series_every", "s",
       "time from one row of the CSV series to the next, for long runs and many bodies; there is one at the "
       "end, too; 0: each step"},
      {"fluid.probes[].solid_point", "m",
       "a point of the solid's surface at the start: a pressure gauge that moves with it"},
      {"fluid.probes[].solid_line.from", "m",
       "first end of a straight side of a solid, at the start: gauges along it, and the force of the "
       "pressure "
       "on it"},
      {"fluid.probes[].solid_line.to", "m", "its other end"},
      {"fluid.probes[].solid_line.points", "", "number of gauges, at the middles of equal parts"},
      {NULL, NULL, NULL}};
  CoracleCaseDescribe(c, own);
  CoracleCaseDescribe(c, KEYS);
}
