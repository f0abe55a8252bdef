/* Kernels of the quadratic functions on one triangle, N_i the barycentric coordinates:
 *
 *            2              node    function
 *           / \             i       N_i (2 N_i - 1)           vertices, i = 0, 1, 2
 *          4   3            3 + i   4 N_(i+1)%3 N_(i+2)%3     midpoint of the edge opposite to vertex i
 *         /     \
 *        0---5---1          A field is its values p[6] at the nodes.
 *
 * The gradient of a P2 function is in P1DG: its values at the vertices are all of it.
 * No mesh, no MPI, no PETSc objects. */
#ifndef CORACLE_P2_H
#define CORACLE_P2_H

/* The P2 function with the values p at the point with barycentric coordinates n. */
static inline double P2Evaluate(const double p[6], const double n[3])
{
  double sum = 0.0;
  for (int i = 0; i < 3; i++)
    sum += n[i] * (2.0 * n[i] - 1.0) * p[i] + 4.0 * n[(i + 1) % 3] * n[(i + 2) % 3] * p[3 + i];
  return sum;
}

/* grad[i]: the gradient at vertex i, from the gradients g of the barycentric coordinates. */
static inline void P2Gradient(const double g[3][2], const double p[6], double grad[3][2])
{
  for (int m = 0; m < 3; m++) {
    double d[3];
    for (int k = 0; k < 3; k++) d[k] = k == m ? 3.0 * p[m] : 4.0 * p[3 + (3 - k - m)] - p[k];
    for (int c = 0; c < 2; c++) grad[m][c] = d[0] * g[0][c] + d[1] * g[1][c] + d[2] * g[2][c];
  }
}

/* r[q] += int_K v.grad phi_q over the P2 basis, with mv[c][i] = int_K N_i v_c (transpose of P2Gradient) */
static inline void P2GradientTranspose(const double g[3][2], const double mv[2][3], double r[6])
{
  for (int m = 0; m < 3; m++)
    for (int k = 0; k < 3; k++) {
      const double d = g[k][0] * mv[0][m] + g[k][1] * mv[1][m];
      if (k == m)
        r[m] += 3.0 * d;
      else {
        r[3 + (3 - k - m)] += 4.0 * d;
        r[k] -= d;
      }
    }
}

/* s[q][r] = coefficient int_K grad phi_q.grad phi_r over the P2 basis */
static inline void P2Stiffness(double area, const double g[3][2], double coefficient, double s[6][6])
{
  double grad[6][3][2];
  for (int q = 0; q < 6; q++) {
    double unit[6] = {0};
    unit[q] = 1.0;
    P2Gradient(g, unit, grad[q]);
  }
  for (int q = 0; q < 6; q++)
    for (int r = 0; r < 6; r++) {
      double sum = 0.0;
      for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
          sum += (i == j ? 2.0 : 1.0) * (grad[q][i][0] * grad[r][j][0] + grad[q][i][1] * grad[r][j][1]);
      s[q][r] = coefficient * area / 12.0 * sum;
    }
}

/* The same with a symmetric tensor k = (xx, xy, yy) as the coefficient. */
static inline void P2StiffnessTensor(double area, const double g[3][2], const double k[3], double s[6][6])
{
  double grad[6][3][2];
  for (int q = 0; q < 6; q++) {
    double unit[6] = {0};
    unit[q] = 1.0;
    P2Gradient(g, unit, grad[q]);
  }
  for (int q = 0; q < 6; q++)
    for (int r = 0; r < 6; r++) {
      double sum = 0.0;
      for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
          const double *a = grad[q][i], *b = grad[r][j];
          sum += (i == j ? 2.0 : 1.0) *
                 (k[0] * a[0] * b[0] + k[1] * (a[0] * b[1] + a[1] * b[0]) + k[2] * a[1] * b[1]);
        }
      s[q][r] = area / 12.0 * sum;
    }
}

/* The Galerkin projection p1[3] of a P2 function on P1: int_K N_i p1 = int_K N_i p.  int N_i phi_j / area is
 * 1/30 and -1/60 at the vertex i and the others, 2/15 on the edges at i, 1/15 on the opposite one. */
static inline void P2ProjectP1(const double p[6], double p1[3])
{
  double r[3], sum = 0.0;
  for (int i = 0; i < 3; i++) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    r[i] = p[i] / 30.0 - (p[j] + p[k]) / 60.0 + 2.0 / 15.0 * (p[3 + j] + p[3 + k]) + p[3 + i] / 15.0;
    sum += r[i];
  }
  for (int i = 0; i < 3; i++) p1[i] = 12.0 * (r[i] - 0.25 * sum);
}
#endif
