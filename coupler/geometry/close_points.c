#include "coupler/geometry/close_points.h"
#include "common/exchange/box_scatter.h"
#include "common/supermesh/search.h"

/* Cosine of the angle between the normal of a facet and the direction to the wall that it faces, at least. */
#define FACING_WALL 0.7
/* The same of two facets' normals: corners that stand on something have 0.7. */
#define FACING 0.3
/* Of a facet's length: bodies in contact overlap by less. */
#define BEHIND 0.1

/* What a facet is to others. */
typedef struct {
  double x[2][2], normal[2], length;
  int is_held;
} Facet;

static const double gauss[2] = {0.2113248654051871, 0.7886751345948129};

static Facet FacetOf(const SolidState *solid, const Shell shell, int f)
{
  const int *node = &solid->facet[2 * f];
  Facet facet = {.length = shell->length[f],
                 .is_held = solid->mobility[node[0]] == 0.0 && solid->mobility[node[1]] == 0.0};
  for (int c = 0; c < 2; c++) {
    facet.normal[c] = shell->normal[f][c];
    for (int i = 0; i < 2; i++) facet.x[i][c] = solid->x[2 * node[i] + c];
  }
  return facet;
}

static GeometryBox BoxOf(const Facet *f, double reach)
{
  GeometryBox box = GeometryBoxEmpty();
  for (int i = 0; i < 2; i++) GeometryBoxGrow(&box, f->x[i]);
  return GeometryBoxWidened(box, reach);
}

/* arrived[]: the facets that are within reach of this rank's, and its own. */
static PetscErrorCode Exchange(ClosePoints *points, MPI_Comm comm, int n, const Facet own[], double reach,
                               Facet **arrived)
{
  GeometryBox *bounds, *box, mine = GeometryBoxEmpty();
  PetscMPIInt size;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_size(comm, &size));
  PetscCall(PetscMalloc2(size, &bounds, n, &box));
  for (int f = 0; f < n; f++) {
    for (int i = 0; i < 2; i++) GeometryBoxGrow(&mine, own[f].x[i]);
    box[f] = BoxOf(&own[f], reach);
  }
  PetscCallMPI(MPI_Allgather(&mine, 4, MPI_DOUBLE, bounds, 4, MPI_DOUBLE, comm));
  PetscCall(BoxScatterCreate(comm, n, box, bounds, &points->scatter));
  PetscCall(PetscMalloc1(ScatterArriving(points->scatter), arrived));
  PetscCall(ScatterForward(points->scatter, sizeof(Facet), own, *arrived));
  PetscCall(PetscFree2(bounds, box));
  PetscFunctionReturn(0);
}

static void PointOn(const Facet *f, double s, double x[2])
{
  for (int c = 0; c < 2; c++) x[c] = (1.0 - s) * f->x[0][c] + s * f->x[1][c];
}

/* y is in front of f, whose point x is. */
static PetscBool InFront(const Facet *f, const double x[2], const double y[2])
{
  return (y[0] - x[0]) * f->normal[0] + (y[1] - x[1]) * f->normal[1] > -BEHIND * f->length ? PETSC_TRUE
                                                                                           : PETSC_FALSE;
}

static void CloseToWall(const Facet *f, const double x[2], const double lower[2], const double upper[2],
                        ClosePoint *point)
{
  for (int c = 0; c < 2; c++) {
    if (fabs(f->normal[c]) < FACING_WALL) continue;
    const double gap = fabs((f->normal[c] > 0.0 ? upper[c] : lower[c]) - x[c]);
    if (gap > point->gap) continue;
    point->gap = gap;
    point->opposite = CLOSE_TO_WALL;
    point->opposite_is_held = 1;
  }
}

static void CloseToFacet(const Facet *f, const double x[2], const Facet *g, int index, ClosePoint *point)
{
  double y[2];
  if (g->length == 0.0 || f->normal[0] * g->normal[0] + f->normal[1] * g->normal[1] > -FACING) return;
  const double s = GeometrySegmentPlace(g->x[0], g->x[1], x),
               gap = GeometryDistanceAt(g->x[0], g->x[1], s, x);
  if (gap > point->gap) return;
  PointOn(g, s, y);
  if (!InFront(f, x, y) || !InFront(g, y, x)) return;
  point->gap = gap;
  point->opposite = index;
  point->opposite_is_held = g->is_held;
  point->opposite_n[0] = 1.0 - s;
  point->opposite_n[1] = s;
}

static PetscErrorCode Append(ClosePoints *points, const ClosePoint *point)
{
  PetscFunctionBeginUser;
  if (points->n == points->capacity) {
    ClosePoint *more;
    points->capacity = 2 * points->capacity + 64;
    PetscCall(PetscMalloc1(points->capacity, &more));
    PetscCall(PetscArraycpy(more, points->point, points->n));
    PetscCall(PetscFree(points->point));
    points->point = more;
  }
  points->point[points->n++] = *point;
  PetscFunctionReturn(0);
}

/* The points of facet index of this rank. */
static PetscErrorCode FindOfFacet(ClosePoints *points, const Facet *f, int index, const double lower[2],
                                  const double upper[2], double reach, Search search, const Facet arrived[])
{
  const GeometryBox box = BoxOf(f, reach);
  const int *hit, nhits = SearchQuery(search, &box, &hit);

  PetscFunctionBeginUser;
  PetscCheck(nhits >= 0, PETSC_COMM_SELF, PETSC_ERR_MEM, "no memory for the facets near a facet");
  for (int k = 0; k < 2; k++) {
    ClosePoint point = {.facet = index,
                        .opposite = CLOSE_TO_NOTHING,
                        .is_held = f->is_held,
                        .gap = reach,
                        .weight = 0.5 * f->length,
                        .n = {1.0 - gauss[k], gauss[k]}};
    double x[2];
    PointOn(f, gauss[k], x);
    CloseToWall(f, x, lower, upper, &point);
    for (int h = 0; h < nhits; h++) CloseToFacet(f, x, &arrived[hit[h]], hit[h], &point);
    if (point.opposite != CLOSE_TO_NOTHING) PetscCall(Append(points, &point));
  }
  PetscFunctionReturn(0);
}

PetscErrorCode ClosePointsFind(const SolidState *solid, const Shell shell, const double lower[2],
                               const double upper[2], double reach, ClosePoints *points)
{
  Facet *own, *arrived;
  GeometryBox *box;
  Search search = NULL;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(solid->nfacets, &own));
  for (int f = 0; f < solid->nfacets; f++) own[f] = FacetOf(solid, shell, f);
  PetscCall(Exchange(points, shell->comm, solid->nfacets, own, reach, &arrived));
  const int n = ScatterArriving(points->scatter);
  PetscCall(PetscMalloc1(n, &box));
  for (int g = 0; g < n; g++) box[g] = BoxOf(&arrived[g], 0.0);
  PetscCheck(!SearchCreate(n, box, &search), PETSC_COMM_SELF, PETSC_ERR_MEM,
             "no memory for a search tree of %d facets", n);
  points->n = 0;
  for (int f = 0; f < solid->nfacets; f++)
    if (own[f].length > 0.0) PetscCall(FindOfFacet(points, &own[f], f, lower, upper, reach, search, arrived));
  SearchDestroy(&search);
  PetscCall(PetscFree(box));
  PetscCall(PetscFree(arrived));
  PetscCall(PetscFree(own));
  PetscFunctionReturn(0);
}

PetscErrorCode ClosePointsDestroy(ClosePoints *points)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(points->point));
  PetscCall(ScatterDestroy(&points->scatter));
  points->n = points->capacity = 0;
  PetscFunctionReturn(0);
}

PetscErrorCode ClosePointsForward(const ClosePoints *points, const SolidState *solid, int ncomp,
                                  const double node[], double arrived[])
{
  double *own;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(2 * (size_t)solid->nfacets * (size_t)ncomp, &own));
  for (int k = 0; k < 2 * solid->nfacets; k++)
    for (int c = 0; c < ncomp; c++) own[k * ncomp + c] = node[solid->facet[k] * ncomp + c];
  PetscCall(ScatterForward(points->scatter, 2 * (size_t)ncomp * sizeof *own, own, arrived));
  PetscCall(PetscFree(own));
  PetscFunctionReturn(0);
}

PetscErrorCode ClosePointsReverseAdd(const ClosePoints *points, const SolidState *solid, int ncomp,
                                     const double arrived[], double node[])
{
  double *own;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(2 * (size_t)solid->nfacets * (size_t)ncomp, &own));
  PetscCall(ScatterReverseAdd(points->scatter, 2 * ncomp, arrived, own));
  for (int k = 0; k < 2 * solid->nfacets; k++)
    for (int c = 0; c < ncomp; c++) node[solid->facet[k] * ncomp + c] += own[k * ncomp + c];
  PetscCall(PetscFree(own));
  PetscFunctionReturn(0);
}
