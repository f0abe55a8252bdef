/* The mesh before the first step. */
#include "common/exchange/box_scatter.h"
#include "common/supermesh/geometry.h"
#include "common/supermesh/search.h"
#include "fluid/adapt/adapt_parallel.h"
#include "fluid/adapt/metric.h"
#include "fluid/adapt/metric_share.h"
#include "fluid/remeshing/adaptation.h"

/* Passes at most from the first mesh to one that is fine near the solid and the interface. */
#define FIRST_PASSES 12

PetscErrorCode AdaptationCheckBudget(const AdaptationSetup *s, MPI_Comm comm, double count)
{
  PetscFunctionBeginUser;
  PetscCheck(count <= s->elements_max, comm, PETSC_ERR_ARG_OUTOFRANGE,
             "fluid.adapt.elements_max is %.0f: sizes up to %g m and the bands of solid and interface alone "
             "take %.0f "
             "triangles; raise it, "
             "or fluid.adapt.size_min",
             s->elements_max, s->size_max, count);
  PetscFunctionReturn(0);
}

PetscErrorCode AdaptationLeastCount(const AdaptationSetup *s, const Mesh *m, double *triangles)
{
  const MeshSerial part = {.nv = m->nv, .ne = m->ne, .x = m->x, .vertex = m->vertex};
  double *size, *metric;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(m->nv, &size, 3 * m->nv, &metric));
  for (int v = 0; v < m->nv; v++) size[v] = s->size_max;
  PetscCall(MetricFromSizes(m->nv, size, metric));
  PetscCall(MetricCount(&part, metric, triangles));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, triangles, 1, MPI_DOUBLE, MPI_SUM, m->comm));
  PetscCall(PetscFree2(size, metric));
  PetscFunctionReturn(0);
}

/* Whether an interface cuts owned element e, or runs along one of its faces. */
static PetscBool IsAtInterface(const Stars *s, Phases phases, int e)
{
  const int single = PhasesSingle(phases, e);
  PetscBool at = (PetscBool)(single < 0);
  for (int i = 0; i < 3; i++) {
    const int k = s->neighbor[e][i];
    if (k >= 0 && PhasesSingle(phases, k) != single) at = PETSC_TRUE;
  }
  return at;
}

/* The bounding boxes of this rank's elements at an interface between phases; box has room for all of them. */
static PetscErrorCode CutBoxes(const Mesh *m, const AdaptationStart *start, int *n, GeometryBox box[])
{
  Stars *stars;
  Phases phases;
  PetscFunctionBeginUser;
  PetscCall(StarsCreate(m, &stars));
  PetscCall(PhasesCreate(stars, start->nphases, &phases));
  PetscCall(PhasesFill(phases, start->nregions, start->region));
  PetscCall(PhasesReconstruct(phases));
  *n = 0;
  for (int e = 0; e < m->ne; e++)
    if (IsAtInterface(stars, phases, e)) box[(*n)++] = GeometryBoxOf((const double(*)[2])stars->element[e].x);
  PetscCall(PhasesDestroy(&phases));
  PetscCall(StarsDestroy(&stars));
  PetscFunctionReturn(0);
}

/* How far from a box the size there matters. */
static double Reach(const AdaptationSetup *s, double size_at)
{
  return fmax((s->size_max - size_at) / log(s->growth), 0.0);
}

/* size_at in the boxes, growing outside, where size[nv] is larger. */
static PetscErrorCode RefineBoxes(const AdaptationSetup *s, const Mesh *m, double size_at, int n,
                                  const GeometryBox box[], double size[])
{
  GeometryBox *wide;
  Search search;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(n, &wide));
  for (int k = 0; k < n; k++) wide[k] = GeometryBoxWidened(box[k], Reach(s, size_at));
  PetscCheck(!SearchCreate(n, wide, &search), PETSC_COMM_SELF, PETSC_ERR_MEM, "no memory for %d boxes", n);
  for (int v = 0; v < m->nv; v++) {
    const double *x = m->x + 2 * v;
    const GeometryBox point = {{x[0], x[1]}, {x[0], x[1]}};
    const int *hit, nhit = SearchQuery(search, &point, &hit);
    for (int h = 0; h < nhit; h++)
      size[v] = fmin(size[v], size_at + log(s->growth) * GeometryBoxDistance(&box[hit[h]], x));
  }
  SearchDestroy(&search);
  PetscCall(PetscFree(wide));
  PetscFunctionReturn(0);
}

/* The interface's size around elements that it cuts, where size[nv] is larger. */
static PetscErrorCode RefineInterface(const AdaptationSetup *s, const Mesh *m, const AdaptationStart *start,
                                      double size[])
{
  GeometryBox *local, *wide, bounds = GeometryBoxEmpty();
  void *box;
  int mine, n;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(m->ne, &local, m->ne, &wide));
  PetscCall(CutBoxes(m, start, &mine, local));
  for (int k = 0; k < mine; k++) wide[k] = GeometryBoxWidened(local[k], Reach(s, s->interface_size));
  for (int v = 0; v < m->nv; v++) GeometryBoxGrow(&bounds, m->x + 2 * v);
  PetscCall(BoxScatterRecords(m->comm, mine, wide, &bounds, sizeof *local, local, &n, &box));
  PetscCall(RefineBoxes(s, m, s->interface_size, n, box, size));
  PetscCall(PetscFree(box));
  PetscCall(PetscFree2(local, wide));
  PetscFunctionReturn(0);
}

/* One pass: le in the boxes, the interface's size around it, and elsewhere the largest. */
static PetscErrorCode Refine(const AdaptationSetup *s, const Mesh *m, const AdaptationStart *start,
                             Mesh **mesh)
{
  const MeshSerial part = {.nv = m->nv, .ne = m->ne, .x = m->x, .vertex = m->vertex};
  SharedVertices shared;
  double *size, *metric, count;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(m->nv, &size, 3 * m->nv, &metric));
  for (int v = 0; v < m->nv; v++) size[v] = s->size_max;
  PetscCall(RefineBoxes(s, m, s->size_min, start->nbox, GeometryBoxes(start->box), size));
  if (start->nphases) PetscCall(RefineInterface(s, m, start, size));
  PetscCall(MetricFromSizes(m->nv, size, metric));
  PetscCall(SharedVerticesCreate(m, &shared));
  PetscCall(MetricGradeParallel(m->comm, &part, &shared, s->growth, metric));
  PetscCall(MetricCount(&part, metric, &count));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &count, 1, MPI_DOUBLE, MPI_SUM, m->comm));
  PetscCall(AdaptationCheckBudget(s, m->comm, count));
  PetscCall(MeshAdaptParallel(m, metric, mesh, NULL));
  PetscCall(SharedVerticesDestroy(&shared));
  PetscCall(PetscFree2(size, metric));
  PetscFunctionReturn(0);
}

PetscErrorCode AdaptationFirstMesh(Adaptation a, const Mesh *initial, const AdaptationStart *start,
                                   Mesh **mesh)
{
  const AdaptationSetup *s = AdaptationGetSetup(a);
  Mesh *finer;
  PetscFunctionBeginUser;
  PetscCall(Refine(s, initial, start, mesh));
  /* a coarse mesh sees little of a small box: again, until there is nothing new to see */
  for (int pass = 0; pass < FIRST_PASSES; pass++) {
    PetscCall(Refine(s, *mesh, start, &finer));
    const double gain = (double)finer->nglobal / (double)(*mesh)->nglobal;
    PetscCall(MeshDestroy(mesh));
    *mesh = finer;
    if (gain < 1.02) break;
  }
  PetscFunctionReturn(0);
}
