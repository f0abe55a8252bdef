/* Kernels of the linear functions on one triangle: P1 where vertices are shared, P1DG where each triangle has
 * its own.  The basis are the barycentric coordinates N_0, N_1, N_2; a field is its values q[3] at the
 * vertices, in a P1DG field of a mesh [ne][ncomp][3].
 *
 *     int_K N_i N_j = area/12 (1 + delta_ij)        int_K N_i = area/3        grad N_i constant
 *
 * No mesh, no MPI, no PETSc objects. */
#ifndef CORACLE_P1_H
#define CORACLE_P1_H

/* m[i] = int_K N_i q */
static inline void P1MassApply(double area, const double q[3], double m[3])
{
  const double sum = q[0] + q[1] + q[2];
  for (int i = 0; i < 3; i++) m[i] = area / 12.0 * (sum + q[i]);
}

/* the inverse of P1MassApply */
static inline void P1MassSolve(double area, const double m[3], double q[3])
{
  const double sum = m[0] + m[1] + m[2];
  for (int i = 0; i < 3; i++) q[i] = 3.0 / area * (4.0 * m[i] - sum);
}

/* g[i] = grad N_i of the counter-clockwise triangle x, 1/m; returns the area. */
static inline double P1Gradients(const double x[3][2], double g[3][2])
{
  const double twice = (x[1][0] - x[0][0]) * (x[2][1] - x[0][1]) - (x[2][0] - x[0][0]) * (x[1][1] - x[0][1]);
  for (int i = 0; i < 3; i++) {
    const double *a = x[(i + 1) % 3], *b = x[(i + 2) % 3];
    g[i][0] = (a[1] - b[1]) / twice;
    g[i][1] = (b[0] - a[0]) / twice;
  }
  return 0.5 * twice;
}

/* d[c][e] = d u_c / d x_e of u[c][i] with gradients g of the basis. */
static inline void P1VelocityGradient(const double g[3][2], const double u[2][3], double d[2][2])
{
  for (int c = 0; c < 2; c++)
    for (int e = 0; e < 2; e++) d[c][e] = u[c][0] * g[0][e] + u[c][1] * g[1][e] + u[c][2] * g[2][e];
}
#endif
