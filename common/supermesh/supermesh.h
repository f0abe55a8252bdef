/* The supermesh of two sets of triangles: for every pair that overlaps, the moments of the common polygon P,
 *
 *        b ___                      area      |P|
 *       / |   \      a - - -        centre    c = int_P x / |P|
 *      /  |####\   /                second    S = int_P (x - c)(x - c)^T
 *     /___|#####\/
 *         |_____/
 *
 * which give the exact integral of the product of any two linear functions, those of the triangles above all:
 *
 *     int_P f g  =  |P| f(c) g(c) + grad f . S grad g.
 *
 * The triangles of one set may overlap each other and need not cover the other set.
 * Serial, no MPI; 0 is returned, or 1 when there is no memory. */
#ifndef CORACLE_SUPERMESH_H
#define CORACLE_SUPERMESH_H
#include "common/supermesh/search.h"

typedef struct {
  int a, b;
  double area;      /* m2 */
  double centre[2]; /* from vertex 0 of a, m */
  double second[3]; /* xx, xy, yy, m4 */
} SupermeshPair;

/* Zero-initialise before the first use; the memory is kept from one call to the next. */
typedef struct {
  int n, capacity;
  SupermeshPair *pair; /* [n], ascending in a */
} SupermeshPairs;

/* All pairs of a[na][3][2] and b[nb][3][2], both counter-clockwise; search: made of b by
 * SearchCreateTriangles.  A triangle without positive area has no pairs; neither has a common area below
 * 1e-13 of the smaller triangle (what round-off makes of a shared edge). */
int SupermeshIntersect(int na, const double a[][3][2], Search search, const double b[][3][2],
                       SupermeshPairs *pairs);
void SupermeshPairsDestroy(SupermeshPairs *pairs);

/* A triangle's P1 functions N_1, N_2 by their gradients, 1/m; both are 0 at vertex 0, the origin, and N_0 = 1 - N_1 - N_2. */
typedef struct {
  double origin[2], gradient[2][2];
} SupermeshBasis;

static inline SupermeshBasis SupermeshBasisOf(const double x[3][2])
{
  const double inverse = 1.0 / GeometryTurn(x[0], x[1], x[2]);
  return (SupermeshBasis){{x[0][0], x[0][1]},
                          {{inverse * (x[2][1] - x[0][1]), inverse * (x[0][0] - x[2][0])},
                           {inverse * (x[0][1] - x[1][1]), inverse * (x[1][0] - x[0][0])}}};
}

/* The pair's centre from the origin of b's basis, m. */
static inline void SupermeshCentreInB(const SupermeshPair *pair, const SupermeshBasis *a,
                                      const SupermeshBasis *b, double centre[2])
{
  for (int c = 0; c < 2; c++) centre[c] = pair->centre[c] + (a->origin[c] - b->origin[c]);
}

/* product[i][j] = int over the pair of N_i of a and N_j of b, or of a again. */
static inline void SupermeshProduct(const SupermeshPair *pair, const SupermeshBasis *a,
                                    const SupermeshBasis *b, double product[3][3])
{
  const double *s = pair->second, *da = pair->centre;
  double db[2];
  double at_b[3] = {1.0, 0.0, 0.0}, sum[3] = {0.0};
  SupermeshCentreInB(pair, a, b, db);
  for (int j = 1; j < 3; j++) {
    at_b[j] = b->gradient[j - 1][0] * db[0] + b->gradient[j - 1][1] * db[1];
    at_b[0] -= at_b[j];
  }
  for (int j = 0; j < 3; j++) product[0][j] = pair->area * at_b[j];
  for (int i = 1; i < 3; i++) {
    const double *g = a->gradient[i - 1], at_a = g[0] * da[0] + g[1] * da[1];
    const double sg[2] = {s[0] * g[0] + s[1] * g[1], s[1] * g[0] + s[2] * g[1]};
    for (int j = 1; j < 3; j++)
      product[i][j] =
          pair->area * at_a * at_b[j] + sg[0] * b->gradient[j - 1][0] + sg[1] * b->gradient[j - 1][1];
    product[i][0] = pair->area * at_a - product[i][1] - product[i][2];
    for (int j = 0; j < 3; j++) sum[j] += product[i][j];
  }
  for (int j = 0; j < 3; j++) product[0][j] -= sum[j];
}
#endif
