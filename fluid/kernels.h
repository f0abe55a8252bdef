/* Pointwise physics of P1DG-P2: one element or one face in, one small block out.  No mesh, no MPI, no PETSc
 * objects.
 *
 * Weak form of the momentum equation on element K, test function w in P1(K)^2, L the advective and viscous
 * operator, m the mass flux rho beta:
 *
 *   (rho (u* - u^n)/dt, w) + theta L(u*, w) + (1 - theta) L(u^n, w) + (a u*, w)
 *                                                                = (rho g - grad p, w) + (s, w)
 *
 *   L(u, w) = (m.grad u, w) - <min(m.n, 0) (u_K - u_N), w>          upwind, not integrated by parts
 *           + (tau(u), grad w)                                      viscous stress, symmetric interior penalty:
 *           - <{tau(u) n}, [w]> - <{tau(w) n}, [u]> + <eta [u], [w]>
 *
 *   tau(u)  = mu (grad u + grad u^T - 2/3 div u I)
 *
 *           2                 vertices 0, 1, 2 counter-clockwise;  face i lies opposite to vertex i, its vertices
 *          / \                are (i + 1) % 3 and (i + 2) % 3, its normal points out;
 *     (4) /   \ (3)           P2 node 3 + i is the midpoint of face i
 *        /     \
 *       0-------1
 *          (5)
 *
 * A block is 6 x 6 in column-major order; row and column 3 c + i is component c at vertex i:
 *
 *           d=0        d=1
 *   c=0  [ 3 x 3 ]  [ 3 x 3 ]      block[6 * (3 d + j) + 3 c + i]
 *   c=1  [ 3 x 3 ]  [ 3 x 3 ]                                                                              */
#ifndef FLUID_KERNELS_H
#define FLUID_KERNELS_H
#include "common/space/element.h"
#include "common/space/p1.h"
#include "common/space/p2.h"
#include <math.h>
#include <string.h>

/* Interior-penalty safety factor: 1 is the limit of coercivity for the full stress on P1 triangles. */
#define PENALTY_FACTOR 1.25

/* Volume terms: block = rho/dt M + theta ((m.grad u, w) + (tau(u), grad w)); flux: m[c][i] at the vertices. */
static inline void MomentumVolume(const ElementGeometry *e, double rho_dt, double theta, double theta_mu,
                                  const double flux[6], double block[36])
{
  const double m = rho_dt * e->area / 12.0, v = theta_mu * e->area;
  double b[2][3];
  P1MassApply(e->area, flux, b[0]);
  P1MassApply(e->area, flux + 3, b[1]);
  for (int j = 0; j < 3; j++)
    for (int i = 0; i < 3; i++) {
      const double *gi = e->g[i], *gj = e->g[j];
      const double scalar = m * (i == j ? 2.0 : 1.0) + theta * (b[0][i] * gj[0] + b[1][i] * gj[1]) +
                            v * (gi[0] * gj[0] + gi[1] * gj[1]);
      for (int d = 0; d < 2; d++)
        for (int c = 0; c < 2; c++)
          block[6 * (3 * d + j) + 3 * c + i] =
              (c == d ? scalar : 0.0) + v * (gi[d] * gj[c] - 2.0 / 3.0 * gi[c] * gj[d]);
    }
}

/* t[c][3 d + j] = component c of tau(N_j e_d) n */
static inline void Traction(const double g[3][2], double mu, const double n[2], double t[2][6])
{
  for (int j = 0; j < 3; j++) {
    const double gn = mu * (g[j][0] * n[0] + g[j][1] * n[1]);
    for (int d = 0; d < 2; d++)
      for (int c = 0; c < 2; c++)
        t[c][3 * d + j] = (c == d ? gn : 0.0) + mu * (g[j][c] * n[d] - 2.0 / 3.0 * g[j][d] * n[c]);
  }
}

/* w[i][j] = -theta int_F min(m.n, 0) N_i N_j over the two nodes of a face, by its two Gauss points; mn: m.n at the
 * nodes. */
static inline void FaceInflow(double theta, double length, const double mn[2], double w[2][2])
{
  const double GAUSS = 0.21132486540518712; /* (1 - 1/sqrt 3)/2 */
  memset(w, 0, 4 * sizeof(double));
  for (int q = 0; q < 2; q++) {
    const double s = q ? 1.0 - GAUSS : GAUSS, n0 = 1.0 - s, n1 = s;
    const double in = -theta * 0.5 * length * fmin(n0 * mn[0] + n1 * mn[1], 0.0);
    w[0][0] += in * n0 * n0;
    w[0][1] += in * n0 * n1;
    w[1][1] += in * n1 * n1;
  }
  w[1][0] = w[0][1];
}

/* One side of a face as the kernels see it. */
typedef struct {
  const ElementGeometry *e;
  double mu, eta; /* theta times viscosity; theta times this side's share of the penalty, Pa s/m */
  int a, b;       /* the face's two vertices, in the order of the element whose rows are assembled */
} FaceSide;

/* Interior face: rows of K.  own: block (K, K), added to; other: block (K, N), written.  inflow as
 * FaceInflow, theta included. */
static inline void MomentumFace(const FaceGeometry *face, const FaceSide *k, const FaceSide *nb,
                                double inflow[2][2], double own[36], double other[36])
{
  const double quarter = 0.25 * face->length, eta = k->eta + nb->eta;
  const int rows[2] = {k->a, k->b}, cols[2] = {nb->a, nb->b};
  double tk[2][6], tn[2][6];
  Traction(k->e->g, k->mu, face->n, tk);
  Traction(nb->e->g, nb->mu, face->n, tn);
  memset(other, 0, 36 * sizeof(double));
  for (int c = 0; c < 2; c++)
    for (int r = 0; r < 2; r++) {
      const int row = 3 * c + rows[r], col_own = row, col_other = 3 * c + cols[r];
      for (int s = 0; s < 6; s++) {
        own[6 * s + row] -= quarter * tk[c][s];
        other[6 * s + row] -= quarter * tn[c][s];
        own[6 * col_own + s] -= quarter * tk[c][s];
        other[6 * col_other + s] += quarter * tk[c][s];
      }
      for (int q = 0; q < 2; q++) {
        const double v = eta * face->length / 6.0 * (r == q ? 2.0 : 1.0) + inflow[r][q];
        own[6 * (3 * c + rows[q]) + row] += v;
        other[6 * (3 * c + cols[q]) + row] -= v;
      }
    }
}

/* Boundary face with the velocity prescribed in the directions that project[c][d] keeps (I: all; n n: free
 * slip).  own: block (K, K), added to.  lift[4][6], written: lift[2 d + r] is the load of the element's six rows
 * per unit of prescribed velocity, component d at face node r. */
static inline void MomentumBoundaryFace(const FaceGeometry *face, const FaceSide *k,
                                        const double project[2][2], double inflow[2][2], double own[36],
                                        double lift[4][6])
{
  const double half = 0.5 * face->length;
  const int node[2] = {k->a, k->b};
  double t[2][6], pt[2][6];
  Traction(k->e->g, k->mu, face->n, t);
  for (int c = 0; c < 2; c++)
    for (int s = 0; s < 6; s++) pt[c][s] = project[c][0] * t[0][s] + project[c][1] * t[1][s];
  memset(lift, 0, 24 * sizeof(double));
  for (int c = 0; c < 2; c++)
    for (int r = 0; r < 2; r++)
      for (int s = 0; s < 6; s++) {
        own[6 * s + 3 * c + node[r]] -= half * pt[c][s];
        own[6 * (3 * c + node[r]) + s] -= half * pt[c][s];
        lift[2 * c + r][s] -= half * pt[c][s];
      }
  for (int c = 0; c < 2; c++)
    for (int d = 0; d < 2; d++)
      for (int r = 0; r < 2; r++)
        for (int q = 0; q < 2; q++) {
          const double v = project[c][d] * k->eta * face->length / 6.0 * (r == q ? 2.0 : 1.0) +
                           (c == d ? inflow[r][q] : 0.0);
          own[6 * (3 * d + node[q]) + 3 * c + node[r]] += v;
          lift[2 * d + q][3 * c + node[r]] += v;
        }
}
#endif
