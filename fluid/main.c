/* coracle-fluid: the fluid participant.  coracle-fluid case.yaml [--set key=value]... */
#include "common/mesh/mesh_checkpoint.h"
#include "fluid/adaptation.h"
#include "fluid/check.h"
#include "fluid/exchange.h"
#include "fluid/fluid_case.h"
#include "fluid/writer.h"

static void Fail(void *client, const char *message)
{
  CoracleFail(client, "%s", message);
}

static PetscErrorCode Abort(MPI_Comm comm, int line, const char *function, const char *file,
                            PetscErrorCode code, PetscErrorType type, const char *message, void *client)
{
  CoracleFail(client, "%s (in %s, %s:%d)", message ? message : "an error of PETSc", function, file, line);
}

/* The sections of the case that concern the fluid, all of whose keys must have been read. */
static const char *const SECTIONS[] = {"fluid", NULL};

/* What the time loop holds; mesh, fluid and all that is as large as they change with the mesh. */
typedef struct {
  CoracleClient client;
  Case c;
  Mesh *mesh;
  Fluid fluid;
  Exchange exchange;
  Writer record;
  Adaptation adaptation; /* NULL: the mesh stays */
  PetscBool new_mesh;    /* since the last step */
} RunState;

/* ExchangeFirst: the solid has shown where it is, and the fluid starts on a mesh that is fine there. */
static PetscErrorCode FirstMesh(void *context, int nbox, const double box[], Fluid *fluid)
{
  RunState *m = context;
  Mesh *mesh;
  PetscFunctionBeginUser;
  PetscCall(AdaptationFirstMesh(m->adaptation, m->mesh, nbox, box, &mesh));
  PetscCall(FluidCreateLike(m->fluid, mesh, fluid));
  PetscCall(FluidSetInitial(*fluid, 0.0, NULL, NULL, NULL));
  PetscCall(FluidDestroy(&m->fluid));
  PetscCall(MeshDestroy(&m->mesh));
  m->mesh = mesh;
  m->fluid = *fluid;
  PetscFunctionReturn(0);
}

/* --- checkpoints ---------------------------------------------------------------------------------------- */

/* If a checkpoint is due: what the fluid is as the step begins, or at the end. */
static PetscErrorCode Save(const RunState *m)
{
  const char *folder = CoracleCheckpointPath(m->client);
  Checkpoint to;
  PetscFunctionBeginUser;
  if (!folder) PetscFunctionReturn(0);
  PetscCall(CheckpointCreate(m->mesh->comm, folder, "fluid", &to));
  PetscCall(MeshSave(m->mesh, to));
  PetscCall(FluidSave(m->fluid, to));
  PetscCall(CheckpointPutNumber(to, "new mesh", m->new_mesh));
  PetscCall(AdaptationSave(m->adaptation, to));
  PetscCall(WriterSave(m->record, to));
  PetscCall(CheckpointClose(&to));
  PetscFunctionReturn(0);
}

static PetscErrorCode Load(RunState *m, Checkpoint from, const PetscInt row[])
{
  double new_mesh;
  PetscFunctionBeginUser;
  PetscCall(FluidLoad(m->fluid, row, from));
  PetscCall(CheckpointGetNumber(from, "new mesh", &new_mesh));
  m->new_mesh = new_mesh ? PETSC_TRUE : PETSC_FALSE;
  PetscCall(AdaptationLoad(m->adaptation, from));
  PetscFunctionReturn(0);
}

/* --- the run -------------------------------------------------------------------------------------------- */

/* What the case says, with the mesh of a checkpoint if there is one. */
static PetscErrorCode Create(RunState *m, MPI_Comm comm, const char *resume, Checkpoint from, PetscInt **row)
{
  FluidSetup setup;
  AdaptationSetup adaptation;
  PetscBool adapts;
  PetscFunctionBeginUser;
  PetscCall(PetscOptionsInsertString(NULL, CaseStringOr(m->c, "fluid.petsc", "")));
  PetscCall(FluidCaseMesh(m->c, comm, from, &m->mesh, row));
  if (from) FluidCaseCheckResumed(m->c, m->mesh, resume);
  PetscCall(FluidCaseSetup(m->c, m->mesh, &setup));
  PetscCall(FluidCaseAdaptation(m->c, &adapts, &adaptation));
  PetscCall(CaseFinish(m->c, SECTIONS));
  if (adapts) PetscCall(AdaptationCreate(&adaptation, &m->adaptation));
  PetscCall(FluidCreate(m->mesh, &setup, &m->fluid));
  PetscCall(PetscFree(setup.boundary));
  PetscFunctionReturn(0);
}

static PetscErrorCode Setup(RunState *m, MPI_Comm comm)
{
  const char *resume = CoracleResumePath(m->client);
  Checkpoint from = NULL;
  PetscInt *row = NULL;
  PetscFunctionBeginUser;
  if (resume) PetscCall(CheckpointOpen(comm, resume, "fluid", &from));
  PetscCall(Create(m, comm, resume, from, &row));
  if (from)
    PetscCall(Load(m, from, row));
  else
    PetscCall(FluidSetInitial(m->fluid, 0.0, NULL, NULL, NULL));
  PetscCall(PetscFree(row));
  PetscCall(ExchangeCreate(m->client, m->fluid, m->adaptation && !from ? FirstMesh : NULL, m, &m->exchange));
  PetscCall(WriterCreate(m->c, m->fluid, from, &m->record));
  PetscCall(CheckpointClose(&from));
  PetscFunctionReturn(0);
}

static PetscErrorCode Report(CoracleClient client, Fluid fluid)
{
  static const char *const PHASES[] = {"seconds_assembly",   "seconds_momentum",   "seconds_pressure",
                                       "seconds_correction", "seconds_adaptation", "seconds_setup"};
  PetscFunctionBeginUser;
  PetscCall(CoracleReport(client, "elements", FluidMesh(fluid)->ne, 1));
  for (int k = 0; k < 6; k++)
    PetscCall(CoracleReport(client, PHASES[k], FluidGetStats(fluid)->seconds[k], 0));
  PetscFunctionReturn(0);
}

/* When it is time: another mesh for the flow of the step in hand, and a fluid on it. */
static PetscErrorCode Remesh(RunState *m, Mesh **mesh, Fluid *fluid)
{
  PetscBool due = PETSC_FALSE;
  PetscFunctionBeginUser;
  *mesh = NULL;
  *fluid = NULL;
  if (m->adaptation) PetscCall(AdaptationDue(m->adaptation, m->fluid, &due));
  if (!due) PetscFunctionReturn(0);
  PetscCall(AdaptationMesh(m->adaptation, m->fluid, mesh));
  PetscCall(FluidCreateLike(m->fluid, *mesh, fluid));
  PetscFunctionReturn(0);
}

/* The step has been completed on the old mesh: what follows is on the new one. */
static PetscErrorCode AcceptMesh(RunState *m, Mesh *mesh, Fluid fluid)
{
  PetscFunctionBeginUser;
  PetscCall(FluidTransfer(m->fluid, fluid));
  PetscCall(FluidDestroy(&m->fluid));
  PetscCall(MeshDestroy(&m->mesh));
  m->mesh = mesh;
  m->fluid = fluid;
  m->new_mesh = PETSC_TRUE;
  WriterNewMesh(m->record);
  PetscFunctionReturn(0);
}

/* The step will be redone. */
static PetscErrorCode DiscardMesh(RunState *m, Mesh **mesh, Fluid *fluid)
{
  PetscFunctionBeginUser;
  if (m->adaptation) AdaptationDiscard(m->adaptation);
  PetscCall(FluidDestroy(fluid));
  PetscCall(MeshDestroy(mesh));
  PetscFunctionReturn(0);
}

static PetscErrorCode Step(RunState *m, double dt)
{
  const CoracleCorrection *correction;
  Mesh *mesh;
  Fluid next;
  PetscBool accepted;
  PetscFunctionBeginUser;
  PetscCall(ExchangeReceiveCoupling(m->exchange));
  if (m->new_mesh) PetscCall(FluidMakeSolenoidal(m->fluid));
  PetscCall(FluidMomentum(m->fluid, dt));
  PetscCall(FluidProject(m->fluid, dt));
  PetscCall(Remesh(m, &mesh, &next));
  PetscCall(ExchangeFlow(m->exchange, next, &accepted, &correction));
  if (!accepted) {
    PetscCall(DiscardMesh(m, &mesh, &next));
    PetscFunctionReturn(0);
  }
  m->new_mesh = PETSC_FALSE;
  PetscCall(FluidCorrect(m->fluid, dt, correction));
  PetscCall(WriterStep(m->record, m->fluid));
  if (next) PetscCall(AcceptMesh(m, mesh, next));
  PetscFunctionReturn(0);
}

static PetscErrorCode Run(CoracleClient client, Case c, MPI_Comm comm)
{
  RunState m = {.client = client, .c = c};
  CoracleAction action;
  double t, dt;
  PetscFunctionBeginUser;
  PetscCall(Setup(&m, comm));
  PetscCall(CoracleBegin(client, &t, &dt, &action));
  for (int steps = 0; action != CORACLE_STOP; steps++) {
    PetscCall(Save(&m));
    PetscCall(Step(&m, dt));
    if (steps == 0) PetscCall(FluidCaseCheckOptions(c));
    PetscCall(CoracleBegin(client, &t, &dt, &action));
  }
  PetscCall(Save(&m));
  PetscCall(Report(client, m.fluid));
  PetscCall(WriterDestroy(&m.record));
  PetscCall(ExchangeDestroy(&m.exchange));
  PetscCall(AdaptationDestroy(&m.adaptation));
  PetscCall(FluidDestroy(&m.fluid));
  PetscCall(MeshDestroy(&m.mesh));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  const Command command = CommandTake(&argc, argv);
  CoracleClient client;
  MPI_Comm comm;
  Case c;
  if (command != COMMAND_RUN) return FluidAnswer(command, argc, argv);
  if (CoracleOpen("fluid", argc, argv, &comm, &client)) return 1;
  PETSC_COMM_WORLD = comm;
  PetscCall(PetscInitialize(NULL, NULL, NULL, NULL));
  PetscCall(PetscPushErrorHandler(Abort, client));
  PetscCall(CaseOpen(argc, argv, Fail, client, &c));
  PetscCall(Run(client, c, comm));
  PetscCall(CaseClose(&c));
  PetscCall(PetscFinalize());
  return CoracleClose(&client);
}
