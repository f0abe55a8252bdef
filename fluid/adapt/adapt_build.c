#include "fluid/adapt/adapt_impl.h"
#include <string.h>

/* A line that turns by less, radians, is straight. */
#define STRAIGHT 1e-8

static PetscErrorCode CheckTriangle(const MeshSerial *m, int e)
{
  const int *v = &m->vertex[3 * e];
  PetscFunctionBeginUser;
  for (int i = 0; i < 3; i++) {
    PetscCheck(v[i] >= 0 && v[i] < m->nv, PETSC_COMM_SELF, PETSC_ERR_ARG_WRONG,
               "triangle %d has the vertex %d; there are %d", e, v[i], m->nv);
  }
  const double *a = &m->x[2 * v[0]], *b = &m->x[2 * v[1]], *c = &m->x[2 * v[2]];
  PetscCheck((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) > 0.0, PETSC_COMM_SELF,
             PETSC_ERR_ARG_WRONG, "triangle %d near (%g, %g) is clockwise or flat", e, a[0], a[1]);
  PetscFunctionReturn(0);
}

/* Before anything is allocated. */
static PetscErrorCode CheckInput(const MeshSerial *m, const double metric[])
{
  PetscFunctionBeginUser;
  for (int e = 0; e < m->ne; e++) PetscCall(CheckTriangle(m, e));
  for (int v = 0; v < m->nv; v++) {
    PetscCheck(MetricIsValid(&metric[3 * v]), PETSC_COMM_SELF, PETSC_ERR_ARG_OUTOFRANGE,
               "the metric (%g, %g, %g) at (%g, %g) is not positive definite", metric[3 * v],
               metric[3 * v + 1], metric[3 * v + 2], m->x[2 * v], m->x[2 * v + 1]);
  }
  PetscFunctionReturn(0);
}

/* A boundary face, or one between two regions, that no facet names. */
static void MarkUnnamed(Adapt *a, int unnamed)
{
  for (int c = 0; c < 3 * a->ne; c++) {
    const int o = a->across[c];
    if (a->mark[c] == NONE && (o == NONE || a->region[c / 3] != a->region[o / 3])) a->mark[c] = unnamed;
  }
}

/* The marked edges at each vertex: how many, and those that came first. */
typedef struct {
  int count, mark[2], end[2];
  bool frozen;
} Ends;

static void AddEnd(Ends *e, int end, int mark, bool frozen)
{
  if (e->count < 2) {
    e->end[e->count] = end;
    e->mark[e->count] = mark;
  }
  e->count++;
  e->frozen = e->frozen || frozen;
}

/* Does the line p - v - q turn by less than STRAIGHT? */
static bool IsStraight(const double p[2], const double v[2], const double q[2])
{
  const double ax = v[0] - p[0], ay = v[1] - p[1], bx = q[0] - v[0], by = q[1] - v[1];
  return fabs(atan2(ax * by - ay * bx, ax * bx + ay * by)) < STRAIGHT;
}

static VertexKind Kind(const MeshSerial *m, const Ends *e, int v, const AdaptOptions *o)
{
  if (e->frozen || (o->frozen && o->frozen[v])) return FIXED;
  if (e->count == 0) return FREE;
  if (e->count != 2 || e->mark[0] != e->mark[1]) return FIXED;
  return IsStraight(&m->x[2 * e->end[0]], &m->x[2 * v], &m->x[2 * e->end[1]]) ? ON_LINE : FIXED;
}

static PetscErrorCode Classify(Adapt *a, const MeshSerial *m, const AdaptOptions *options)
{
  Ends *ends;
  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(a->nv, &ends));
  for (int c = 0; c < 3 * a->ne; c++) {
    const int mark = a->mark[c], p = a->vertex[Next(c)], q = a->vertex[Prev(c)];
    if (mark == NONE || (a->across[c] != NONE && a->across[c] < c)) continue;
    AddEnd(&ends[p], q, mark, a->frozen_mark[mark]);
    AddEnd(&ends[q], p, mark, a->frozen_mark[mark]);
  }
  for (int v = 0; v < a->nv; v++) a->kind[v] = (char)Kind(m, &ends[v], v, options);
  PetscCall(PetscFree(ends));
  PetscFunctionReturn(0);
}

static PetscErrorCode CopyVertices(Adapt *a, const MeshSerial *m, const double metric[],
                                   const char inactive[])
{
  PetscFunctionBeginUser;
  for (int v = 0; v < m->nv; v++) {
    MetricLog(&metric[3 * v], &a->background.log_metric[3 * v]);
    a->origin[v] = v;
    a->stamp[v] = inactive && inactive[v] ? -1 : 0; /* sweeps begin at 0 */
    a->corner[v] = NONE;
    a->home[v] = NONE;
    for (int k = 0; k < 2; k++) a->scale = fmax(a->scale, fabs(m->x[2 * v + k]));
  }
  PetscCall(PetscArraycpy(a->x, m->x, 2 * m->nv));
  PetscCall(PetscArraycpy(a->metric, metric, 3 * m->nv));
  PetscFunctionReturn(0);
}

static PetscErrorCode CopyTriangles(Adapt *a, const MeshSerial *m)
{
  PetscFunctionBeginUser;
  PetscCall(AdaptFaces(m, a->across, a->mark));
  PetscCall(PetscArraycpy(a->vertex, m->vertex, 3 * m->ne));
  PetscCall(PetscArraycpy(a->background.across, a->across, 3 * m->ne));
  for (int e = 0; e < m->ne; e++) a->region[e] = m->region ? m->region[e] : 0;
  for (int c = 0; c < 3 * m->ne; c++) {
    a->corner[m->vertex[c]] = c;
    a->home[m->vertex[c]] = c / 3;
  }
  PetscFunctionReturn(0);
}

PetscErrorCode AdaptCreate(const MeshSerial *mesh, const double metric[], const AdaptOptions *options,
                           Adapt *a)
{
  PetscFunctionBeginUser;
  memset(a, 0, sizeof *a);
  PetscCall(CheckInput(mesh, metric));
  a->dead_v = a->dead_e = NONE;
  a->background.mesh = mesh;
  PetscCall(PetscMalloc2(3 * mesh->ne, &a->background.across, 3 * mesh->nv, &a->background.log_metric));
  PetscCall(PetscCalloc1(mesh->ntags + 1, &a->frozen_mark));
  for (int k = 0; k < mesh->ntags; k++) a->frozen_mark[k] = options->frozen_tag && options->frozen_tag[k];
  a->nv = mesh->nv;
  a->ne = mesh->ne;
  PetscCall(AdaptReserve(a));
  PetscCall(CopyVertices(a, mesh, metric, options->inactive));
  PetscCall(CopyTriangles(a, mesh));
  MarkUnnamed(a, mesh->ntags);
  PetscCall(Classify(a, mesh, options));
  for (int v = 0; v < a->nv; v++) {
    if (a->corner[v] == NONE) AdaptKillVertex(a, v); /* of no triangle */
  }
  PetscFunctionReturn(0);
}

PetscErrorCode AdaptDestroy(Adapt *a)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree2(a->background.across, a->background.log_metric));
  PetscCall(PetscFree(a->frozen_mark));
  PetscCall(PetscFree(a->x));
  PetscCall(PetscFree(a->metric));
  PetscCall(PetscFree(a->corner));
  PetscCall(PetscFree(a->home));
  PetscCall(PetscFree(a->origin));
  PetscCall(PetscFree(a->stamp));
  PetscCall(PetscFree(a->kind));
  PetscCall(PetscFree(a->vertex));
  PetscCall(PetscFree(a->across));
  PetscCall(PetscFree(a->mark));
  PetscCall(PetscFree(a->region));
  PetscFunctionReturn(0);
}
