#include "fluid/output/writer.h"
#include "common/link/coracle.h"
#include "common/output/output.h"
#include "common/program/run_case.h"
#include "fluid/flow/budget.h"
#include "fluid/output/force_series.h"

#define COLUMNS                                                                                              \
  "t [s],dt [s],max speed [m/s],momentum x [kg/s],momentum y [kg/s],momentum defect,"                        \
  "kinetic energy [J/m],momentum "                                                                           \
  "iterations,"                                                                                              \
  "pressure iterations,assembly [s],momentum [s],pressure [s],coupling [s],adaptation [s],setup "            \
  "[s],triangles,largest part"

struct Writer_s {
  Output output;
  Series series;
  ForceSeries forces;
  int revision;            /* of the mesh */
  double longest;          /* step so far, s */
  PetscBool has_shortened; /* NoteShortSteps has said so */
};

/* Points, cells and scratch of the two grids of a snapshot. */
typedef struct {
  int *corner, *quadratic;   /* [ne][3], [ne][6] */
  double *x_corner, *x_node; /* [ne][3][2], [n][2] */
  double *nodal, *cell;      /* [3 ne][2], [ne] */
} Grids;

/* Points and cells of the two grids: discontinuous triangles for P1DG, six-node triangles for P2. */
static void BuildGrids(Grids *r, const Mesh *m, const P2Space *p2)
{
  static const int VTK[6] = {0, 1, 2, 5, 3, 4}; /* midpoints of 01, 12, 20 lie opposite to vertices 2, 0, 1 */
  for (int e = 0; e < m->ne; e++) {
    for (int i = 0; i < 3; i++) r->corner[3 * e + i] = 3 * e + i;
    for (int i = 0; i < 6; i++) {
      const int node = p2->node[6 * e + VTK[i]], q = VTK[i];
      const int a = m->vertex[3 * e + (q < 3 ? q : (q + 1) % 3)],
                b = m->vertex[3 * e + (q < 3 ? q : (q + 2) % 3)];
      r->quadratic[6 * e + i] = node;
      for (int c = 0; c < 2; c++) {
        r->x_node[2 * node + c] = 0.5 * (m->x[2 * a + c] + m->x[2 * b + c]);
        if (q < 3) r->x_corner[6 * e + 2 * q + c] = m->x[2 * a + c];
      }
    }
  }
}

/* Density, and the fraction of each phase; cell[ne]: scratch. */
static PetscErrorCode PhaseFields(Writer r, Fluid f, double cell[])
{
  int n;
  const double *volume = PhaseTransportVolumes(FluidPhases(f), &n);
  const Mesh *m = FluidMesh(f);
  PetscFunctionBeginUser;
  PetscCall(OutputField(r->output, "density", OUTPUT_CELL, 1, FluidDensity(f)));
  for (int p = 0; p < n; p++) {
    for (int e = 0; e < m->ne; e++) {
      double all = 0.0;
      for (int q = 0; q < n; q++) all += volume[n * e + q];
      cell[e] = volume[n * e + p] / all;
    }
    PetscCall(
        OutputField(r->output, PhaseTransportProperties(FluidPhases(f))->name[p], OUTPUT_CELL, 1, cell));
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode Snapshot(Writer r, Fluid f)
{
  const Mesh *m = FluidMesh(f);
  const P2Space *p2 = FluidPressureSpace(f);
  const double *u = FluidVelocity(f);
  PetscMPIInt rank;
  Grids g;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc6(3 * m->ne, &g.corner, 6 * m->ne, &g.quadratic, 6 * m->ne, &g.x_corner, 2 * p2->n,
                         &g.x_node, 6 * m->ne, &g.nodal, m->ne, &g.cell));
  BuildGrids(&g, m, p2);
  PetscCallMPI(MPI_Comm_rank(m->comm, &rank));
  PetscCall(OutputBegin(r->output, FluidGetStats(f)->t));
  PetscCall(OutputGrid(r->output, "velocity", r->revision, 3 * m->ne, g.x_corner, m->ne, 3, g.corner));
  for (int e = 0; e < m->ne; e++)
    for (int i = 0; i < 3; i++)
      for (int c = 0; c < 2; c++) g.nodal[2 * (3 * e + i) + c] = u[6 * e + 3 * c + i];
  PetscCall(OutputField(r->output, "velocity", OUTPUT_NODE, 2, g.nodal));
  PetscCall(OutputField(r->output, "alpha", OUTPUT_CELL, 1, FluidSolidFraction(f)));
  if (FluidPhases(f)) PetscCall(PhaseFields(r, f, g.cell));
  for (int e = 0; e < m->ne; e++) g.cell[e] = rank;
  PetscCall(OutputField(r->output, "rank", OUTPUT_CELL, 1, g.cell));
  PetscCall(OutputGrid(r->output, "pressure", r->revision, p2->n, g.x_node, m->ne, 6, g.quadratic));
  PetscCall(OutputField(r->output, "pressure", OUTPUT_NODE, 1, FluidPressure(f)));
  PetscCall(OutputEnd(r->output));
  PetscCall(PetscFree6(g.corner, g.quadratic, g.x_corner, g.x_node, g.nodal, g.cell));
  PetscFunctionReturn(0);
}

enum { NCOLUMNS = 17, ROW_MAX = NCOLUMNS + 2 + 3 * PHASES_MAX };

/* columns[size]: COLUMNS, and with phases their potential energy, three of each, and the gap. */
static PetscErrorCode SetColumns(Fluid f, size_t size, char columns[])
{
  const PhaseProperties *phases = FluidPhases(f) ? PhaseTransportProperties(FluidPhases(f)) : NULL;
  PetscFunctionBeginUser;
  PetscCall(PetscStrncpy(columns, COLUMNS, size));
  if (phases) PetscCall(PetscStrlcat(columns, ",potential energy [J/m]", size));
  for (int p = 0; phases && p < phases->n; p++) {
    char more[160];
    const char *name = phases->name[p];
    const char *unit = phases->state[p].pressure > 0.0 ? "kg" : "m2";
    PetscCall(PetscSNPrintf(more, sizeof more, ",%s [%s],%s out [%s],%s made [%s]", name, unit, name, unit,
                            name, unit));
    PetscCall(PetscStrlcat(columns, more, size));
  }
  if (phases) PetscCall(PetscStrlcat(columns, ",volume gap [m2]", size));
  PetscFunctionReturn(0);
}

/* row[2 + 3 n]: potential energy; how much there is of each phase, how much has left, and what is more than there should be; by how
 * much all of them together miss the elements' areas. */
static PetscErrorCode AddPhases(Fluid f, double row[])
{
  PhaseBudget b;
  PetscFunctionBeginUser;
  if (!FluidPhases(f)) PetscFunctionReturn(0);
  PetscCall(PhaseTransportBudget(FluidPhases(f), &b));
  PetscCall(FluidPotentialEnergy(f, row++));
  for (int p = 0; p < PhaseTransportProperties(FluidPhases(f))->n; p++) {
    row[3 * p] = b.volume[p];
    row[3 * p + 1] = b.out[p];
    row[3 * p + 2] = b.volume[p] + b.out[p] - b.initial[p];
  }
  row[3 * PhaseTransportProperties(FluidPhases(f))->n] = b.gap;
  PetscFunctionReturn(0);
}

PetscErrorCode WriterCreate(CoracleCase c, Fluid f, Checkpoint from, Writer *writer)
{
  const Mesh *m = FluidMesh(f);
  RunCase run;
  char columns[2048];
  Writer r;
  PetscFunctionBeginUser;
  PetscCall(PetscNew(&r));
  RunCaseRead(c, &run);
  PetscCall(OutputCreate(m->comm, run.folder, "fluid", run.every, run.end, from, &r->output));
  PetscCall(OutputText(r->output, "case", CoracleCaseStringOr(c, "case", "")));
  PetscCall(OutputText(r->output, "version", CORACLE_VERSION));
  PetscCall(SetColumns(f, sizeof columns, columns));
  PetscCall(SeriesCreate(m->comm, run.folder, "fluid", columns, run.series_every, from, &r->series));
  PetscCall(ForceSeriesCreate(&run, f, from, &r->forces));
  if (!from) PetscCall(Snapshot(r, f));
  *writer = r;
  PetscFunctionReturn(0);
}

PetscErrorCode WriterSave(Writer r, Checkpoint to)
{
  PetscFunctionBeginUser;
  PetscCall(OutputSave(r->output, to));
  PetscCall(SeriesSave(r->series, to));
  PetscCall(ForceSeriesSave(r->forces, to));
  PetscFunctionReturn(0);
}

/* Of the longest step: where the flow makes steps shorter than that, something may be wrong with it. */
#define SHORT 1e-3

/* rate: the most of all ranks that the CFL condition asks for, 1/s.  Said once a run. */
static void NoteShortSteps(Writer r, Fluid f, double rate)
{
  const FluidStats *s = FluidGetStats(f);
  r->longest = fmax(r->longest, s->dt);
  if (r->has_shortened || !(rate * SHORT * r->longest > 1.0)) return;
  r->has_shortened = PETSC_TRUE;
  if (s->cfl_rate == rate)
    printf("coracle: note: at t = %g s the flow at (%g, %g), %g m/s, makes steps as short as %.2g s; the "
           "longest "
           "so far was of %g s\n",
           s->t, s->cfl_centre[0], s->cfl_centre[1], s->cfl_speed, 1.0 / rate, r->longest);
}

PetscErrorCode WriterStep(Writer r, Fluid f)
{
  const FluidStats *s = FluidGetStats(f);
  const Mesh *m = FluidMesh(f);
  const FluidBudget *budget = FluidGetBudget(f);
  PetscMPIInt size;
  double most[3] = {m->ne, s->max_speed, s->cfl_rate}; /* of all ranks */
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_size(m->comm, &size));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, most, 3, MPI_DOUBLE, MPI_MAX, m->comm));
  NoteShortSteps(r, f, most[2]);
  double row[ROW_MAX] = {s->t,
                         s->dt,
                         most[1],
                         budget->momentum[0],
                         budget->momentum[1],
                         BudgetDefect(budget),
                         budget->energy,
                         s->momentum_iterations,
                         s->pressure_iterations,
                         s->seconds[0],
                         s->seconds[1],
                         s->seconds[2],
                         s->seconds[3],
                         s->seconds[4],
                         s->seconds[5],
                         m->nglobal,
                         most[0] * size / m->nglobal};
  PetscCall(AddPhases(f, row + NCOLUMNS));
  PetscCall(SeriesRow(r->series, row));
  PetscCall(ForceSeriesStep(r->forces, f));
  if (OutputDue(r->output, s->t)) PetscCall(Snapshot(r, f));
  PetscFunctionReturn(0);
}

void WriterNewMesh(Writer r)
{
  r->revision++;
}

PetscErrorCode WriterDestroy(Writer *r)
{
  PetscFunctionBeginUser;
  if (!*r) PetscFunctionReturn(0);
  PetscCall(OutputDestroy(&(*r)->output));
  PetscCall(SeriesDestroy(&(*r)->series));
  PetscCall(ForceSeriesDestroy(&(*r)->forces));
  PetscCall(PetscFree(*r));
  PetscFunctionReturn(0);
}
