/* coracle-solid: the solid participant.  coracle-solid case.yaml [--set key=value]...
 *
 * coracle-solid --alone case.yaml [--set key=value]...: the solid without coupler and fluid (alone.h). */
#include "common/program/program.h"
#include "solid/alone.h"
#include "solid/check.h"
#include "solid/exchange.h"
#include "solid/solid_case.h"
#include "solid/writer.h"

static PetscErrorCode Report(const Program *program, Solid solid)
{
  static const char *const PHASES[] = {"seconds_elements", "seconds_contact", "seconds_exchange",
                                       "seconds_limit", "seconds_joints"};
  const CoracleClient client = program->client;
  const SolidStats *stats = SolidGetStats(solid);
  SolidView v;
  PetscFunctionBeginUser;
  SolidGetView(solid, &v);
  PetscCall(CoracleReport(client, "elements", v.nelements, 1));
  PetscCall(CoracleReport(client, "bodies", v.nbodies, 0));
  PetscCall(CoracleReport(client, "substeps", (double)stats->total, 0));
  PetscCall(CoracleReport(client, "contact_searches", stats->searches, 0));
  PetscCall(CoracleReport(client, "rebalanced", stats->rebalanced, 0));
  PetscCall(ProgramReportSeconds(program, 5, PHASES, stats->seconds));
  PetscFunctionReturn(0);
}

/* --- checkpoints -------------------------------------------------------------------------------------- */

/* *from: the checkpoint that the run resumes from, NULL: from the start. */
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

/* --- the run ------------------------------------------------------------------------------------------ */

static PetscErrorCode Run(const Program *program, Solid solid, Checkpoint *from)
{
  Exchange exchange;
  Writer writer;
  CoracleAction action;
  InterfaceMotion interface;
  const double *load;
  double dt, h;
  PetscFunctionBeginUser;
  PetscCall(ExchangeCreate(program->client, solid, &exchange));
  for (int steps = 0;; steps++) {
    PetscCall(ExchangeBegin(&exchange, &dt, &action, &load));
    if (steps == 0) { /* all participants have accepted the case */
      PetscCall(WriterCreate(program->c, program->comm, solid, *from, &writer));
      PetscCall(CheckpointClose(from));
    }
    if (steps > 0 && action != CORACLE_REDO) PetscCall(WriterStep(writer, solid, exchange.waited));
    PetscCall(Save(program->client, solid, writer, exchange.waited));
    if (action == CORACLE_STOP) break;
    PetscCall(SolidStart(solid, dt, load));
    while (SolidRemaining(solid)) {
      PetscCall(SolidSubstep(solid, &h));
      PetscCall(ExchangeSubstep(&exchange, h));
    }
    PetscCall(SolidUpdateInterfaceMotion(
        solid, &interface)); /* before elements change ranks, while contact is known */
    PetscCall(SolidRebalance(solid));
    PetscCall(ExchangeMotion(&exchange));
  }
  PetscCall(WriterDestroy(&writer));
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
  Program program;
  Solid solid;
  Checkpoint from;
  if (command != COMMAND_RUN) return SolidAnswer(command, argc, argv);
  if (TakeAlone(&argc, argv)) return Alone(argc, argv);
  PetscCall(ProgramStart("solid", argc, argv, &program));
  PetscCall(SolidFromCase(program.c, program.comm, ProgramFail, &program, &solid));
  PetscCall(Resume(program.client, solid, &from));
  PetscCall(Run(&program, solid, &from));
  PetscCall(Report(&program, solid));
  PetscCall(SolidDestroy(&solid));
  return ProgramEnd(&program);
}
