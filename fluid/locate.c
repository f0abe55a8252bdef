#include "fluid/locate.h"
#include "common/supermesh/geometry.h"

#define EQUAL 1e-9 /* barycentric coordinates that count as equally far outside */

/* A point with no coordinate below -LOCATE_REACH is in this box around the element. */
static GeometryBox Around(const double x[3][2])
{
  GeometryBox box = GeometryBoxOf(x);
  for (int c = 0; c < 2; c++) {
    const double margin = 2.0 * LOCATE_REACH * (box.upper[c] - box.lower[c]);
    box.lower[c] -= margin;
    box.upper[c] += margin;
  }
  return box;
}

typedef PetscErrorCode (*Visit)(void *context, int point, int element, const double n[3], double least);

/* Visits each point with each element that it is in or near; least: its smallest barycentric coordinate, at most 0. */
static PetscErrorCode ForEach(const Mesh *m, int npoints, const double point[][2], Visit visit, void *context)
{
  PetscFunctionBeginUser;
  for (int e = 0; e < m->ne; e++) {
    double x[3][2], n[3];
    for (int i = 0; i < 3; i++)
      for (int c = 0; c < 2; c++) x[i][c] = m->x[2 * m->vertex[3 * e + i] + c];
    const GeometryBox box = Around((const double(*)[2])x);
    for (int k = 0; k < npoints; k++) {
      if (GeometryBoxDistance(&box, point[k]) > 0.0) continue;
      GeometryBarycentric((const double(*)[2])x, point[k], n);
      const double least = fmin(fmin(n[0], n[1]), fmin(n[2], 0.0));
      if (least >= -LOCATE_REACH) PetscCall(visit(context, k, e, n, least));
    }
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode Improve(void *context, int point, int element, const double n[3], double least)
{
  double *best = context;
  PetscFunctionBeginUser;
  best[point] = fmax(best[point], least);
  PetscFunctionReturn(0);
}

typedef struct {
  Places *places;
  const double *best;
  double *count;
} Collector;

static PetscErrorCode Collect(void *context, int point, int element, const double n[3], double least)
{
  Collector *c = context;
  Places *p = c->places;
  PetscFunctionBeginUser;
  if (least < c->best[point] - EQUAL) PetscFunctionReturn(0);
  if (p->n == p->capacity) {
    p->capacity = 2 * p->capacity + 16;
    PetscCall(PetscRealloc(sizeof *p->place * (size_t)p->capacity, &p->place));
  }
  p->place[p->n++] = (Place){point, element, {n[0], n[1], n[2]}, 0.0};
  c->count[point] += 1.0;
  PetscFunctionReturn(0);
}

PetscBool LocateInBounds(const Mesh *m, const double x[2])
{
  for (int c = 0; c < 2; c++) {
    const double margin = EQUAL * (m->upper[c] - m->lower[c]);
    if (x[c] < m->lower[c] - margin || x[c] > m->upper[c] + margin) return PETSC_FALSE;
  }
  return PETSC_TRUE;
}

PetscErrorCode PlacesLocate(const Mesh *m, int n, const double x[][2], Places *p)
{
  double *best, *count;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1((size_t)n + 1, &best));
  PetscCall(PetscCalloc1((size_t)n + 1, &count));
  PetscCall(PetscRealloc(sizeof *p->outside * ((size_t)n + 1), &p->outside));
  p->n = 0;
  p->npoints = n;
  for (int k = 0; k < n; k++) best[k] = -1.0;
  PetscCall(ForEach(m, n, x, Improve, best));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, best, n, MPI_DOUBLE, MPI_MAX, m->comm));
  PetscCall(ForEach(m, n, x, Collect, &(Collector){p, best, count}));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, count, n, MPI_DOUBLE, MPI_SUM, m->comm));
  for (int k = 0; k < p->n; k++) p->place[k].share = 1.0 / count[p->place[k].point];
  for (int k = 0; k < n; k++) p->outside[k] = best[k] < -LOCATE_REACH || !LocateInBounds(m, x[k]) ? 1.0 : 0.0;
  PetscCall(PetscFree(best));
  PetscCall(PetscFree(count));
  PetscFunctionReturn(0);
}

PetscErrorCode PlacesFree(Places *p)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(p->place));
  PetscCall(PetscFree(p->outside));
  PetscFunctionReturn(0);
}
