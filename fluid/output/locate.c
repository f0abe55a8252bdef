#include "fluid/output/locate.h"
#include "common/supermesh/search.h"

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

/* The smallest barycentric coordinate, at most 0. */
static double Least(const double n[3])
{
  return fmin(fmin(n[0], n[1]), fmin(n[2], 0.0));
}

static PetscErrorCode Add(Places *p, const Place *place)
{
  PetscFunctionBeginUser;
  if (p->n == p->capacity) {
    p->capacity = 2 * p->capacity + 16;
    PetscCall(PetscRealloc(sizeof *p->place * (size_t)p->capacity, &p->place));
  }
  p->place[p->n++] = *place;
  PetscFunctionReturn(0);
}

/* Of the points. */
static PetscErrorCode CreateSearch(int npoints, const double point[][2], Search *search)
{
  GeometryBox *box;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(npoints, &box));
  for (int k = 0; k < npoints; k++)
    box[k] = (GeometryBox){{point[k][0], point[k][1]}, {point[k][0], point[k][1]}};
  PetscCheck(!SearchCreate(npoints, box, search), PETSC_COMM_SELF, PETSC_ERR_MEM,
             "no memory to search %d points", npoints);
  PetscCall(PetscFree(box));
  PetscFunctionReturn(0);
}

/* Each point in each element that it is in or near. */
static PetscErrorCode FindNear(const Mesh *m, int npoints, const double point[][2], Places *p)
{
  Search search;
  PetscFunctionBeginUser;
  PetscCall(CreateSearch(npoints, point, &search));
  p->n = 0;
  for (int e = 0; e < m->ne; e++) {
    double x[3][2];
    MeshCorners(m, e, x);
    const GeometryBox box = Around((const double(*)[2])x);
    const int *hit, n = SearchQuery(search, &box, &hit);
    PetscCheck(n >= 0, PETSC_COMM_SELF, PETSC_ERR_MEM, "no memory to search %d points", npoints);
    for (int k = 0; k < n; k++) {
      Place place = {.point = hit[k], .element = e};
      GeometryBarycentric((const double(*)[2])x, point[place.point], place.n);
      if (Least(place.n) >= -LOCATE_REACH) PetscCall(Add(p, &place));
    }
  }
  SearchDestroy(&search);
  PetscFunctionReturn(0);
}

/* Keeps the places that are as good as the best of their point; count[npoints]: of them on this rank. */
static void KeepBest(Places *p, const double best[], double count[])
{
  int kept = 0;
  for (int k = 0; k < p->n; k++) {
    const Place *at = &p->place[k];
    if (Least(at->n) < best[at->point] - EQUAL) continue;
    count[at->point] += 1.0;
    p->place[kept++] = *at;
  }
  p->n = kept;
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
  p->npoints = n;
  PetscCall(FindNear(m, n, x, p));
  for (int k = 0; k < n; k++) best[k] = -1.0;
  for (int k = 0; k < p->n; k++)
    best[p->place[k].point] = fmax(best[p->place[k].point], Least(p->place[k].n));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, best, n, MPI_DOUBLE, MPI_MAX, m->comm));
  KeepBest(p, best, count);
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
