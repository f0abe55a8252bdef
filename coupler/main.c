/* coracle-coupler: the middle of the route.  coracle-coupler case.yaml [--set key=value]...
 *
 *     open, read the case
 *     run the scheme (time_loop.c): each step
 *         fluid   u*, u+, rho, mu (, p)            -->  force on the solid
 *         solid   new position and velocity        -->  correction of the fluid; shell and overlap at the new position
 *         fluid   <--  correction, coupling of the next step; or the same step again, with another velocity
 *     write the summary */
#include "common/program/program.h"
#include "coupler/summary.h"
#include "coupler/time_loop.h"

static PetscErrorCode Run(Server server, const CouplerCase *c)
{
  TimeLoop scheme = {.server = server, .c = c};
  const char *folder = ServerResumePath(server);
  WriterTotals totals;

  PetscFunctionBeginUser;
  if (folder) PetscCall(CheckpointOpen(PETSC_COMM_WORLD, folder, "coupler", &scheme.from));
  PetscCall(CouplerCreate(PETSC_COMM_WORLD, &c->options, &scheme.coupler));
  PetscCall(RegionCreate(PETSC_COMM_WORLD, c->options.thickness, &scheme.region));
  PetscCall(WriterCreate(PETSC_COMM_WORLD, c, scheme.from, &scheme.record));
  PetscCall(TimeLoopRun(&scheme));
  PetscCall(WriterTotalsOf(scheme.record, CouplerOverlap(scheme.coupler)->nelements, &totals));
  PetscCall(SummaryWrite(server, c, &totals));
  PetscCall(WriterDestroy(&scheme.record));
  PetscCall(RegionDestroy(&scheme.region));
  PetscCall(CouplerDestroy(&scheme.coupler));
  PetscCall(CheckpointClose(&scheme.from));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  Program program;
  CouplerCase c;
  PetscCall(ProgramStart("coupler", argc, argv, &program));
  PetscCall(CouplerCaseRead(program.c, &c));
  PetscCall(Run(program.server, &c));
  return ProgramEnd(&program);
}
