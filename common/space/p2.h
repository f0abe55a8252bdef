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

/* s[q][r] = int_K grad phi_q . K grad phi_r over the P2 basis, from p1[i][j] = the same over the P1 basis, K
 * constant and symmetric on the triangle (the rows of p1 add to 0). */
static inline void P2StiffnessOfP1(const double p1[3][3], double s[6][6])
{
  for (int i = 0; i < 3; i++) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    s[i][i] = p1[i][i];
    s[i][j] = s[j][i] = -p1[i][j] / 3.0;
    s[i][3 + i] = s[3 + i][i] = 0.0;
    s[i][3 + k] = s[3 + k][i] = 4.0 / 3.0 * p1[i][j];
    s[i][3 + j] = s[3 + j][i] = 4.0 / 3.0 * p1[i][k];
    s[3 + i][3 + i] = 8.0 / 3.0 * (p1[j][j] + p1[k][k] + p1[j][k]);
    s[3 + i][3 + j] = s[3 + j][3 + i] = 8.0 / 3.0 * p1[i][j];
  }
}

/* s[q][r] = coefficient int_K grad phi_q.grad phi_r over the P2 basis */
static inline void P2Stiffness(double area, const double g[3][2], double coefficient, double s[6][6])
{
  double p1[3][3];
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) p1[i][j] = coefficient * area * (g[i][0] * g[j][0] + g[i][1] * g[j][1]);
  P2StiffnessOfP1((const double(*)[3])p1, s);
}

/* The same with a symmetric tensor k = (xx, xy, yy) as the coefficient. */
static inline void P2StiffnessTensor(double area, const double g[3][2], const double k[3], double s[6][6])
{
  double p1[3][3];
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      p1[i][j] = area * (k[0] * g[i][0] * g[j][0] + k[1] * (g[i][0] * g[j][1] + g[i][1] * g[j][0]) +
                         k[2] * g[i][1] * g[j][1]);
  P2StiffnessOfP1((const double(*)[3])p1, s);
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
