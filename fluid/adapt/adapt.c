#include "adapt_impl.h"
#include <string.h>

enum { MOST_ROUNDS = 60, LAST_ROUNDS = 6 };

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
static PetscErrorCode Rounds(Adapt *a, int most)
{
  Since since = {0, 0, 0, 0};
  int calm = 0;
  PetscFunctionBeginUser;
  for (int round = 0; round < most && calm < LAST_ROUNDS; round++) {
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
  PetscCall(AdaptCreate(mesh, metric, options, &a));
  PetscCall(Rounds(&a, options->rounds > 0 ? options->rounds : MOST_ROUNDS));
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
  const double l = MetricLength(&m->x[2 * p], &m->x[2 * q], &metric[3 * p], &metric[3 * q]);
  r->edges++;
  r->edges_unit += l >= SHORT_EDGE && l <= LONG_EDGE;
  r->shortest = fmin(r->shortest, l);
  r->longest = fmax(r->longest, l);
}

PetscErrorCode AdaptMeasure(const MeshSerial *mesh, const double metric[], AdaptReport *report)
{
  int *across, *mark;
  double sum = 0.0;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(3 * mesh->ne, &across, 3 * mesh->ne, &mark));
  PetscCall(AdaptFaces(mesh, across, mark));
  report->edges = report->edges_unit = 0;
  report->shortest = report->quality_worst = INFINITY;
  report->longest = 0.0;
  for (int c = 0; c < 3 * mesh->ne; c++) {
    if (across[c] == NONE || c < across[c])
      MeasureEdge(mesh, metric, mesh->vertex[Next(c)], mesh->vertex[Prev(c)], report);
  }
  for (int e = 0; e < mesh->ne; e++) {
    const int *v = &mesh->vertex[3 * e];
    const double *const x[3] = {&mesh->x[2 * v[0]], &mesh->x[2 * v[1]], &mesh->x[2 * v[2]]};
    const double *const m[3] = {&metric[3 * v[0]], &metric[3 * v[1]], &metric[3 * v[2]]};
    double square;
    const double quality = MetricQuality(x, m, &square);
    report->quality_worst = fmin(report->quality_worst, quality);
    sum += quality;
  }
  report->quality_mean = mesh->ne ? sum / mesh->ne : 0.0;
  PetscCall(PetscFree2(across, mark));
  PetscFunctionReturn(0);
}
