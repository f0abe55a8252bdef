#include "fluid/adapt/adapt_impl.h"
#include <string.h>

/* The first is more than any metric met so far needed. */
enum { MAX_ROUNDS = 60, LAST_ROUNDS = 6 };

/* What the mesh looks like to the next sweep of one kind: what has changed since its own last one. */
typedef struct {
  int split, collapse, swap, smooth; /* ticks of the last sweeps */
} Since;

/* Swaps until few are left. */
static int SwapSweeps(Adapt *a, Since *since)
{
  int all = 0, done;
  do {
    done = AdaptSwap(a, since->swap);
    since->swap = a->tick;
    all += done;
  } while (1000 * (long)done > a->ne);
  return all;
}

/* One round; *done: splits and collapses. */
static PetscErrorCode Round(Adapt *a, Since *since, bool smooth, int *done)
{
  PetscFunctionBeginUser;
  PetscCall(AdaptSplit(a, since->split, done));
  since->split = a->tick;
  SwapSweeps(a, since);
  *done += AdaptCollapse(a, since->collapse);
  since->collapse = a->tick;
  SwapSweeps(a, since);
  if (!smooth) PetscFunctionReturn(0);
  AdaptSmooth(a, since->smooth);
  since->smooth = a->tick;
  SwapSweeps(a, since);
  PetscFunctionReturn(0);
}

/* Coarse changes first; once a round splits and collapses little, it also moves.  The last rounds run until
 * hardly anything happens. */
static PetscErrorCode Rounds(Adapt *a)
{
  Since since = {0, 0, 0, 0};
  int calm = 0;
  PetscFunctionBeginUser;
  for (int round = 0; round < MAX_ROUNDS && calm < LAST_ROUNDS; round++) {
    int done;
    PetscCall(Round(a, &since, calm > 0, &done));
    if (calm > 0 || 20 * (long)done < a->nv) calm++;
    a->report.rounds++;
  }
  PetscFunctionReturn(0);
}

PetscErrorCode MeshAdapt(const MeshSerial *mesh, const double metric[], const AdaptOptions *options,
                         AdaptResult *result)
{
  const AdaptOptions usual = {0};
  Adapt a;
  PetscFunctionBeginUser;
  if (!options) options = &usual;
  memset(result, 0, sizeof *result);
  const PetscErrorCode refused = AdaptCreate(mesh, metric, options, &a);
  if (refused) {
    PetscCall(AdaptDestroy(&a));
    PetscFunctionReturn(refused);
  }
  PetscCall(Rounds(&a));
  PetscCall(AdaptExtract(&a, result));
  PetscCall(AdaptDestroy(&a));
  PetscFunctionReturn(0);
}

PetscErrorCode AdaptResultDestroy(AdaptResult *result)
{
  PetscFunctionBeginUser;
  PetscCall(MeshSerialDestroy(&result->mesh));
  PetscCall(PetscFree(result->metric));
  PetscCall(PetscFree(result->origin));
  memset(result, 0, sizeof *result);
  PetscFunctionReturn(0);
}

static void MeasureEdge(const MeshSerial *m, const double metric[], int p, int q, AdaptReport *r)
{
  const double l = AdaptMeshLength(m, metric, p, q);
  r->edges++;
  r->edges_unit += AdaptIsUnit(l);
  r->shortest = fmin(r->shortest, l);
  r->longest = fmax(r->longest, l);
}

static void MeasureEdges(const MeshSerial *m, const double metric[], const int across[], AdaptReport *r)
{
  r->edges = r->edges_unit = 0;
  r->shortest = INFINITY;
  r->longest = 0.0;
  for (int c = 0; c < 3 * m->ne; c++) {
    if (across[c] == NONE || c < across[c]) MeasureEdge(m, metric, m->vertex[Next(c)], m->vertex[Prev(c)], r);
  }
}

static void MeasureTriangles(const MeshSerial *m, const double metric[], AdaptReport *r)
{
  double sum = 0.0;
  r->quality_worst = INFINITY;
  for (int e = 0; e < m->ne; e++) {
    const double quality = AdaptMeshQuality(m, metric, e);
    r->quality_worst = fmin(r->quality_worst, quality);
    sum += quality;
  }
  r->quality_mean = m->ne ? sum / m->ne : 0.0;
}

PetscErrorCode AdaptMeasure(const MeshSerial *mesh, const double metric[], AdaptReport *report)
{
  int *across, *mark;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(3 * mesh->ne, &across, 3 * mesh->ne, &mark));
  const PetscErrorCode failed = AdaptFaces(mesh, across, mark);
  if (!failed) MeasureEdges(mesh, metric, across, report);
  if (!failed) MeasureTriangles(mesh, metric, report);
  PetscCall(PetscFree2(across, mark));
  PetscFunctionReturn(failed);
}
