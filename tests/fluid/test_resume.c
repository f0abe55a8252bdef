// ranks: 1 2 3
/* The fluid's part of a case that resumes from a checkpoint: its keys are read and checked as ever, its files
 * go on where they were, an open boundary has the pressure that the case says now, and a checkpoint of other boundaries is refused. */
#include "common/mesh/mesh_checkpoint.h"
#include "fluid/input/boundary_case.h"
#include "fluid/input/fluid_case.h"
#include "fluid/output/writer.h"
#include "tests/link/catch.h"

static const char *const CASE =
    "gravity: [0.0, -9.81]\n"
    "time: {end: 0.05, cfl: 0.5, dt_max: 0.01}\n"
    "fluid:\n"
    "  density: 1000.0\n"
    "  viscosity: 0.1\n"
    "  mesh: {lower: [0.0, 0.0], upper: [1.0, 1.0], size_max: 0.25, growth: 0.3,\n"
    "    refine: [{lower: [0.1, 0.1], upper: [0.2, 0.2], size: 0.1}]}\n"
    "  boundaries: {left: no_slip, right: open, bottom: no_slip, top: {velocity: [1.0, 0.0]}}\n"
    "output: {every: 0.02}\n"
    "resume: last\n";

static char output[256], folder[300];
static Checkpoint from;
static Mesh *mesh; /* outlives what is refused */
static PetscInt *row;

/* As in main.c. */
static PetscErrorCode Read(CoracleCase c, FluidSetup *setup)
{
  static const char *const SECTIONS[] = {"fluid", NULL};
  AdaptationSetup adaptation;
  PetscBool adapts;
  PetscFunctionBeginUser;
  PetscCall(FluidCaseMesh(c, PETSC_COMM_WORLD, from, &mesh, &row));
  if (from) BoundaryCaseCheckResumed(c, mesh, folder);
  PetscCall(FluidCaseSetup(c, mesh, setup));
  PetscCall(FluidCaseAdaptation(c, setup, &adapts, &adaptation));
  if (CoracleCaseFinish(c, SECTIONS)) PetscFunctionReturn(PETSC_ERR_PLIB);
  PetscFunctionReturn(0);
}

static PetscErrorCode Save(Fluid fluid, Writer writer)
{
  Checkpoint to;
  PetscFunctionBeginUser;
  PetscCall(CheckpointCreate(PETSC_COMM_WORLD, folder, "fluid", &to));
  PetscCall(MeshSave(mesh, to));
  PetscCall(FluidSave(fluid, to));
  PetscCall(WriterSave(writer, to));
  PetscCall(CheckpointClose(&to));
  PetscFunctionReturn(0);
}

/* Until t = 0.05 s; from the start there is a checkpoint at 0.03 s on the way. */
static PetscErrorCode RunState(CoracleCase c)
{
  FluidSetup setup;
  Fluid fluid;
  Writer writer;
  PetscFunctionBeginUser;
  PetscCall(Read(c, &setup));
  PetscCall(FluidCreate(mesh, &setup, &fluid));
  PetscCall(PetscFree(setup.boundary));
  if (from)
    PetscCall(FluidLoad(fluid, row, from));
  else
    PetscCall(FluidSetInitial(fluid, 0.0, NULL, NULL, NULL));
  PetscCall(WriterCreate(c, fluid, from, &writer));
  for (int step = from ? 3 : 0; step < 5; step++) {
    if (step == 3 && !from) PetscCall(Save(fluid, writer));
    PetscCall(FluidStep(fluid, 0.01));
    PetscCall(WriterStep(writer, fluid));
  }
  PetscCall(WriterDestroy(&writer));
  PetscCall(FluidDestroy(&fluid));
  PetscFunctionReturn(0);
}

static void Run(CoracleCase c)
{
  CHECK(!RunState(c));
}

static void OnlyRead(CoracleCase c)
{
  FluidSetup setup;
  CHECK(!Read(c, &setup) && !PetscFree(setup.boundary));
}

/* 5 Pa above the hydrostatic pressure on the right side, which had none when the checkpoint was made. */
static PetscErrorCode PressureState(CoracleCase c)
{
  FluidSetup setup;
  Fluid fluid;
  int n = 0;
  PetscFunctionBeginUser;
  PetscCall(Read(c, &setup));
  PetscCall(FluidCreate(mesh, &setup, &fluid));
  PetscCall(PetscFree(setup.boundary));
  PetscCall(FluidLoad(fluid, row, from));
  for (int k = 0; k < 3 * mesh->ne; k++) {
    const double *x = mesh->x + 2 * mesh->vertex[k],
                 p = FluidPressure(fluid)[FluidPressureSpace(fluid)->node[k / 3 * 6 + k % 3]];
    if (x[0] < 1.0 - 1e-9) continue;
    CHECK(fabs(p - 5.0 - 9810.0 * (1.0 - x[1])) < 1e-9);
    n++;
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &n, 1, MPI_INT, MPI_SUM, PETSC_COMM_WORLD));
  CHECK(n >= 8); /* corners of the side's triangles */
  PetscCall(FluidDestroy(&fluid));
  PetscFunctionReturn(0);
}

static void CheckPressure(CoracleCase c)
{
  CHECK(!PressureState(c));
}

static PetscErrorCode Finish(void)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(row));
  PetscCall(MeshDestroy(&mesh));
  PetscFunctionReturn(0);
}

static void ReadFile(const char *name, char text[1 << 16])
{
  char path[512];
  snprintf(path, sizeof path, "%s/%s", output, name);
  FILE *file = fopen(path, "r");
  CHECK(file);
  text[fread(text, 1, (1 << 16) - 1, file)] = 0;
  fclose(file);
}

/* The times in the series and in the index of the snapshots; nothing is there twice, nothing is missing. */
static void CheckFiles(void)
{
  static char text[1 << 16];
  int rows = 0, snapshots = 0;
  double t;
  ReadFile("fluid.csv", text);
  for (const char *line = strchr(text, '\n'); line && line[1]; line = strchr(line + 1, '\n')) {
    CHECK(sscanf(line + 1, "%lf", &t) == 1 && fabs(t - 0.01 * ++rows) < 1e-12);
  }
  CHECK(rows == 5);
  ReadFile("fluid.velocity.xdmf", text);
  for (const char *time = text; (time = strstr(time, "<Time Value=\"")); time++) {
    CHECK(sscanf(time, "<Time Value=\"%lf", &t) == 1 && fabs(t - fmin(0.02 * snapshots++, 0.05)) < 1e-12);
  }
  CHECK(snapshots == 4);
}

static PetscErrorCode Resume(const char *const sets[], void (*f)(CoracleCase c), const char *expected)
{
  PetscFunctionBeginUser;
  PetscCall(CheckpointOpen(PETSC_COMM_WORLD, folder, "fluid", &from));
  CheckCase(CASE, sets, f, expected);
  PetscCall(CheckpointClose(&from));
  PetscCall(Finish());
  PetscFunctionReturn(0);
}

static PetscErrorCode CheckRefused(const char *set_folder)
{
  char expected[1024];
  const char *const misspelt[] = {set_folder, "fluid.mesh.groth=0.2", NULL};
  const char *const another[] = {set_folder, "fluid.boundaries.wall=no_slip", NULL};
  PetscFunctionBeginUser;
  PetscCall(Resume(misspelt, OnlyRead, "--set fluid.mesh.groth=0.2: unknown key 'fluid.mesh.groth'"));
  snprintf(expected, sizeof expected,
           ":10: key 'resume': expected a mesh with the 5 boundaries of fluid.boundaries (left, right, "
           "bottom, top, "
           "wall), found 4 (left, right, bottom, top) in %s/fluid.h5",
           folder);
  PetscCall(Resume(another, OnlyRead, expected));
  PetscFunctionReturn(0);
}

static PetscErrorCode Remove(void)
{
  static const char *const FILES[] = {"fluid.csv",
                                      "fluid_forces.csv",
                                      "fluid.h5",
                                      "fluid.xdmf",
                                      "fluid.velocity.xdmf",
                                      "fluid.pressure.xdmf",
                                      "checkpoint.3/fluid.h5",
                                      "checkpoint.3",
                                      ""};
  PetscFunctionBeginUser;
  for (int k = 0; k < (int)(sizeof FILES / sizeof *FILES); k++) {
    char path[512];
    snprintf(path, sizeof path, "%s/%s", output, FILES[k]);
    CHECK(!remove(path));
  }
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  char set_folder[512];
  const char *const sets[] = {set_folder, NULL};
  PetscMPIInt rank;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCallMPI(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  snprintf(output, sizeof output, "/tmp/coracle_resume_%d", (int)getpid());
  PetscCallMPI(MPI_Bcast(output, sizeof output, MPI_CHAR, 0, PETSC_COMM_WORLD));
  snprintf(folder, sizeof folder, "%s/checkpoint.3", output);
  snprintf(set_folder, sizeof set_folder, "output.folder=%s", output);
  if (rank == 0) PetscCall(PetscMkdir(output));
  if (rank == 0) PetscCall(PetscMkdir(folder));
  CheckCase(CASE, sets, Run, NULL);
  PetscCall(Finish());
  if (rank == 0) CheckFiles();
  PetscCall(Resume(sets, Run, NULL));
  if (rank == 0) CheckFiles();
  const char *const pressure[] = {set_folder, "fluid.boundaries.right={pressure: 5.0}", NULL};
  PetscCall(Resume(pressure, CheckPressure, NULL));
  PetscCall(CheckRefused(set_folder));
  PetscCallMPI(MPI_Barrier(PETSC_COMM_WORLD));
  if (rank == 0) PetscCall(Remove());
  PetscCall(PetscFinalize());
  return 0;
}
