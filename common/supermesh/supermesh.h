/* The supermesh of two sets of triangles: for every pair that overlaps, the exact integrals of products of
 * their P1 functions over the common polygon,
 *
 *        b ___                      area        |A and B|
 *       / |   \      a - - -        aa[i][j]    int N_A,i N_A,j
 *      /  |####\   /                ab[i][j]    int N_A,i N_B,j
 *     /___|#####\/                  bb[i][j]    int N_B,i N_B,j
 *         |_____/
 *
 * which is all that a Galerkin projection between P1DG fields needs (Farrell and Maddison 2011), and all that
 * the coupling of a solid with the fluid needs.  The triangles of one set may overlap each other and need not
 * cover the other set. Serial, no MPI; 0 is returned, or 1 when there is no memory. */
#ifndef CORACLE_SUPERMESH_H
#define CORACLE_SUPERMESH_H
#include "search.h"

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

typedef enum { SUPERMESH_A_TO_B, SUPERMESH_B_TO_A } SupermeshDirection;

/* Galerkin projection of ncomp P1DG fields, source[ns][ncomp][3] -> target[nt][ncomp][3]:
 *     for each target triangle T:   int_T N_i q_T = sum over source S of int_{S and T} N_i q_S
 * x[nt][3][2]: the target's triangles.  Integrals are conserved to round-off where sources do not overlap
 * each other or leave the target; a P1 field is reproduced on targets that are covered; elsewhere the source
 * counts as 0. */
void SupermeshProject(const SupermeshPairs *pairs, SupermeshDirection direction, int nt,
                      const double x[][3][2], int ncomp, const double source[], double target[]);
#endif
