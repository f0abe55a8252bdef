#include "common/program/outline_case.h"
#include "common/link/case_key.h"
#include "common/supermesh/outline.h"

/* Sides that are not neighbours have no point in common, and it is made of triangles. */
static PetscErrorCode CheckSimple(CoracleCase c, const char *key, int n, const double x[][2])
{
  int i, j, (*triangle)[3];
  PetscFunctionBeginUser;
  if (OutlineMeets(n, x, &i, &j))
    CoracleCaseRefuse(c, key, "the polygon meets itself: side %d, from (%g, %g), and side %d, from (%g, %g)",
                      i, x[i][0], x[i][1], j, x[j][0], x[j][1]);
  PetscCall(PetscMalloc1(n, &triangle));
  if (OutlineTriangles(n, x, triangle) != n - 2) CoracleCaseRefuse(c, key, "the polygon has no area");
  PetscCall(PetscFree(triangle));
  PetscFunctionReturn(0);
}

PetscErrorCode CaseReadOutline(CoracleCase c, const char *key, int *n, double (**x)[2])
{
  char corner[CASE_KEY];
  PetscFunctionBeginUser;
  *n = CoracleCaseCount(c, key);
  if (*n < 3) CoracleCaseRefuse(c, key, "expected at least three corners, found %d", *n);
  PetscCall(PetscMalloc1(*n, x));
  for (int i = 0; i < *n; i++) CoracleCaseVector(c, CaseKey(corner, "%s[%d]", key, i), 2, (*x)[i]);
  PetscCall(CheckSimple(c, key, *n, (const double(*)[2]) * x));
  PetscFunctionReturn(0);
}

/* As a mesh keeps them (common/mesh/mesh.h). */
enum { SIDE_NAME = 64 };

PetscErrorCode CaseReadSides(CoracleCase c, const char *key, int n, const char ***name)
{
  const PetscBool named = (PetscBool)CoracleCaseHas(c, key);
  const int count = CoracleCaseCount(c, key);
  char side[CASE_KEY];
  PetscFunctionBeginUser;
  if (named && count != n)
    CoracleCaseRefuse(c, key, "expected a name of each of the %d sides, found %d names", n, count);
  PetscCall(PetscMalloc1(n, name));
  for (int k = 0; k < n; k++) {
    (*name)[k] = named ? CoracleCaseString(c, CaseKey(side, "%s[%d]", key, k)) : "boundary";
    if (strlen((*name)[k]) >= SIDE_NAME)
      CoracleCaseRefuse(c, side, "expected a name shorter than %d characters", SIDE_NAME);
  }
  PetscFunctionReturn(0);
}
