/* Private to the transfer room: triangles that are in two sets, bit for bit, found by hashing their vertices.
 */
#ifndef CORACLE_MATCH_H
#define CORACLE_MATCH_H
#include <petscsys.h>
#include <stdint.h>

/* Does not depend on the order of the vertices.  Not collective, as all here. */
uint64_t MatchHash(const double x[3][2]);
/* match[nb]: 3 s + turn where vertex i of b[t] is vertex (i + turn) % 3 of a[s], or -1. */
PetscErrorCode MatchTriangles(int na, const double a[][3][2], int nb, const double b[][3][2], int match[]);
#endif
