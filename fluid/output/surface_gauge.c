#include "fluid/output/surface_gauge.h"
#include "common/exchange/scatter.h"
#include "common/supermesh/geometry.h"
#include <stdlib.h>

/* The piece [s0, s1] of the segment, m from its start; the size of its element. */
typedef struct {
  double s0, s1, size;
} Piece;

/* Of an edge's length: a segment along a wall is in its elements whatever round-off says. */
#define ON_EDGE 1e-9

PetscBool SegmentClip(int n, const double x[][2], const double from[2], const double to[2], double s[2],
                      int *along)
{
  s[0] = 0.0, s[1] = 1.0;
  *along = -1;
  for (int k = 0; k < n; k++) {
    const double *p = x[k], *q = x[(k + 1) % n];
    const double square = (q[0] - p[0]) * (q[0] - p[0]) + (q[1] - p[1]) * (q[1] - p[1]);
    double a = GeometryTurn(p, q, from), b = GeometryTurn(p, q, to); /* positive inside */
    if (fabs(a) < ON_EDGE * square) a = 0.0;
    if (fabs(b) < ON_EDGE * square) b = 0.0;
    if (a == 0.0 && b == 0.0) *along = k;
    if (a < 0.0 && b < 0.0) return PETSC_FALSE;
    if (a < 0.0) s[0] = fmax(s[0], a / (a - b));
    if (b < 0.0) s[1] = fmin(s[1], a / (a - b));
  }
  return (PetscBool)(n > 2 && s[1] > s[0]);
}

/* The phase's piece in owned element e; whether there is one that counts. */
static PetscErrorCode ElementPiece(Phases phases, const Mesh *m, int e, int phase, const double from[2],
                                   const double to[2], Piece *piece, PetscBool *counts)
{
  double x[3][2], whole[2], part[2], area;
  Polygon polygon;
  int along;
  PetscFunctionBeginUser;
  *counts = PETSC_FALSE;
  MeshCorners(m, e, x);
  if (!SegmentClip(3, (const double(*)[2])x, from, to, whole, &along)) PetscFunctionReturn(0);
  const double least = PhasesSpread(phases, e) ? PHASES_CLOUD : SURFACE_SLIVER * SURFACE_SLIVER;
  PetscCall(PhasesGetPolygon(phases, e, phase, &polygon));
  area = GeometryArea((const double(*)[2])x);
  if (PolygonArea(&polygon) < least * area) PetscFunctionReturn(0);
  if (!SegmentClip(polygon.n, (const double(*)[2])polygon.x, from, to, part, &along)) PetscFunctionReturn(0);
  const double length = hypot(to[0] - from[0], to[1] - from[1]);
  *piece = (Piece){length * fmax(part[0], whole[0]), length * fmin(part[1], whole[1]), sqrt(area)};
  *counts = (PetscBool)(piece->s1 - piece->s0 > SURFACE_SLIVER * length * (whole[1] - whole[0]));
  PetscFunctionReturn(0);
}

static int Compare(const void *a, const void *b)
{
  const double x = ((const Piece *)a)->s0, y = ((const Piece *)b)->s0;
  return (x > y) - (x < y);
}

/* Pieces that overlap, touch or nearly touch are one. */
static SurfacePlace Join(int n, const Piece piece[])
{
  SurfacePlace place = {0.0, 0.0, 0.0};
  for (int k = 0; k < n; k++) {
    const Piece *p = &piece[k];
    const double gap = p->s0 - place.last;
    if (gap <= SURFACE_SLIVER * p->size && place.first == place.last) place.first = fmax(place.first, p->s1);
    place.length += fmax(0.0, p->s1 - fmax(p->s0, place.last));
    place.last = fmax(place.last, p->s1);
  }
  return place;
}

PetscErrorCode SurfaceMeasure(Phases phases, const Mesh *m, int phase, const double from[2],
                              const double to[2], SurfacePlace *place)
{
  Piece *mine;
  void *all;
  int n = 0, total;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1((size_t)m->ne + 1, &mine));
  for (int e = 0; e < m->ne; e++) {
    PetscBool counts;
    PetscCall(ElementPiece(phases, m, e, phase, from, to, &mine[n], &counts));
    n += counts;
  }
  PetscCall(GatherRecords(m->comm, n, sizeof *mine, mine, &total, &all));
  qsort(all, (size_t)total, sizeof *mine, Compare);
  *place = Join(total, all);
  PetscCall(PetscFree(mine));
  PetscCall(PetscFree(all));
  PetscFunctionReturn(0);
}
