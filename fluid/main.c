/* coracle-fluid: the fluid participant.  coracle-fluid case.yaml [--set key=value]... */
#include "exchange.h"
#include "fluid_case.h"
#include "record.h"

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

static PetscErrorCode Setup(Case c, MPI_Comm comm, Mesh **mesh, Fluid *fluid)
{
  FluidSetup setup;
  PetscFunctionBeginUser;
  PetscCall(PetscOptionsInsertString(NULL, CaseStringOr(c, "fluid.petsc", "")));
  PetscCall(FluidCaseMesh(c, comm, mesh));
  PetscCall(FluidCaseSetup(c, *mesh, &setup));
  PetscCall(CaseFinish(c, SECTIONS));
  PetscCall(FluidCreate(*mesh, &setup, fluid));
  PetscCall(FluidSetInitial(*fluid, 0.0, NULL, NULL, NULL));
  PetscCall(PetscFree(setup.boundary));
  PetscFunctionReturn(0);
}

static PetscErrorCode Report(CoracleClient client, Fluid fluid)
{
  static const char *const PHASES[] = {"seconds_assembly", "seconds_momentum", "seconds_pressure",
                                       "seconds_correction"};
  PetscFunctionBeginUser;
  PetscCall(CoracleReport(client, "elements", FluidMesh(fluid)->ne, 1));
  for (int k = 0; k < 4; k++)
    PetscCall(CoracleReport(client, PHASES[k], FluidGetStats(fluid)->seconds[k], 0));
  PetscFunctionReturn(0);
}

static PetscErrorCode Run(CoracleClient client, Case c, MPI_Comm comm)
{
  Mesh *mesh;
  Fluid fluid;
  Exchange exchange;
  Record record;
  PetscFunctionBeginUser;
  PetscCall(Setup(c, comm, &mesh, &fluid));
  PetscCall(RecordCreate(c, fluid, &record));
  PetscCall(ExchangeCreate(client, fluid, &exchange));
  for (int steps = 0;; steps++) {
    const CoracleCorrection *correction;
    CoracleAction action;
    double t, dt;
    PetscCall(CoracleBegin(client, &t, &dt, &action));
    if (action == CORACLE_STOP) break;
    PetscCall(ExchangeReceiveCoupling(exchange));
    PetscCall(FluidMomentum(fluid, dt));
    PetscCall(FluidProject(fluid, dt));
    if (steps == 0) PetscCall(FluidCaseCheckOptions(c));
    PetscCall(ExchangeFlow(exchange, &correction));
    PetscCall(FluidCorrect(fluid, dt, correction));
    PetscCall(RecordStep(record, fluid));
  }
  PetscCall(Report(client, fluid));
  PetscCall(RecordDestroy(&record));
  PetscCall(ExchangeDestroy(&exchange));
  PetscCall(FluidDestroy(&fluid));
  PetscCall(MeshDestroy(&mesh));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  CoracleClient client;
  MPI_Comm comm;
  Case c;
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
