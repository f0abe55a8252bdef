/* coracle-coupler: the middle of the route.  coracle-coupler case.yaml [--set key=value]...
 *
 *     open, read the case
 *     run the scheme (scheme.c): each step
 *         fluid   u*, u+, p, mu                    -->  force on the solid
 *         solid   new position and velocity        -->  correction of the fluid; shell and overlap at the new position
 *         fluid   <--  correction, coupling of the next step; or the same step again, with another velocity
 *     write the summary */
#include "coupler/check.h"
#include "coupler/summary.h"
#include "coupler/time_loop.h"

static void Refuse(void *server, const char *message)
{
  ServerFail(server, "%s", message);
}

static PetscErrorCode Abort(MPI_Comm comm, int line, const char *function, const char *file,
                            PetscErrorCode code, PetscErrorType type, const char *message, void *server)
{
  ServerFail(server, "%s (in %s, %s:%d)", message ? message : "an error of PETSc", function, file, line);
}

static PetscErrorCode Run(Server server, const CouplerCase *c)
{
  TimeLoop scheme = {.server = server, .c = c};
  const char *folder = ServerResumePath(server);
  WriterTotals totals;

  PetscFunctionBeginUser;
  if (folder) PetscCall(CheckpointOpen(PETSC_COMM_WORLD, folder, "coupler", &scheme.from));
  PetscCall(CouplerCreate(PETSC_COMM_WORLD, &c->options, &scheme.coupler));
  PetscCall(RegionCreate(PETSC_COMM_WORLD, c->options.thickness, &scheme.region));
  PetscCall(TimeLoopRun(&scheme));
  PetscCall(WriterTotalsOf(scheme.record, CouplerOverlap(scheme.coupler)->nelements, &totals));
  PetscCall(SummaryWrite(server, c, &totals));
  PetscCall(WriterDestroy(&scheme.record));
  PetscCall(ClaimRelease(&scheme.claim));
  PetscCall(RegionDestroy(&scheme.region));
  PetscCall(CouplerDestroy(&scheme.coupler));
  PetscCall(CheckpointClose(&scheme.from));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  const Command command = CommandTake(&argc, argv);
  Server server;
  MPI_Comm comm;
  Case file;
  CouplerCase c;
  if (command != COMMAND_RUN) return CouplerAnswer(command, argc, argv);
  if (ServerOpen(argc, argv, &comm, &server)) return 1;
  PETSC_COMM_WORLD = comm;
  PetscCall(PetscInitialize(NULL, NULL, NULL, NULL));
  PetscCall(PetscPushErrorHandler(Abort, server));
  PetscCall(CaseOpen(argc, argv, Refuse, server, &file));
  PetscCall(CouplerCaseRead(file, &c));
  PetscCall(CaseClose(&file));
  PetscCall(Run(server, &c));
  PetscCall(PetscPopErrorHandler());
  PetscCall(PetscFinalize());
  return ServerClose(&server);
}
