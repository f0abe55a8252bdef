#include "fluid/run.h"
#include "common/mesh/mesh_checkpoint.h"
#include "fluid/input/boundary_case.h"
#include "fluid/input/fluid_case.h"

/* The sections of the case that concern the fluid, all of whose keys must have been read. */
static const char *const SECTIONS[] = {"fluid", NULL};

/* --- checkpoints ---------------------------------------------------------------------------------------- */

PetscErrorCode FluidRunSave(const FluidRun *m)
{
  const char *folder = CoracleCheckpointPath(m->program->client);
  Checkpoint to;
  PetscFunctionBeginUser;
  if (!folder) PetscFunctionReturn(0);
  PetscCall(CheckpointCreate(m->mesh->comm, folder, "fluid", &to));
  PetscCall(MeshSave(m->mesh, to));
  PetscCall(FluidSave(m->fluid, to));
  PetscCall(CheckpointPutNumber(to, "not solenoidal", m->not_solenoidal));
  PetscCall(CheckpointPutNumber(to, "first step", m->first));
  PetscCall(AdaptationSave(m->adaptation, to));
  PetscCall(WriterSave(m->writer, to));
  PetscCall(ProbesSave(m->probes, to));
  PetscCall(CheckpointClose(&to));
  PetscFunctionReturn(0);
}

static PetscErrorCode Load(FluidRun *m, Checkpoint from, const PetscInt row[])
{
  double not_solenoidal, first;
  PetscFunctionBeginUser;
  PetscCall(FluidLoad(m->fluid, row, from));
  PetscCall(CheckpointGetNumber(from, "not solenoidal", &not_solenoidal));
  PetscCall(CheckpointGetNumber(from, "first step", &first));
  m->first = first ? PETSC_TRUE : PETSC_FALSE;
  m->not_solenoidal = not_solenoidal ? PETSC_TRUE : PETSC_FALSE;
  PetscCall(AdaptationLoad(m->adaptation, from));
  PetscFunctionReturn(0);
}

/* --- start ---------------------------------------------------------------------------------------------- */

/* In place of the mesh that the case gives: one that is fine where the solid and the interface are. */
static PetscErrorCode FirstMesh(FluidRun *m, AdaptationStart *start)
{
  Mesh *mesh;
  PetscFunctionBeginUser;
  PetscCall(CoracleGetRegion(m->program->client, &start->nbox, &start->box));
  PetscCall(AdaptationFirstMesh(m->adaptation, m->mesh, start, &mesh));
  PetscCall(MeshDestroy(&m->mesh));
  m->mesh = mesh;
  PetscFunctionReturn(0);
}

/* Whether the run starts with a velocity that is not free of divergence: a given one; or one of phases at rest where boundaries
 * already move, with which the first step would make volume. */
static PetscErrorCode StartsWithDivergence(FluidRun *m, const FluidSetup *setup, PetscBool *starts)
{
  double net, gross;
  PetscFunctionBeginUser;
  PetscCall(BoundaryPrescribedFlux(m->mesh, setup->boundary, 0.0, &net, &gross));
  *starts = (PetscBool)(CoracleCaseHas(m->program->c, "fluid.initial") || (setup->phases.n && gross > 0.0));
  PetscFunctionReturn(0);
}

/* Mesh, fluid and adaptation as the case says; row: of a checkpoint's mesh (FluidLoad). */
static PetscErrorCode Create(FluidRun *m, const char *resume, Checkpoint from, PetscInt **row)
{
  FluidSetup setup;
  AdaptationSetup adaptation;
  PetscBool adapts;
  Region *region;
  int nregions;
  PetscFunctionBeginUser;
  PetscCall(PetscOptionsInsertString(NULL, CoracleCaseStringOr(m->program->c, "fluid.petsc", "")));
  PetscCall(FluidCaseMesh(m->program->c, m->program->comm, from, &m->mesh, row));
  if (from) BoundaryCaseCheckResumed(m->program->c, m->mesh, resume);
  PetscCall(FluidCaseSetup(m->program->c, m->mesh, &setup));
  PetscCall(FluidCaseRegions(m->program->c, &nregions, &region));
  PetscCall(FluidCaseAdaptation(m->program->c, &setup, &adapts, &adaptation));
  PetscCall(ProbesCreate(m->program->c, m->mesh, &m->probes));
  PetscCall(CoracleCaseFinish(m->program->c, SECTIONS));
  if (adapts) PetscCall(AdaptationCreate(&adaptation, &m->adaptation));
  AdaptationStart start = {.nphases = setup.phases.n, .nregions = nregions, .region = region};
  if (adapts && !from) PetscCall(FirstMesh(m, &start));
  PetscCall(ProbesNewMesh(m->probes, m->mesh));
  PetscCall(FluidCreate(m->mesh, &setup, &m->fluid));
  if (setup.phases.n && !from) PetscCall(FluidSetPhases(m->fluid, nregions, region));
  if (!from) PetscCall(StartsWithDivergence(m, &setup, &m->not_solenoidal));
  PetscCall(FluidCaseFreeRegions(nregions, &region));
  PetscCall(PetscFree(setup.boundary));
  PetscFunctionReturn(0);
}

PetscErrorCode FluidRunCreate(const Program *program, FluidRun *m)
{
  const char *resume = CoracleResumePath(program->client);
  PetscInt *row = NULL;
  PetscFunctionBeginUser;
  *m = (FluidRun){.program = program, .first = PETSC_TRUE};
  if (resume) PetscCall(CheckpointOpen(program->comm, resume, "fluid", &m->from));
  PetscCall(Create(m, resume, m->from, &row));
  if (m->from)
    PetscCall(Load(m, m->from, row));
  else
    PetscCall(FluidSetInitial(m->fluid, 0.0, NULL, NULL, NULL));
  PetscCall(PetscFree(row));
  PetscCall(ExchangeCreate(m->program->client, m->fluid, &m->exchange));
  PetscFunctionReturn(0);
}

PetscErrorCode FluidRunOpenOutput(FluidRun *m)
{
  PetscFunctionBeginUser;
  PetscCall(WriterCreate(m->program->c, m->fluid, m->from, &m->writer));
  PetscCall(ProbesOpen(m->probes, m->program->c, m->from));
  PetscCall(CheckpointClose(&m->from));
  PetscFunctionReturn(0);
}

PetscErrorCode FluidRunWrite(FluidRun *m)
{
  const CoracleGauge *gauge;
  int n;
  PetscFunctionBeginUser;
  PetscCall(WriterStep(m->writer, m->fluid));
  PetscCall(CoracleGetGauges(m->program->client, &n, &gauge));
  PetscCall(ProbesStep(m->probes, m->fluid, n, gauge));
  PetscFunctionReturn(0);
}

/* --- adaptation ----------------------------------------------------------------------------------------- */

PetscErrorCode FluidRunRemesh(FluidRun *m, Mesh **mesh, Fluid *fluid)
{
  PetscBool due = PETSC_FALSE;
  PetscFunctionBeginUser;
  *mesh = NULL;
  *fluid = NULL;
  if (m->adaptation) PetscCall(AdaptationDue(m->adaptation, m->fluid, &due));
  if (!due) PetscFunctionReturn(0);
  PetscCall(AdaptationMesh(m->adaptation, m->fluid, mesh));
  PetscCall(FluidCreateLike(m->fluid, *mesh, fluid));
  PetscCall(FluidTransferPhases(m->fluid, *fluid));
  PetscFunctionReturn(0);
}

PetscErrorCode FluidRunAcceptMesh(FluidRun *m, Mesh *mesh, Fluid fluid)
{
  PetscFunctionBeginUser;
  PetscCall(FluidTransfer(m->fluid, fluid));
  PetscCall(FluidDestroy(&m->fluid));
  PetscCall(MeshDestroy(&m->mesh));
  m->mesh = mesh;
  m->fluid = fluid;
  m->not_solenoidal = PETSC_TRUE;
  WriterNewMesh(m->writer);
  PetscCall(ProbesNewMesh(m->probes, mesh));
  PetscFunctionReturn(0);
}

PetscErrorCode FluidRunDiscardMesh(FluidRun *m, Mesh **mesh, Fluid *fluid)
{
  PetscFunctionBeginUser;
  if (m->adaptation) AdaptationDiscard(m->adaptation);
  PetscCall(FluidDestroy(fluid));
  PetscCall(MeshDestroy(mesh));
  PetscFunctionReturn(0);
}

/* --- end ------------------------------------------------------------------------------------------------ */

static PetscErrorCode Report(const Program *program, Fluid fluid)
{
  static const char *const PHASES[] = {"seconds_assembly",   "seconds_momentum",   "seconds_pressure",
                                       "seconds_correction", "seconds_adaptation", "seconds_setup"};
  PetscFunctionBeginUser;
  PetscCall(CoracleReport(program->client, "elements", FluidMesh(fluid)->ne, 1));
  PetscCall(ProgramReportSeconds(program, 6, PHASES, FluidGetStats(fluid)->seconds));
  PetscFunctionReturn(0);
}

PetscErrorCode FluidRunDestroy(FluidRun *m)
{
  PetscFunctionBeginUser;
  PetscCall(Report(m->program, m->fluid));
  PetscCall(WriterDestroy(&m->writer));
  PetscCall(ProbesDestroy(&m->probes));
  PetscCall(ExchangeDestroy(&m->exchange));
  PetscCall(AdaptationDestroy(&m->adaptation));
  PetscCall(FluidDestroy(&m->fluid));
  PetscCall(MeshDestroy(&m->mesh));
  PetscFunctionReturn(0);
}
