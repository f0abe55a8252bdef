#include "coupler/geometry/gauges.h"
#include "common/supermesh/geometry.h"
#include <limits.h>
#include <math.h>

#define SAME 1e-12 /* part of a facet's length: a distance that counts as equal */

typedef struct {
  long long end[2]; /* ids of the facet's nodes */
  double s;
  int facet; /* of this rank, where it was found last */
} Anchor;

struct Gauges_s {
  MPI_Comm comm;
  int n;
  Anchor anchor[CASE_GAUGES_MAX];
  CoracleGauge gauge[CASE_GAUGES_MAX];
};

void GaugesReadCase(CoracleCase file, GaugesCase *c)
{
  double point[CASE_GAUGES_MAX][2];
  c->n = 0;
  c->path = CoracleCasePath(file);
  for (int k = 0; k < CoracleCaseCount(file, "fluid.probes"); k++) {
    const int n = CaseGauges(file, k, point);
    if (c->n + n > CASE_GAUGES_MAX)
      CoracleCaseRefuse(file, CaseGaugeKey(file, k), "more than %d gauges on solids", CASE_GAUGES_MAX);
    for (int i = 0; i < n; i++) {
      memcpy(c->point[c->n], point[i], sizeof point[i]);
      c->probe[c->n++] = k;
    }
  }
}

/* --- the facet that holds a gauge ----------------------------------------------------------------------- */

static const double *End(const SolidState *solid, int facet, int i)
{
  return solid->x + 2 * solid->facet[2 * facet + i];
}

/* The place on the facet that is nearest to the point, its distance and the facet's length. */
static double Nearest(const SolidState *solid, int facet, const double point[2], double *s, double *length)
{
  const double *a = End(solid, facet, 0), *b = End(solid, facet, 1);
  *s = GeometrySegmentPlace(a, b, point);
  *length = hypot(b[0] - a[0], b[1] - a[1]);
  return GeometryDistanceAt(a, b, *s, point);
}

/* Collective: the nearest facet on all ranks, of equally near ones that with the smallest id of its first node. */
static PetscErrorCode Hold(MPI_Comm comm, const SolidState *solid, const double point[2], Anchor *anchor,
                           double *distance, double *length)
{
  double nearest = HUGE_VAL, found[2] = {0.0};
  long long end[2] = {LLONG_MAX, 0};

  PetscFunctionBeginUser;
  for (int f = 0; f < solid->nfacets; f++)
    nearest = fmin(nearest, Nearest(solid, f, point, found, found + 1));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &nearest, 1, MPI_DOUBLE, MPI_MIN, comm));
  *anchor = (Anchor){.facet = -1};
  found[0] = found[1] = 0.0;
  for (int f = 0; f < solid->nfacets; f++) {
    double s, l;
    const double d = Nearest(solid, f, point, &s, &l);
    const long long first = solid->gid[solid->facet[2 * f]];
    if (d > nearest + SAME * l || first >= end[0]) continue;
    end[0] = first;
    end[1] = solid->gid[solid->facet[2 * f + 1]];
    found[0] = s;
    found[1] = l;
    anchor->facet = f;
  }
  anchor->end[0] = end[0];
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &anchor->end[0], 1, MPI_LONG_LONG, MPI_MIN, comm));
  if (anchor->facet < 0 || anchor->end[0] != end[0]) {
    end[1] = LLONG_MIN;
    found[0] = found[1] = -1.0;
    anchor->facet = -1;
  }
  PetscCallMPI(MPI_Allreduce(&end[1], &anchor->end[1], 1, MPI_LONG_LONG, MPI_MAX, comm));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, found, 2, MPI_DOUBLE, MPI_MAX, comm));
  anchor->s = found[0];
  *length = found[1];
  *distance = nearest;
  PetscFunctionReturn(0);
}

static PetscBool IsHeldBy(const SolidState *solid, const Anchor *anchor, int f)
{
  return (PetscBool)(f >= 0 && f < solid->nfacets && solid->gid[solid->facet[2 * f]] == anchor->end[0] &&
                     solid->gid[solid->facet[2 * f + 1]] == anchor->end[1]);
}

/* The anchor's facet on this rank, or -1. */
static int FindFacet(const SolidState *solid, const Anchor *anchor)
{
  if (IsHeldBy(solid, anchor, anchor->facet)) return anchor->facet;
  for (int f = 0; f < solid->nfacets; f++)
    if (IsHeldBy(solid, anchor, f)) return f;
  return -1;
}

/* --- where the gauges are ------------------------------------------------------------------------------- */

/* value: position, normal, 1, of a gauge whose facet is here. */
static void AddPlace(const SolidState *solid, const Anchor *anchor, double value[5])
{
  if (anchor->facet < 0) return;
  const double *a = End(solid, anchor->facet, 0), *b = End(solid, anchor->facet, 1);
  const double length = hypot(b[0] - a[0], b[1] - a[1]);
  for (int c = 0; c < 2; c++) value[c] = (1.0 - anchor->s) * a[c] + anchor->s * b[c];
  value[2] = (b[1] - a[1]) / length;
  value[3] = -(b[0] - a[0]) / length;
  value[4] = 1.0;
}

/* Collective: value[n] of all gauges; value[k][4] is 0 where no rank has the facet. */
static PetscErrorCode Places(Gauges g, const SolidState *solid, double value[][5])
{
  PetscFunctionBeginUser;
  PetscCall(PetscArrayzero(&value[0][0], 5 * (size_t)g->n));
  for (int k = 0; k < g->n; k++) {
    g->anchor[k].facet = FindFacet(solid, &g->anchor[k]);
    AddPlace(solid, &g->anchor[k], value[k]);
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, value, 5 * g->n, MPI_DOUBLE, MPI_SUM, g->comm));
  PetscFunctionReturn(0);
}

PetscErrorCode GaugesMove(Gauges g, const SolidState *solid)
{
  double value[CASE_GAUGES_MAX][5], distance, length;
  PetscBool lost = PETSC_FALSE;

  PetscFunctionBeginUser;
  if (!g->n) PetscFunctionReturn(0);
  PetscCall(Places(g, solid, value));
  for (int k = 0; k < g->n; k++) {
    if (value[k][4] > 0.0) continue;
    PetscCall(Hold(g->comm, solid, g->gauge[k].x, &g->anchor[k], &distance, &length));
    lost = PETSC_TRUE;
  }
  if (lost) PetscCall(Places(g, solid, value));
  for (int k = 0; k < g->n; k++)
    for (int c = 0; c < 2; c++) {
      g->gauge[k].x[c] = value[k][c];
      g->gauge[k].normal[c] = value[k][2 + c];
    }
  PetscFunctionReturn(0);
}

const CoracleGauge *GaugesGet(Gauges g, int *n)
{
  *n = g->n;
  return g->gauge;
}

/* --- start, checkpoint, end ----------------------------------------------------------------------------- */

static PetscErrorCode Load(Gauges g, Checkpoint from)
{
  long long end[CASE_GAUGES_MAX][2], rows;
  double place[CASE_GAUGES_MAX];

  PetscFunctionBeginUser;
  PetscCall(CheckpointRows(from, "gauge facets", &rows));
  PetscCheck(rows == g->n, g->comm, PETSC_ERR_USER,
             "fluid.probes has %d gauges on solids, the checkpoint to resume from %lld", g->n, rows);
  PetscCall(CheckpointGetIndices(from, "gauge facets", 0, g->n, 2, &end[0][0]));
  PetscCall(CheckpointGetDoubles(from, "gauge places", 0, g->n, 1, place));
  for (int k = 0; k < g->n; k++) g->anchor[k] = (Anchor){{end[k][0], end[k][1]}, place[k], -1};
  PetscFunctionReturn(0);
}

PetscErrorCode GaugesCreate(MPI_Comm comm, const GaugesCase *c, const SolidState *solid, Checkpoint from,
                            Gauges *gauges, int *fault, double *distance)
{
  Gauges g;

  PetscFunctionBeginUser;
  PetscCall(PetscNew(&g));
  *gauges = g;
  *fault = -1;
  g->comm = comm;
  g->n = c->n;
  if (from && g->n) PetscCall(Load(g, from));
  for (int k = 0; k < g->n && !from && *fault < 0; k++) {
    double length;
    PetscCall(Hold(comm, solid, c->point[k], &g->anchor[k], distance, &length));
    if (*distance > 0.5 * length) *fault = k;
  }
  if (*fault < 0) PetscCall(GaugesMove(g, solid));
  PetscFunctionReturn(0);
}

PetscErrorCode GaugesSave(Gauges g, Checkpoint to)
{
  long long end[CASE_GAUGES_MAX][2];
  double place[CASE_GAUGES_MAX];
  PetscMPIInt rank;

  PetscFunctionBeginUser;
  if (!g->n) PetscFunctionReturn(0);
  PetscCallMPI(MPI_Comm_rank(g->comm, &rank));
  for (int k = 0; k < g->n; k++) {
    for (int i = 0; i < 2; i++) end[k][i] = g->anchor[k].end[i];
    place[k] = g->anchor[k].s;
  }
  PetscCall(CheckpointPutIndices(to, "gauge facets", rank ? 0 : g->n, 2, &end[0][0]));
  PetscCall(CheckpointPutDoubles(to, "gauge places", rank ? 0 : g->n, 1, place));
  PetscFunctionReturn(0);
}

PetscErrorCode GaugesDestroy(Gauges *g)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(*g));
  PetscFunctionReturn(0);
}
