/* coracle-solid: the solid participant.  coracle-solid case.yaml [--set key=value]...
 *
 *     start; solid, first exchange
 *     each step over dt
 *         force on the nodes  -->  substeps  -->  position, velocity, inertia, or: the step cannot be made
 *     report, end
 *
 * coracle-solid --alone case.yaml [--set key=value]...: the solid without coupler and fluid (alone.h). */
#include "solid/alone.h"
#include "solid/check.h"
#include "solid/run.h"

static PetscErrorCode Step(SolidRun *m, CoracleClient client, double dt, const double load[])
{
  InterfaceMotion interface;
  const char *why;
  double h;
  PetscFunctionBeginUser;
  PetscCall(CoraclePhase(client, "substeps"));
  PetscCall(SolidStart(m->solid, dt, load));
  while (SolidRemaining(m->solid)) {
    PetscCall(SolidSubstep(m->solid, &h));
  }
  PetscCall(SolidStepFailure(m->solid, &why));
  if (why) {
    PetscCall(ExchangeReject(&m->exchange, why));
    PetscFunctionReturn(0);
  }
  PetscCall(CoraclePhase(client, "interface"));
  PetscCall(SolidUpdateInterfaceMotion(m->solid, &interface)); /* while contact is known */
  PetscCall(SolidRebalance(m->solid));
  PetscCall(ExchangeMotion(&m->exchange));
  PetscFunctionReturn(0);
}

static PetscErrorCode Run(const Program *program)
{
  SolidRun run;
  CoracleAction action;
  const double *load;
  double dt;
  PetscFunctionBeginUser;
  PetscCall(SolidRunCreate(program, &run));
  PetscCall(ExchangeBegin(&run.exchange, &dt, &action, &load));
  PetscCall(SolidRunOpenOutput(&run));
  PetscCall(SolidRunSave(&run));
  while (action != CORACLE_STOP) {
    PetscCall(Step(&run, program->client, dt, load));
    PetscCall(ExchangeBegin(&run.exchange, &dt, &action, &load));
    if (action != CORACLE_REDO) PetscCall(WriterStep(run.writer, run.solid, run.exchange.waited));
    PetscCall(SolidRunSave(&run));
  }
  PetscCall(SolidRunDestroy(&run));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  const Command command = CommandTake(&argc, argv);
  Program program;
  if (command != COMMAND_RUN) return SolidAnswer(command, argc, argv);
  if (AloneTake(&argc, argv)) return Alone(argc, argv);
  PetscCall(ProgramStart("solid", argc, argv, &program));
  PetscCall(Run(&program));
  return ProgramEnd(&program);
}
