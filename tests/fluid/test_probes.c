// ranks: 1 2 3
/* Probes give linear velocities and quadratic pressures exactly, in elements, on faces, vertices, walls and corners and
 * before a gauge on a solid, behind its face where that is not in the mesh, on the floor where contact has pushed
 * a corner through it; flows through segments across elements, along their faces and a
 * wall are exact; also on another mesh and after a checkpoint.  What lies outside of the mesh is refused. */
#include "fluid/input/fluid_case.h"
#include "fluid/output/probes.h"
#include "tests/fluid/box_mesh.h"
#include "tests/link/catch.h"

static const char *const CASE = "gravity: [0.0, 0.0]\n"
                                "time: {cfl: 0.5, dt_max: 0.01, end: 1.0}\n"
                                "fluid:\n"
                                "  density: 1.0\n"
                                "  viscosity: 1.0\n"
                                "  mesh: {lower: [0.0, 0.0], upper: [2.0, 1.0], size_max: 0.25}\n"
                                "  boundaries: {left: open, right: open, bottom: open, top: open}\n"
                                "  probes:\n"
                                "    - {name: inside, point: [0.813, 0.377]}\n"
                                "    - {name: before, solid_point: [0.5, 0.5], distance: 0.125}\n"
                                "    - {name: cut, line: {from: [0.0, 0.0], to: [2.0, 1.0], points: 9}}\n"
                                "    - {name: wall, point: [2.0, 0.61]}\n"
                                "    - {name: beneath, solid_point: [0.0, 0.5], distance: 0.5}\n"
                                "    - {name: outside, solid_point: [-1.0, 0.5], distance: 0.5}\n"
                                "    - {name: corner, solid_point: [1.5, 0.0], distance: 0.3}\n"
                                "    - {name: across, flow: {from: [0.313, 0.1], to: [1.77, 0.93]}}\n"
                                "    - {name: along, flow: {from: [1.0, 0.0], to: [1.0, 1.0]}}\n"
                                "    - {name: out, flow: {from: [2.0, 0.0], to: [2.0, 1.0]}}\n"
                                "output: {every: 1.0}\n";

enum { POINTS = 11, FLOWS = 1 + 3 * (POINTS + 4), COLUMNS = FLOWS + 3 };
static const CoracleGauge GAUGE[4] = {{{1.5, 0.5}, {0.6, -0.8}},
                                      {{0.0, 0.5}, {-1.0, 0.0}},
                                      {{-1.0, 0.5}, {-1.0, 0.0}},
                                      {{1.5, -0.01}, {1.0, 0.0}}};
static char folder[256];
static PetscMPIInt rank;

static void Velocity(void *context, double t, const double x[2], double u[])
{
  u[0] = 1.0 + 2.0 * x[0] - 3.0 * x[1];
  u[1] = 0.5 - x[0] - 2.0 * x[1];
}

static void Pressure(void *context, double t, const double x[2], double p[])
{
  p[0] = 1.0 + x[0] - 2.0 * x[1] + 3.0 * x[0] * x[0] - x[0] * x[1] + 0.5 * x[1] * x[1];
}

/* A fluid on a mesh of this size with the fields above; a row of the probes. */
static PetscErrorCode Row(CoracleCase c, Probes probes, double size)
{
  FluidSetup setup;
  Mesh *mesh;
  Fluid fluid;
  PetscFunctionBeginUser;
  PetscCall(BoxMesh(2.0, size, &mesh));
  PetscCall(FluidCaseSetup(c, mesh, &setup));
  PetscCall(FluidCreate(mesh, &setup, &fluid));
  PetscCall(FluidSetInitial(fluid, 0.0, Velocity, Pressure, NULL));
  PetscCall(ProbesNewMesh(probes, mesh));
  PetscCall(ProbesStep(probes, fluid, 4, GAUGE));
  PetscCall(PetscFree(setup.boundary));
  PetscCall(FluidDestroy(&fluid));
  PetscCall(MeshDestroy(&mesh));
  PetscFunctionReturn(0);
}

static PetscErrorCode Open(CoracleCase c, Checkpoint from, Probes *probes)
{
  static const char *const SECTIONS[] = {"fluid", NULL};
  AdaptationSetup adaptation;
  FluidSetup setup;
  PetscBool adapts;
  Mesh *mesh;
  PetscFunctionBeginUser;
  PetscCall(FluidCaseMesh(c, PETSC_COMM_WORLD, NULL, &mesh, NULL));
  PetscCall(FluidCaseSetup(c, mesh, &setup));
  PetscCall(PetscFree(setup.boundary));
  PetscCall(FluidCaseAdaptation(c, &setup, &adapts, &adaptation));
  PetscCall(ProbesCreate(c, mesh, probes));
  CHECK(!CoracleCaseFinish(c, SECTIONS));
  PetscCall(ProbesOpen(*probes, c, from));
  PetscCall(MeshDestroy(&mesh));
  PetscFunctionReturn(0);
}

/* A row, a checkpoint, a row on another mesh; then the last row again from the checkpoint. */
static PetscErrorCode RunState(CoracleCase c)
{
  char path[300];
  Checkpoint file;
  Probes probes;
  PetscFunctionBeginUser;
  snprintf(path, sizeof path, "%s/checkpoint", folder);
  PetscCall(Open(c, NULL, &probes));
  PetscCall(Row(c, probes, 0.25));
  if (rank == 0) PetscCall(PetscMkdir(path));
  PetscCall(CheckpointCreate(PETSC_COMM_WORLD, path, "fluid", &file));
  PetscCall(ProbesSave(probes, file));
  PetscCall(CheckpointClose(&file));
  PetscCall(Row(c, probes, 0.11));
  PetscCall(ProbesDestroy(&probes));
  PetscCall(CheckpointOpen(PETSC_COMM_WORLD, path, "fluid", &file));
  PetscCall(Open(c, file, &probes));
  PetscCall(CheckpointClose(&file));
  PetscCall(Row(c, probes, 0.11));
  PetscCall(ProbesDestroy(&probes));
  PetscFunctionReturn(0);
}

static void Run(CoracleCase c)
{
  CHECK(!RunState(c));
}

static void OnlyOpen(CoracleCase c)
{
  Probes probes;
  CHECK(!Open(c, NULL, &probes) && !ProbesDestroy(&probes));
}

/* u, v, p of a point of the fluid in three columns. */
static void CheckPoint(const double value[3], double x, double y)
{
  const double at[2] = {x, y};
  double exact[3];
  Velocity(NULL, 0.0, at, exact);
  Pressure(NULL, 0.0, at, exact + 2);
  for (int i = 0; i < 3; i++) CHECK(fabs(value[i] - exact[i]) < 1e-8);
}

/* The velocity is linear: the flow is that of the segment's middle. */
static void CheckFlow(double flow, double x0, double y0, double x1, double y1)
{
  const double middle[2] = {0.5 * (x0 + x1), 0.5 * (y0 + y1)};
  double u[2];
  Velocity(NULL, 0.0, middle, u);
  CHECK(fabs(flow - (u[0] * (y1 - y0) - u[1] * (x1 - x0))) < 1e-8);
}

static void CheckRow(const double value[COLUMNS])
{
  double p;
  const double before[2] = {1.5 + 0.125 * 0.6, 0.5 - 0.125 * 0.8}, behind[2] = {0.05 * 0.5, 0.5},
               corner[2] = {1.8, 0.0};
  Pressure(NULL, 0.0, before, &p);
  CheckPoint(value + 1, 0.813, 0.377);
  CHECK(value[4] == 1.5 && value[5] == 0.5 && fabs(value[6] - p) < 1e-8);
  for (int i = 0; i < 9; i++) CheckPoint(value + 7 + 3 * i, 0.25 * i, 0.125 * i);
  CheckPoint(value + 34, 2.0, 0.61);
  Pressure(NULL, 0.0, behind, &p);
  CHECK(value[37] == 0.0 && value[38] == 0.5 && fabs(value[39] - p) < 1e-8);
  CHECK(value[40] == -1.0 && value[41] == 0.5 && isnan(value[42]));
  Pressure(NULL, 0.0, corner, &p);
  CHECK(value[43] == 1.5 && value[44] == -0.01 && fabs(value[45] - p) < 1e-8);
  CheckFlow(value[FLOWS], 0.313, 0.1, 1.77, 0.93);
  CheckFlow(value[FLOWS + 1], 1.0, 0.0, 1.0, 1.0);
  CheckFlow(value[FLOWS + 2], 2.0, 0.0, 2.0, 1.0);
}

static void CheckFile(void)
{
  static char line[1 << 14];
  char path[300];
  int rows = 0;
  snprintf(path, sizeof path, "%s/fluid_probes.csv", folder);
  FILE *file = fopen(path, "r");
  CHECK(file && fgets(line, sizeof line, file));
  CHECK(strstr(line, "t [s],inside_u [m/s],inside_v [m/s],inside_p [Pa],before_x [m],before_y [m],before_p "
                     "[Pa],cut0_u [m/s],") == line);
  CHECK(strstr(line, ",cut8_p [Pa],wall_u [m/s],wall_v [m/s],wall_p [Pa],beneath_x [m],beneath_y "
                     "[m],beneath_p [Pa],outside_x [m],outside_y "
                     "[m],outside_p [Pa],corner_x [m],corner_y [m],corner_p [Pa],across_flow "
                     "[m2/s],along_flow [m2/s],out_flow [m2/s]\n"));
  while (fgets(line, sizeof line, file)) {
    double value[COLUMNS];
    char *at = line;
    for (int k = 0; k < COLUMNS; k++) value[k] = strtod(at, &at), at++;
    CHECK(at[-1] == '\n');
    CheckRow(value);
    rows++;
  }
  CHECK(rows == 2);
  fclose(file);
  CHECK(!remove(path));
}

static void CheckRefused(const char *set_folder)
{
  const struct {
    const char *set, *message;
  } fault[] = {{"fluid.probes[0].point=[2.01, 0.5]",
                "--set fluid.probes[0].point=[2.01, 0.5]: key 'fluid.probes[0].point': expected what lies "
                "in the mesh, (2.01, 0.5) does not; the mesh is in [0, 2] x [0, 1]"},
               {"fluid.probes[2].line.to=[2, 2]",
                ":11: key 'fluid.probes[2].line': expected what lies in the mesh, (1.25, 1.25) does not; the "
                "mesh is in [0, 2] x [0, 1]"},
               {"fluid.probes[3].name=inside",
                "--set fluid.probes[3].name=inside: key 'fluid.probes[3].name': fluid.probes[0] has the name "
                "'inside', too"},
               {"fluid.probes[3].solid_point=[0, 0]",
                ":12: key 'fluid.probes[3]': expected one of point, "
                "line, solid_point, solid_line, surface, phase, flow, found 2 of them"}};
  for (int k = 0; k < (int)(sizeof fault / sizeof *fault); k++)
    CheckCase(CASE, (const char *const[]){set_folder, fault[k].set, NULL}, OnlyOpen, fault[k].message);
}

int main(int argc, char **argv)
{
  char set_folder[300], path[300];
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCallMPI(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  snprintf(folder, sizeof folder, "/tmp/coracle_probes_%d", (int)getpid());
  PetscCallMPI(MPI_Bcast(folder, sizeof folder, MPI_CHAR, 0, PETSC_COMM_WORLD));
  snprintf(set_folder, sizeof set_folder, "output.folder=%s", folder);
  if (rank == 0) PetscCall(PetscMkdir(folder));
  PetscCallMPI(MPI_Barrier(PETSC_COMM_WORLD));
  CheckCase(CASE, (const char *const[]){set_folder, NULL}, Run, NULL);
  if (rank == 0) CheckFile();
  CheckRefused(set_folder);
  PetscCallMPI(MPI_Barrier(PETSC_COMM_WORLD));
  for (int k = 0; rank == 0 && k < 3; k++) {
    snprintf(path, sizeof path, "%s%s", folder,
             k == 0   ? "/checkpoint/fluid.h5"
             : k == 1 ? "/checkpoint"
                      : "");
    CHECK(!remove(path));
  }
  PetscCall(PetscFinalize());
  return 0;
}
