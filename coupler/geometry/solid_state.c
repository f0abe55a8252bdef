#include "coupler/geometry/solid_state.h"
#include "common/supermesh/geometry.h"

PetscErrorCode SolidStateDestroy(SolidState *copy)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree7(copy->gid, copy->x, copy->u, copy->mobility, copy->acceleration, copy->facet,
                       copy->element));
  *copy = (SolidState){0};
  PetscFunctionReturn(0);
}

PetscErrorCode SolidStateCopy(const SolidState *solid, SolidState *copy)
{
  const size_t n = (size_t)solid->nnodes, nfacets = (size_t)solid->nfacets, ne = (size_t)solid->nelements;
  long long *gid;
  double *x, *u, *mobility, *acceleration;
  int *facet, *element;

  PetscFunctionBeginUser;
  PetscCall(SolidStateDestroy(copy));
  PetscCall(PetscMalloc7(n, &gid, 2 * n, &x, 2 * n, &u, n, &mobility, 2 * n, &acceleration, 2 * nfacets,
                         &facet, 3 * ne, &element));
  PetscCall(PetscArraycpy(gid, solid->gid, n));
  PetscCall(PetscArraycpy(x, solid->x, 2 * n));
  PetscCall(PetscArraycpy(u, solid->u, 2 * n));
  PetscCall(PetscArraycpy(mobility, solid->mobility, n));
  PetscCall(PetscArraycpy(acceleration, solid->acceleration, 2 * n));
  PetscCall(PetscArraycpy(facet, solid->facet, 2 * nfacets));
  PetscCall(PetscArraycpy(element, solid->element, 3 * ne));
  *copy = (SolidState){solid->changed,
                       solid->lost,
                       NULL,
                       solid->pressure_load,
                       solid->nnodes,
                       solid->nfacets,
                       solid->nelements,
                       gid,
                       x,
                       u,
                       mobility,
                       acceleration,
                       facet,
                       element};
  PetscFunctionReturn(0);
}

/* Twice the area of an element with its nodes at x + ahead u. */
static double Area(const SolidState *solid, const int node[3], double ahead)
{
  double x[3][2];
  for (int k = 0; k < 6; k++) {
    const int at = 2 * node[k / 2] + k % 2;
    x[k / 2][k % 2] = solid->x[at] + ahead * solid->u[at];
  }
  return GeometryTurn(x[0], x[1], x[2]);
}

int SolidStateInverted(const SolidState *solid, double ahead)
{
  for (int e = 0; e < solid->nelements; e++)
    if (Area(solid, solid->element + 3 * e, ahead) < 0.1 * Area(solid, solid->element + 3 * e, 0.0)) return e;
  return -1;
}

PetscErrorCode SolidStateOnStartNodes(const SolidState *solid, const double value[], int n, double start[])
{
  double(*sum)[3]; /* of the corners' values, and their number */

  PetscFunctionBeginUser;
  if (!solid->start_element) {
    PetscCall(PetscArraycpy(start, value, 2 * (size_t)n));
    PetscFunctionReturn(0);
  }
  PetscCall(PetscCalloc1((size_t)n, &sum));
  for (int k = 0; k < 3 * solid->nelements; k++) {
    double *s = sum[solid->start_element[k]];
    for (int c = 0; c < 2; c++) s[c] += value[2 * solid->element[k] + c];
    s[2] += 1.0;
  }
  for (int i = 0; i < n; i++)
    for (int c = 0; c < 2; c++) start[2 * i + c] = sum[i][2] > 0.0 ? sum[i][c] / sum[i][2] : start[2 * i + c];
  PetscCall(PetscFree(sum));
  PetscFunctionReturn(0);
}
