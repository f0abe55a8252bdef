/* A polygon in a case file. */
#ifndef CORACLE_OUTLINE_CASE_H
#define CORACLE_OUTLINE_CASE_H
#include "common/link/case_file.h"
#include <petscsys.h>

/* Not collective: the corners, m, at key, a list of [x, y], (*x)[*n][2] to be PetscFree'd.  Refuses less than three, and a polygon that meets itself
 * or has no area. */
PetscErrorCode CaseReadOutline(CoracleCase c, const char *key, int *n, double (**x)[2]);
/* Not collective: the names of a polygon's n sides, (*name)[n] to be PetscFree'd; without the key all are called boundary. */
PetscErrorCode CaseReadSides(CoracleCase c, const char *key, int n, const char ***name);
#endif
