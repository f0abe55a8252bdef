#include "fluid/output/probes.h"
#include "common/output/output.h"
#include "common/space/p2.h"
#include "fluid/input/probe_case.h"
#include "fluid/output/flow_gauge.h"
#include "fluid/output/locate.h"
#include "fluid/output/phase_gauge.h"
#include "fluid/output/surface_gauge.h"
#include <stdio.h>

/* The numbers of a point (u, v, p, rho), of a gauge or a surface, of a phase. */
enum { VALUES = 4, FOLLOWING = 3, WHOLE = 6, COLUMN_LENGTH = SERIES_NAME_MAX + 24 };
/* Of an element: a gauge's place in it is not in the fluid. */
#define MOSTLY_SOLID 0.9

struct Probes_s {
  MPI_Comm comm;
  ProbeCase list;
  Places fixed, moving;
  Series series;
};

/* --- values --------------------------------------------------------------------------------------------- */

/* value[npoints][VALUES] at the places, on all ranks; nan outside of the mesh. */
static PetscErrorCode Values(const Places *places, Fluid fluid, double value[][VALUES])
{
  const Mesh *m = FluidMesh(fluid);
  const double *u = FluidVelocity(fluid), *p = FluidPressure(fluid), *rho = FluidDensity(fluid);
  const int *node = FluidPressureSpace(fluid)->node;
  PetscFunctionBeginUser;
  PetscCall(PetscArrayzero(&value[0][0], VALUES * (size_t)places->npoints));
  for (int k = 0; k < places->n; k++) {
    const Place *at = &places->place[k];
    double nodal[6], *sum = value[at->point];
    for (int i = 0; i < 6; i++) nodal[i] = p[node[6 * at->element + i]];
    for (int c = 0; c < 2; c++)
      for (int i = 0; i < 3; i++) sum[c] += at->share * at->n[i] * u[6 * at->element + 3 * c + i];
    sum[2] += at->share * P2Evaluate(nodal, at->n);
    sum[3] += at->share * rho[at->element];
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, value, VALUES * places->npoints, MPI_DOUBLE, MPI_SUM, m->comm));
  for (int k = 0; k < places->npoints; k++)
    for (int i = 0; i < VALUES && places->outside[k] > 0.0; i++) value[k][i] = NAN;
  PetscFunctionReturn(0);
}

/* x[ngauges][2]: before each gauge, or behind its face, of those alone that are blocked where that is given; one that is out of
 * the mesh's bounds by no more than contact needs, as at the corner of a body that stands on the floor, is put on them. */
static void GaugePoints(const Probes p, const Mesh *m, const CoracleGauge gauge[], PetscBool before,
                        const double blocked[], double x[][2])
{
  for (int k = 0; k < p->list.n; k++) {
    const Probe *probe = &p->list.probe[k];
    if (probe->kind != PROBE_GAUGE || (blocked && blocked[probe->first] == 0.0)) continue;
    const CoracleGauge *g = &gauge[probe->first];
    for (int c = 0; c < 2; c++) {
      const double at = g->x[c] + (before ? probe->distance : -probe->behind) * g->normal[c],
                   inside = fmin(fmax(at, m->lower[c]), m->upper[c]);
      x[probe->first][c] = fabs(at - inside) <= probe->behind ? inside : at;
    }
  }
}

/* blocked[n]: whether a place is outside of the mesh, or a solid has most of its element; *any becomes 1 if one is. */
static PetscErrorCode Blocked(const Places *places, Fluid fluid, double blocked[], int *any)
{
  const double *alpha = FluidSolidFraction(fluid);
  PetscFunctionBeginUser;
  PetscCall(PetscArrayzero(blocked, places->npoints));
  for (int k = 0; k < places->n; k++)
    blocked[places->place[k].point] += alpha[places->place[k].element] > MOSTLY_SOLID;
  PetscCallMPI(
      MPI_Allreduce(MPI_IN_PLACE, blocked, places->npoints, MPI_DOUBLE, MPI_SUM, FluidMesh(fluid)->comm));
  for (int k = 0; k < places->npoints; k++) {
    blocked[k] += places->outside[k];
    *any |= blocked[k] > 0.0;
  }
  PetscFunctionReturn(0);
}

/* The pressure before each gauge, at value[n][2]; where a floor or another solid is, behind its face. */
static PetscErrorCode GaugeValues(Probes p, Fluid fluid, const CoracleGauge gauge[], double value[][VALUES])
{
  const int n = p->list.ngauges;
  double x[PROBES_MAX][2], blocked[PROBES_MAX];
  int any = 0;
  PetscFunctionBeginUser;
  GaugePoints(p, FluidMesh(fluid), gauge, PETSC_TRUE, NULL, x);
  PetscCall(PlacesLocate(FluidMesh(fluid), n, (const double(*)[2])x, &p->moving));
  PetscCall(Blocked(&p->moving, fluid, blocked, &any));
  if (any) {
    GaugePoints(p, FluidMesh(fluid), gauge, PETSC_FALSE, blocked, x);
    PetscCall(PlacesLocate(FluidMesh(fluid), n, (const double(*)[2])x, &p->moving));
  }
  PetscCall(Values(&p->moving, fluid, value));
  PetscFunctionReturn(0);
}

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

/* The numbers of a probe in a row: fixed and moving are the values at the fixed points and before the gauges. */
static PetscErrorCode ProbeValues(Probes p, const Probe *probe, Fluid fluid, const CoracleGauge gauge[],
                                  const double fixed[][VALUES], const double moving[][VALUES], double row[])
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
    PetscCall(PetscArraycpy(row, gauge[probe->first].x, 2));
    row[2] = moving[probe->first][2];
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
  double fixed[PROBE_POINTS_MAX][VALUES], moving[PROBES_MAX][VALUES],
      row[1 + VALUES * PROBE_POINTS_MAX + WHOLE * PROBES_MAX];
  double *next = row;
  PetscFunctionBeginUser;
  if (!p) PetscFunctionReturn(0);
  PetscCheck(n == p->list.ngauges, p->comm, PETSC_ERR_PLIB,
             "the coupler gives %d gauges on the solid, the case has %d", n, p->list.ngauges);
  PetscCall(Values(&p->fixed, fluid, fixed));
  if (n) PetscCall(GaugeValues(p, fluid, gauge, moving));
  *next++ = FluidGetStats(fluid)->t;
  for (int k = 0; k < p->list.n; k++) {
    const Probe *probe = &p->list.probe[k];
    PetscCall(ProbeValues(p, probe, fluid, gauge, (const double(*)[VALUES])fixed,
                          (const double(*)[VALUES])moving, next));
    next += probe->n * Width(p, probe);
  }
  PetscCall(SeriesRow(p->series, row));
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
  if (p->list.n)
    *probes = p;
  else
    PetscCall(ProbesDestroy(&p));
  PetscFunctionReturn(0);
}

/* The columns of point i of a probe. */
static void AddColumns(const Probes p, const Probe *probe, int i, char **end)
{
  static const char *const FLOW[] = {"u [m/s]", "v [m/s]", "p [Pa]", "rho [kg/m3]"},
                           *const GAUGE[] = {"x [m]", "y [m]", "p [Pa]"},
                           *const SURFACE[] = {"first [m]", "last [m]", "length [m]"},
                           *const PHASE[] = {"area [m2]", "x [m]",   "y [m]",
                                             "u [m/s]",   "v [m/s]", "interface [m]"},
                           *const THROUGH[] = {"flow [m2/s]"};
  static const char *const *const COLUMNS[] = {FLOW, FLOW, GAUGE, SURFACE, PHASE, THROUGH};
  char number[16] = "";
  if (probe->kind == PROBE_LINE) (void)snprintf(number, sizeof number, "%d", i);
  for (int k = 0; k < Width(p, probe); k++)
    *end += snprintf(*end, COLUMN_LENGTH, ",%s%s_%s", probe->name, number, COLUMNS[probe->kind][k]);
}

PetscErrorCode ProbesOpen(Probes p, CoracleCase c, Checkpoint from)
{
  char *columns, *end;
  PetscFunctionBeginUser;
  if (!p) PetscFunctionReturn(0);
  PetscCall(PetscMalloc1(COLUMN_LENGTH * (1 + WHOLE * (size_t)(p->list.nfixed + p->list.n)), &columns));
  end = columns + sprintf(columns, "t [s]");
  for (int k = 0; k < p->list.n; k++)
    for (int i = 0; i < p->list.probe[k].n; i++) AddColumns(p, &p->list.probe[k], i, &end);
  PetscCall(SeriesCreate(p->comm, CoracleCaseString(c, "output.folder"), "fluid_probes", columns, from,
                         &p->series));
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
