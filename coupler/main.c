/* coracle-coupler: the middle of the route.  coracle-coupler case.yaml [--set key=value]...
 *
 *     join the job, read the case
 *     time loop (time_loop.c): each step
 *         fluid   -- u*, u+, rho, mu --------------->  coupler  -- force on the nodes -->  solid
 *         solid   -- new position and velocity ----->  coupler  -- correction, and the coupling of the next
 *                                                                  step at the new position -->  fluid
 *     write summary.json */
#include "common/program/program.h"
#include "coupler/check.h"
#include "coupler/output/summary.h"
#include "coupler/time_loop.h"

static PetscErrorCode Run(Server server, const CouplerCase *c)
{
  TimeLoop loop = {.server = server, .c = c};
  const char *folder = ServerResumePath(server);
  WriterTotals totals;

  PetscFunctionBeginUser;
  if (folder) PetscCall(CheckpointOpen(PETSC_COMM_WORLD, folder, "coupler", &loop.from));
  PetscCall(CouplerCreate(PETSC_COMM_WORLD, &c->options, &loop.coupler));
  PetscCall(RegionCreate(PETSC_COMM_WORLD, c->options.thickness, &loop.region));
  PetscCall(TimeLoopRun(&loop));
  PetscCall(WriterTotalsOf(loop.writer, CouplerOverlap(loop.coupler)->nelements, &totals));
  PetscCall(SummaryWrite(server, c, &totals));
  PetscCall(WriterDestroy(&loop.writer));
  PetscCall(ClaimRelease(&loop.claim));
  PetscCall(RegionDestroy(&loop.region));
  PetscCall(CouplerDestroy(&loop.coupler));
  PetscCall(CheckpointClose(&loop.from));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  const Command command = CommandTake(&argc, argv);
  Program program;
  CouplerCase c;
  if (command != COMMAND_RUN) return CouplerAnswer(command, argc, argv);
  PetscCall(ProgramStart("coupler", argc, argv, &program));
  PetscCall(CouplerCaseRead(program.c, &c));
  c.argc = argc;
  c.argv = argv;
  PetscCall(Run(program.server, &c));
  return ProgramEnd(&program);
}
