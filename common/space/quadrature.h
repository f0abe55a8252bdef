/* Quadrature on a triangle: int_K f = area sum_k weight[k] f(point[k]).  No mesh, no MPI, no PETSc objects.
 * */
#ifndef CORACLE_QUADRATURE_H
#define CORACLE_QUADRATURE_H

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
#endif
