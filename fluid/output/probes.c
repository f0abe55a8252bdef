#include "fluid/output/probes.h"
#include "common/output/output.h"
#include "common/program/run_case.h"
#include "fluid/input/probe_case.h"
#include "fluid/output/flow_gauge.h"
#include "fluid/output/locate.h"
#include "fluid/output/phase_gauge.h"
#include "fluid/output/place_values.h"
#include "fluid/output/solid_gauge.h"
#include "fluid/output/surface_gauge.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The numbers of a gauge or a surface, of a phase, of a force and its moment. */
enum { FOLLOWING = 3, WHOLE = 6, FORCE = 3, COLUMN_LENGTH = SERIES_NAME_MAX + 24 };

struct Probes_s {
  MPI_Comm comm;
  ProbeCase list;
  Places fixed, moving;
  Series series;
};

/* --- values --------------------------------------------------------------------------------------------- */

/* The numbers of a point in a row. */
static int Width(const Probes p, const Probe *probe)
{
  if (probe->kind == PROBE_PHASE) return WHOLE;
  if (probe->kind == PROBE_FLOW) return 1;
  return probe->kind == PROBE_POINT || probe->kind == PROBE_LINE ? 3 + (p->list.nphases > 0) : FOLLOWING;
}

static PetscErrorCode SurfaceValues(const Probe *probe, Fluid fluid, double value[FOLLOWING])
{
  SurfacePlace place;
  PetscFunctionBeginUser;
  PetscCall(SurfaceMeasure(PhaseTransportPhases(FluidPhases(fluid)), FluidMesh(fluid), probe->phase,
                           probe->from, probe->to, &place));
  value[0] = place.first;
  value[1] = place.last;
  value[2] = place.length;
  PetscFunctionReturn(0);
}

static PetscErrorCode PhaseValues(const Probe *probe, Fluid fluid, double value[WHOLE])
{
  PhaseMeasure measure;
  PetscFunctionBeginUser;
  PetscCall(PhaseMeasureOf(fluid, probe->phase, &measure));
  value[0] = measure.area;
  for (int c = 0; c < 2; c++) {
    value[1 + c] = measure.centre[c];
    value[3 + c] = measure.velocity[c];
  }
  value[5] = measure.interface;
  PetscFunctionReturn(0);
}

static void GaugeValues(const Probe *probe, const CoracleGauge gauge[], const GaugeReading reading[],
                        double row[])
{
  const GaugeReading *of = reading + probe->first;
  for (int i = 0; i < probe->n; i++, row += FOLLOWING) {
    row[0] = of[i].x[0];
    row[1] = of[i].x[1];
    row[2] = of[i].pressure;
  }
  if (probe->kind == PROBE_FACE) SolidGaugeForce(probe->n, gauge + probe->first, of, row);
}

/* The numbers of a probe in a row; fixed: the values at the fixed points. */
static PetscErrorCode ProbeValues(Probes p, const Probe *probe, Fluid fluid, const CoracleGauge gauge[],
                                  const GaugeReading reading[], const double fixed[][PLACE_VALUES],
                                  double row[])
{
  PetscFunctionBeginUser;
  switch (probe->kind) {
  case PROBE_SURFACE:
    PetscCall(SurfaceValues(probe, fluid, row));
    break;
  case PROBE_FLOW:
    PetscCall(FlowMeasure(fluid, probe->phase, probe->from, probe->to, row));
    break;
  case PROBE_PHASE:
    PetscCall(PhaseValues(probe, fluid, row));
    break;
  case PROBE_GAUGE:
  case PROBE_FACE:
    GaugeValues(probe, gauge, reading, row);
    break;
  case PROBE_POINT:
  case PROBE_LINE:
    for (int i = 0; i < probe->n; i++)
      PetscCall(PetscArraycpy(row + i * Width(p, probe), fixed[probe->first + i], (size_t)Width(p, probe)));
  }
  PetscFunctionReturn(0);
}

PetscErrorCode ProbesStep(Probes p, Fluid fluid, int n, const CoracleGauge gauge[])
{
  double fixed[PROBE_POINTS_MAX][PLACE_VALUES],
      row[1 + PLACE_VALUES * PROBE_POINTS_MAX + FOLLOWING * CASE_GAUGES_MAX + WHOLE * PROBES_MAX];
  GaugeReading reading[CASE_GAUGES_MAX];
  double *next = row;
  PetscFunctionBeginUser;
  if (!p) PetscFunctionReturn(0);
  PetscCheck(n == p->list.ngauges, p->comm, PETSC_ERR_PLIB,
             "the coupler gives %d gauges on the solid, the case has %d", n, p->list.ngauges);
  PetscCall(PlacesValues(&p->fixed, fluid, fixed));
  if (n) PetscCall(SolidGaugeRead(&p->list, fluid, gauge, &p->moving, reading));
  *next++ = FluidGetStats(fluid)->t;
  for (int k = 0; k < p->list.n; k++) {
    const Probe *probe = &p->list.probe[k];
    PetscCall(ProbeValues(p, probe, fluid, gauge, reading, (const double(*)[PLACE_VALUES])fixed, next));
    next += probe->n * Width(p, probe) + (probe->kind == PROBE_FACE ? FORCE : 0);
  }
  PetscCall(SeriesRow(p->series, row));
  PetscFunctionReturn(0);
}

/* --- columns -------------------------------------------------------------------------------------------- */

/* The columns of point i of a probe. */
static void AddColumns(const Probes p, const Probe *probe, int i, char **end)
{
  static const char *const FLOW[] = {"u [m/s]", "v [m/s]", "p [Pa]", "rho [kg/m3]"},
                           *const GAUGE[] = {"x [m]", "y [m]", "p [Pa]"},
                           *const SURFACE[] = {"first [m]", "last [m]", "length [m]"},
                           *const PHASE[] = {"area [m2]", "x [m]",   "y [m]",
                                             "u [m/s]",   "v [m/s]", "interface [m]"},
                           *const THROUGH[] = {"flow [m2/s]"};
  static const char *const *const COLUMNS[] = {FLOW, FLOW, GAUGE, GAUGE, SURFACE, PHASE, THROUGH};
  char number[16] = "";
  if (probe->kind == PROBE_LINE || probe->kind == PROBE_FACE) (void)snprintf(number, sizeof number, "%d", i);
  for (int k = 0; k < Width(p, probe); k++)
    *end += snprintf(*end, COLUMN_LENGTH, ",%s%s_%s", probe->name, number, COLUMNS[probe->kind][k]);
}

static void AddForce(const Probe *probe, char **end)
{
  static const char *const COLUMNS[FORCE] = {"force_x [N/m]", "force_y [N/m]", "moment [N]"};
  for (int k = 0; k < FORCE; k++) *end += snprintf(*end, COLUMN_LENGTH, ",%s_%s", probe->name, COLUMNS[k]);
}

/* *columns of fluid_probes.csv is allocated. */
static PetscErrorCode SetColumns(Probes p, char **columns)
{
  const size_t most = 1 + WHOLE * (size_t)(p->list.nfixed + p->list.ngauges + p->list.n);
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(COLUMN_LENGTH * most, columns));
  char *end = *columns + sprintf(*columns, "t [s]");
  for (int k = 0; k < p->list.n; k++) {
    for (int i = 0; i < p->list.probe[k].n; i++) AddColumns(p, &p->list.probe[k], i, &end);
    if (p->list.probe[k].kind == PROBE_FACE) AddForce(&p->list.probe[k], &end);
  }
  PetscFunctionReturn(0);
}

static int CompareNames(const void *a, const void *b)
{
  return strcmp(*(char *const *)a, *(char *const *)b);
}

/* Point 1 of a line "a" has the columns of a point "a1". */
static PetscErrorCode CheckColumns(Probes p, CoracleCase c)
{
  char *columns, **name;
  int n = 0;
  PetscFunctionBeginUser;
  PetscCall(SetColumns(p, &columns));
  PetscCall(PetscMalloc1(strlen(columns), &name));
  for (char *at = strtok(columns, ","); at; at = strtok(NULL, ",")) name[n++] = at;
  qsort(name, (size_t)n, sizeof *name, CompareNames);
  for (int k = 1; k < n; k++)
    if (!strcmp(name[k - 1], name[k]))
      CoracleCaseRefuse(
          c, "fluid.probes",
          "two columns are called '%s': expected names that differ by more than a point's number", name[k]);
  PetscCall(PetscFree(name));
  PetscCall(PetscFree(columns));
  PetscFunctionReturn(0);
}

/* --- start, checkpoints, end ---------------------------------------------------------------------------- */

PetscErrorCode ProbesNewMesh(Probes p, const Mesh *mesh)
{
  PetscFunctionBeginUser;
  if (p) PetscCall(PlacesLocate(mesh, p->list.nfixed, (const double(*)[2])p->list.fixed, &p->fixed));
  PetscFunctionReturn(0);
}

static void Refuse(Probes p, CoracleCase c, const Mesh *m, int k, const double x[2])
{
  CoracleCaseRefuse(c, ProbeCaseKey(&p->list, k),
                    "expected what lies in the mesh, (%g, %g) does not; the mesh is in [%g, %g] x [%g, %g]",
                    x[0], x[1], m->lower[0], m->upper[0], m->lower[1], m->upper[1]);
}

/* A probe with a point outside of the mesh is an error of the case; of a surface or a flow, with an end out of its bounds. */
static void Check(Probes p, CoracleCase c, const Mesh *m)
{
  for (int k = 0; k < p->list.n; k++) {
    const Probe *probe = &p->list.probe[k];
    const PetscBool segment = (PetscBool)(probe->kind == PROBE_SURFACE || probe->kind == PROBE_FLOW);
    if (segment && !LocateInBounds(m, probe->from)) Refuse(p, c, m, k, probe->from);
    if (segment && !LocateInBounds(m, probe->to)) Refuse(p, c, m, k, probe->to);
    for (int i = 0; (probe->kind == PROBE_POINT || probe->kind == PROBE_LINE) && i < probe->n; i++)
      if (p->fixed.outside[probe->first + i] > 0.0) Refuse(p, c, m, k, p->list.fixed[probe->first + i]);
  }
}

PetscErrorCode ProbesCreate(CoracleCase c, const Mesh *mesh, Probes *probes)
{
  Probes p;
  PetscFunctionBeginUser;
  *probes = NULL;
  PetscCall(PetscNew(&p));
  ProbeCaseRead(c, &p->list);
  p->comm = mesh->comm;
  PetscCall(ProbesNewMesh(p, mesh));
  Check(p, c, mesh);
  PetscCall(CheckColumns(p, c));
  if (p->list.n)
    *probes = p;
  else
    PetscCall(ProbesDestroy(&p));
  PetscFunctionReturn(0);
}

PetscErrorCode ProbesOpen(Probes p, CoracleCase c, Checkpoint from)
{
  RunCase run;
  char *columns;
  PetscFunctionBeginUser;
  if (!p) PetscFunctionReturn(0);
  RunCaseRead(c, &run);
  PetscCall(SetColumns(p, &columns));
  PetscCall(SeriesCreate(p->comm, run.folder, "fluid_probes", columns, run.series_every, from, &p->series));
  PetscCall(PetscFree(columns));
  PetscFunctionReturn(0);
}

PetscErrorCode ProbesSave(Probes p, Checkpoint to)
{
  PetscFunctionBeginUser;
  if (p) PetscCall(SeriesSave(p->series, to));
  PetscFunctionReturn(0);
}

PetscErrorCode ProbesDestroy(Probes *p)
{
  PetscFunctionBeginUser;
  if (!*p) PetscFunctionReturn(0);
  PetscCall(SeriesDestroy(&(*p)->series));
  PetscCall(PlacesFree(&(*p)->fixed));
  PetscCall(PlacesFree(&(*p)->moving));
  PetscCall(PetscFree(*p));
  PetscFunctionReturn(0);
}
