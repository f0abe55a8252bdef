/* coracle-solid: the solid participant.  coracle-solid case.yaml [--set key=value]...
 *
 * coracle-solid --alone case.yaml [--set key=value]...: the solid without coupler and fluid (alone.h). */
#include "solid/alone.h"
#include "solid/check.h"
#include "solid/exchange.h"
#include "solid/solid_case.h"
#include "solid/writer.h"

static void Fail(void *client, const char *message)
{
  CoracleFail(client, "%s", message);
}

static PetscErrorCode Abort(MPI_Comm comm, int line, const char *function, const char *file,
                            PetscErrorCode code, PetscErrorType type, const char *message, void *client)
{
  CoracleFail(client, "%s (in %s, %s:%d)", message ? message : "an error of PETSc", function, file, line);
}

static PetscErrorCode Report(CoracleClient client, Solid solid)
{
  static const char *const PHASES[] = {"seconds_elements", "seconds_contact", "seconds_exchange",
                                       "seconds_limit", "seconds_joints"};
  const SolidStats *stats = SolidGetStats(solid);
  SolidView v;
  PetscFunctionBeginUser;
  SolidGetView(solid, &v);
  PetscCall(CoracleReport(client, "elements", v.nelements, 1));
  PetscCall(CoracleReport(client, "bodies", v.nbodies, 0));
  PetscCall(CoracleReport(client, "substeps", (double)stats->total, 0));
  PetscCall(CoracleReport(client, "contact_searches", stats->searches, 0));
  PetscCall(CoracleReport(client, "rebalanced", stats->rebalanced, 0));
  for (int k = 0; k < 5; k++) PetscCall(CoracleReport(client, PHASES[k], stats->seconds[k], 0));
  PetscFunctionReturn(0);
}

/* --- checkpoints
 * -------------------------------------------------------------------------------------------- */

/* *from: the checkpoint that the run goes on from, NULL: from the start. */
static PetscErrorCode Resume(CoracleClient client, Solid solid, Checkpoint *from)
{
  const char *folder = CoracleResumePath(client);
  PetscFunctionBeginUser;
  *from = NULL;
  if (!folder) PetscFunctionReturn(0);
  PetscCall(CheckpointOpen(PETSC_COMM_WORLD, folder, "solid", from));
  PetscCall(SolidLoad(solid, *from));
  PetscFunctionReturn(0);
}

/* If one is due. */
static PetscErrorCode Save(CoracleClient client, Solid solid, Writer record, double waited)
{
  const char *folder = CoracleCheckpointPath(client);
  Checkpoint to;
  PetscFunctionBeginUser;
  if (!folder) PetscFunctionReturn(0);
  PetscCall(CheckpointCreate(PETSC_COMM_WORLD, folder, "solid", &to));
  PetscCall(SolidSave(solid, to));
  PetscCall(WriterSave(record, waited, to));
  PetscCall(CheckpointClose(&to));
  PetscFunctionReturn(0);
}

/* --- the run
 * ------------------------------------------------------------------------------------------------ */

static PetscErrorCode Run(CoracleClient client, Case c, Solid solid, Checkpoint *from)
{
  Exchange exchange;
  Writer record;
  CoracleAction action;
  const double *load;
  double dt, h;
  PetscFunctionBeginUser;
  PetscCall(ExchangeCreate(client, solid, &exchange));
  for (int steps = 0;; steps++) {
    PetscCall(ExchangeBegin(&exchange, &dt, &action, &load));
    if (steps == 0) { /* all have accepted the case: now there is output */
      PetscCall(WriterCreate(c, PETSC_COMM_WORLD, solid, *from, &record));
      PetscCall(CheckpointClose(from));
    }
    if (steps > 0 && action != CORACLE_REDO) PetscCall(WriterStep(record, solid, exchange.waited));
    PetscCall(Save(client, solid, record, exchange.waited));
    if (action == CORACLE_STOP) break;
    PetscCall(SolidStart(solid, dt, load));
    while (SolidRemaining(solid)) {
      PetscCall(SolidSubstep(solid, &h));
      PetscCall(ExchangeSubstep(&exchange, h));
    }
    PetscCall(SolidRebalance(solid));
    PetscCall(ExchangeMotion(&exchange));
  }
  PetscCall(WriterDestroy(&record));
  PetscCall(ExchangeDestroy(&exchange));
  PetscFunctionReturn(0);
}

/* Takes --alone out of argv. */
static int TakeAlone(int *argc, char **argv)
{
  int kept = 0, found = 0;
  for (int k = 0; k < *argc; k++) {
    found |= !strcmp(argv[k], "--alone");
    if (strcmp(argv[k], "--alone")) argv[kept++] = argv[k];
  }
  *argc = kept;
  return found;
}

int main(int argc, char **argv)
{
  const Command command = CommandTake(&argc, argv);
  CoracleClient client;
  MPI_Comm comm;
  Case c;
  Solid solid;
  Checkpoint from;
  if (command != COMMAND_RUN) return SolidAnswer(command, argc, argv);
  if (TakeAlone(&argc, argv)) return Alone(argc, argv);
  if (CoracleOpen("solid", argc, argv, &comm, &client)) return 1;
  PETSC_COMM_WORLD = comm;
  PetscCall(PetscInitialize(NULL, NULL, NULL, NULL));
  PetscCall(PetscPushErrorHandler(Abort, client));
  PetscCall(CaseOpen(argc, argv, Fail, client, &c));
  PetscCall(SolidFromCase(c, comm, Fail, client, &solid));
  PetscCall(Resume(client, solid, &from));
  PetscCall(Run(client, c, solid, &from));
  PetscCall(Report(client, solid));
  PetscCall(CaseClose(&c));
  PetscCall(SolidDestroy(&solid));
  PetscCall(PetscPopErrorHandler());
  PetscCall(PetscFinalize());
  return CoracleClose(&client);
}
