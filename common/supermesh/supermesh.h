/* The supermesh of two sets of triangles: for every pair that overlaps, the exact integrals of products of
 * their P1 functions over the common polygon,
 *
 *        b ___                      area        |A and B|
 *       / |   \      a - - -        aa[i][j]    int N_A,i N_A,j
 *      /  |####\   /                ab[i][j]    int N_A,i N_B,j
 *     /___|#####\/                  bb[i][j]    int N_B,i N_B,j
 *         |_____/
 *
 * which is all that the coupling of a solid with the fluid needs; a Galerkin projection (projection.h) needs
 * ab only.  The triangles of one set may overlap each other and need not
 * cover the other set. Serial, no MPI; 0 is returned, or 1 when there is no memory. */
#ifndef CORACLE_SUPERMESH_H
#define CORACLE_SUPERMESH_H
#include "common/supermesh/search.h"

typedef struct {
  int a, b;
  double area;
  double aa[3][3], ab[3][3], bb[3][3];
} SupermeshPair;

/* Zero-initialise before the first use; the memory is kept from one call to the next. */
typedef struct {
  int n, capacity;
  SupermeshPair *pair; /* [n], ascending in a */
} SupermeshPairs;

/* All pairs of a[na][3][2] and b[nb][3][2], both counter-clockwise; search: made of b by
 * SearchCreateTriangles.  A triangle without positive area has no pairs; neither has a common area below
 * 1e-14 of the smaller triangle (what round-off makes of a shared edge). */
int SupermeshIntersect(int na, const double a[][3][2], Search search, const double b[][3][2],
                       SupermeshPairs *pairs);
void SupermeshPairsDestroy(SupermeshPairs *pairs);

/* One pair; returns 0 when they share nothing.  a and b in pair are left alone. */
int SupermeshIntegrate(const double a[3][2], const double b[3][2], SupermeshPair *pair);
/* The same integrals of N_A,i N_B,j alone; mixed[i][j] is left alone when they share nothing. */
int SupermeshMixed(const double a[3][2], const double b[3][2], double mixed[3][3]);
#endif
