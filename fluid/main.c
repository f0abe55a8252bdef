/* coracle-fluid: the fluid participant.  coracle-fluid case.yaml [--set key=value]...
 *
 *     start; mesh, fluid, first exchange
 *     each step from t over dt
 *         assembly without the solid, while the coupler computes
 *         coupling of the solid        -->  u*, u projected, p; another mesh when it is due
 *         flow near the solid          -->  coupler, solid  -->  correction inside the solid, or: to be redone
 *                                                                (or, where an equation has not converged: over a shorter step)
 *     report, end */
#include "fluid/check.h"
#include "fluid/input/fluid_case.h"
#include "fluid/run.h"

static PetscErrorCode Step(FluidRun *m, double dt)
{
  const CoracleCorrection *correction;
  Mesh *mesh;
  Fluid next;
  PetscBool accepted;
  PetscFunctionBeginUser;
  if (!m->first && !m->not_solenoidal && !FluidPhases(m->fluid)) {
    PetscCall(CoraclePhase(m->program->client, "momentum"));
    PetscCall(FluidPrepareMomentum(m->fluid, dt));
  }
  PetscCall(ExchangeReceiveCoupling(m->exchange));
  if (m->not_solenoidal) PetscCall(FluidMakeSolenoidal(m->fluid));
  if (m->first) PetscCall(FluidStartInside(m->fluid));
  PetscCall(CoraclePhase(m->program->client, "momentum"));
  if (!FluidStepFailure(m->fluid)) PetscCall(FluidMomentum(m->fluid, dt));
  PetscCall(CoraclePhase(m->program->client, "pressure"));
  if (!FluidStepFailure(m->fluid)) PetscCall(FluidProject(m->fluid, dt));
  if (FluidStepFailure(m->fluid)) {
    PetscCall(ExchangeReject(m->exchange, FluidStepFailure(m->fluid)));
    PetscFunctionReturn(0);
  }
  PetscCall(CoraclePhase(m->program->client, "adaptation"));
  PetscCall(FluidRunRemesh(m, &mesh, &next));
  PetscCall(CoraclePhase(m->program->client, NULL));
  PetscCall(ExchangeFlow(m->exchange, next, &accepted, &correction));
  if (!accepted) {
    PetscCall(FluidRunDiscardMesh(m, &mesh, &next));
    PetscFunctionReturn(0);
  }
  m->not_solenoidal = m->first = PETSC_FALSE;
  PetscCall(FluidCorrect(m->fluid, dt, correction));
  PetscCall(CoraclePhase(m->program->client, "output"));
  PetscCall(FluidRunWrite(m));
  PetscCall(CoraclePhase(m->program->client, NULL));
  if (next) PetscCall(FluidRunAcceptMesh(m, mesh, next));
  PetscFunctionReturn(0);
}

static PetscErrorCode Run(const Program *program)
{
  FluidRun run;
  CoracleAction action;
  double t, dt;
  PetscFunctionBeginUser;
  PetscCall(FluidRunCreate(program, &run));
  PetscCall(CoracleBegin(program->client, &t, &dt, &action));
  PetscCall(FluidRunOpenOutput(&run));
  for (int steps = 0; action != CORACLE_STOP; steps++) {
    PetscCall(FluidRunSave(&run));
    PetscCall(Step(&run, dt));
    if (steps == 0) PetscCall(FluidCaseCheckOptions(program->c));
    PetscCall(CoracleBegin(program->client, &t, &dt, &action));
  }
  PetscCall(FluidRunSave(&run));
  PetscCall(FluidRunDestroy(&run));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  const Command command = CommandTake(&argc, argv);
  Program program;
  if (command != COMMAND_RUN) return FluidAnswer(command, argc, argv);
  PetscCall(ProgramStart("fluid", argc, argv, &program));
  PetscCall(Run(&program));
  return ProgramEnd(&program);
}
