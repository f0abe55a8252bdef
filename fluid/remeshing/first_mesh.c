/* The mesh before the first step. */
#include "common/exchange/scatter.h"
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
  PetscCheck(
      count <= s->elements_max, comm, PETSC_ERR_ARG_OUTOFRANGE,
      "fluid.adapt.elements_max is %g: sizes up to %g m and the bands of solid and interface alone take %.0f "
      "triangles; raise it, "
      "or fluid.adapt.size_min",
      s->elements_max, s->size_max, count);
  PetscFunctionReturn(0);
}

/* Whether an interface cuts owned element e, or runs along a face between it and another element of this rank. */
static PetscBool IsAtInterface(const Mesh *m, Phases phases, int e)
{
  const int single = PhasesSingle(phases, e);
  PetscBool at = (PetscBool)(single < 0);
  for (int i = 0; i < 3; i++) {
    const int k = m->neighbor[3 * e + i];
    if (k >= 0 && k < m->ne && PhasesSingle(phases, k) != single) at = PETSC_TRUE;
  }
  return at;
}

/* The bounding boxes of elements at an interface between phases, of all ranks; *box is allocated. */
static PetscErrorCode CutBoxes(const Mesh *m, const AdaptationStart *start, int *n, GeometryBox **box)
{
  int mine = 0;
  GeometryBox *local;
  void *gathered;
  Stars *stars;
  Phases phases;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(m->ne, &local));
  PetscCall(StarsCreate(m, &stars));
  PetscCall(PhasesCreate(stars, start->nphases, &phases));
  PetscCall(PhasesFill(phases, start->nregions, start->region));
  PetscCall(PhasesReconstruct(phases));
  for (int e = 0; e < m->ne; e++)
    if (IsAtInterface(m, phases, e)) local[mine++] = GeometryBoxOf((const double(*)[2])stars->element[e].x);
  PetscCall(PhasesDestroy(&phases));
  PetscCall(StarsDestroy(&stars));
  PetscCall(GatherRecords(m->comm, mine, sizeof *local, local, n, &gathered));
  *box = gathered;
  PetscCall(PetscFree(local));
  PetscFunctionReturn(0);
}

/* The interface's size around elements that it cuts, where size[nv] is larger. */
static PetscErrorCode RefineInterface(const AdaptationSetup *s, const Mesh *m, const AdaptationStart *start,
                                      double size[])
{
  const double slope = log(s->growth), reach = (s->size_max - s->interface_size) / slope;
  GeometryBox *box, *wide;
  Search search;
  int n;
  PetscFunctionBeginUser;
  PetscCall(CutBoxes(m, start, &n, &box));
  PetscCall(PetscMalloc1(n, &wide));
  for (int k = 0; k < n; k++)
    for (int c = 0; c < 2; c++) {
      wide[k].lower[c] = box[k].lower[c] - fmax(reach, 0.0);
      wide[k].upper[c] = box[k].upper[c] + fmax(reach, 0.0);
    }
  PetscCheck(!SearchCreate(n, wide, &search), PETSC_COMM_SELF, PETSC_ERR_MEM, "no memory for the interface");
  for (int v = 0; v < m->nv; v++) {
    const double *x = m->x + 2 * v;
    const GeometryBox point = {{x[0], x[1]}, {x[0], x[1]}};
    const int *hit, nhit = SearchQuery(search, &point, &hit);
    for (int h = 0; h < nhit; h++)
      size[v] = fmin(size[v], s->interface_size + slope * GeometryBoxDistance(&box[hit[h]], x));
  }
  SearchDestroy(&search);
  PetscCall(PetscFree(box));
  PetscCall(PetscFree(wide));
  PetscFunctionReturn(0);
}

/* One pass: le in the boxes, the interface's size around it, and elsewhere what the mesh has. */
static PetscErrorCode Refine(const AdaptationSetup *s, const Mesh *m, const AdaptationStart *start,
                             Mesh **mesh)
{
  const MeshSerial part = {.nv = m->nv, .ne = m->ne, .x = m->x, .vertex = m->vertex};
  SharedVertices shared;
  double *size, *metric, count;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(m->nv, &size, 3 * m->nv, &metric));
  for (int v = 0; v < m->nv; v++) {
    size[v] = s->size_max;
    for (int b = 0; b < start->nbox; b++) {
      const double *k = start->box + 4 * b;
      const GeometryBox at = {{k[0], k[1]}, {k[2], k[3]}};
      size[v] = fmin(size[v], s->size_min + log(s->growth) * GeometryBoxDistance(&at, m->x + 2 * v));
    }
  }
  if (start->nphases) PetscCall(RefineInterface(s, m, start, size));
  PetscCall(MetricFromSizes(m->nv, size, metric));
  PetscCall(SharedVerticesCreate(m, &shared));
  PetscCall(MetricGradeParallel(m->comm, &part, &shared, s->growth, metric));
  PetscCall(MetricCount(&part, metric, &count));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &count, 1, MPI_DOUBLE, MPI_SUM, m->comm));
  PetscCall(AdaptationCheckBudget(s, m->comm, count));
  PetscCall(MeshAdaptParallel(m, metric, NULL, mesh, NULL));
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
