/* Quadrature on a triangle, and the triangles of a convex polygon: int_K f = area sum_k weight[k] f(point[k]). */
#ifndef TESTS_QUADRATURE_H
#define TESTS_QUADRATURE_H

typedef struct {
  int n;
  double point[6][3]; /* barycentric */
  double weight[6];   /* sum 1 */
} Quadrature;

/* Exact for polynomials of the degree: 2 (3 points), 3 (4 points), 4 (6 points); Strang and Fix 1973,
 * Dunavant 1985. */
static inline const Quadrature *QuadratureOf(int degree)
{
#define QUADRATURE_ORBIT(a)                                                                                  \
  {1.0 - 2.0 * (a), a, a}, {a, 1.0 - 2.0 * (a), a},                                                          \
  {                                                                                                          \
    a, a, 1.0 - 2.0 * (a)                                                                                    \
  }
  static const Quadrature TWO = {3, {QUADRATURE_ORBIT(1.0 / 6.0)}, {1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0}};
  static const Quadrature THREE = {4,
                                   {{1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0}, QUADRATURE_ORBIT(0.2)},
                                   {-27.0 / 48.0, 25.0 / 48.0, 25.0 / 48.0, 25.0 / 48.0}};
  static const Quadrature FOUR = {
      6,
      {QUADRATURE_ORBIT(0.445948490915965), QUADRATURE_ORBIT(0.09157621350977073)},
      {0.2233815896780115, 0.2233815896780115, 0.2233815896780115, 0.1099517436553219, 0.1099517436553219,
       0.1099517436553219}};
#undef QUADRATURE_ORBIT
  return degree <= 2 ? &TWO : degree == 3 ? &THREE : &FOUR;
}

/* Triangle k = 0 .. n - 3 of the fan around the polygon's first vertex. */
static inline void PolygonFan(const double polygon[][2], int k, double x[3][2])
{
  for (int c = 0; c < 2; c++) {
    x[0][c] = polygon[0][c];
    x[1][c] = polygon[k + 1][c];
    x[2][c] = polygon[k + 2][c];
  }
}
#endif
