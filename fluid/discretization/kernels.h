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

/* Volume terms that both components share: block (3 x 3, column-major) = rho/dt M + theta (m.grad u, w) +
 * theta mu (grad u, grad w); flux: m[c][i] at the vertices. */
static inline void ScalarVolume(const ElementGeometry *e, double rho_dt, double theta, double theta_mu,
                                const double flux[6], double block[9])
{
  const double m = rho_dt * e->area / 12.0, v = theta_mu * e->area;
  double b[2][3];
  P1MassApply(e->area, flux, b[0]);
  P1MassApply(e->area, flux + 3, b[1]);
  for (int j = 0; j < 3; j++)
    for (int i = 0; i < 3; i++) {
      const double *gi = e->g[i], *gj = e->g[j];
      block[3 * j + i] = m * (i == j ? 2.0 : 1.0) + theta * (b[0][i] * gj[0] + b[1][i] * gj[1]) +
                         v * (gi[0] * gj[0] + gi[1] * gj[1]);
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

/* The two Gauss points of a face, from its first node. */
static const double FACE_GAUSS[2] = {0.21132486540518712, 0.78867513459481288};

/* w[i][j] = -theta int_F min(m.n, 0) N_i N_j over the two nodes of a face, by its two Gauss points; mn: m.n at the
 * nodes. */
static inline void FaceInflow(double theta, double length, const double mn[2], double w[2][2])
{
  memset(w, 0, 4 * sizeof(double));
  for (int q = 0; q < 2; q++) {
    const double n0 = 1.0 - FACE_GAUSS[q], n1 = FACE_GAUSS[q];
    const double flux = n0 * mn[0] + n1 * mn[1], in = flux < 0.0 ? -theta * 0.5 * length * flux : 0.0;
    w[0][0] += in * n0 * n0;
    w[0][1] += in * n0 * n1;
    w[1][1] += in * n1 * n1;
  }
  w[1][0] = w[0][1];
}

/* The weak divergence of the mass flux m as the functions of element K see it, kg/(m s):
 *
 *   divergence[j] = <m.n, N_j> - (m, grad N_j),     m.n on a face common to both sides
 *
 * Advection in the form above, tested with 1 on all elements, is what leaves through the boundary less sum_j divergence[j] u_j. */
static inline void FluxDivergenceVolume(const ElementGeometry *e, const double flux[6], double divergence[3])
{
  const double x = e->area / 3.0 * (flux[0] + flux[1] + flux[2]),
               y = e->area / 3.0 * (flux[3] + flux[4] + flux[5]);
  for (int j = 0; j < 3; j++) divergence[j] = -(x * e->g[j][0] + y * e->g[j][1]);
}

/* mn: m.n at the face's vertices a and b. */
static inline void FluxDivergenceFace(double length, const double mn[2], int a, int b, double divergence[3])
{
  divergence[a] += length / 6.0 * (2.0 * mn[0] + mn[1]);
  divergence[b] += length / 6.0 * (mn[0] + 2.0 * mn[1]);
}

/* One side of a face as the kernels see it. */
typedef struct {
  const ElementGeometry *e;
  double mu, eta; /* theta times viscosity; theta times this side's share of the penalty, Pa s/m */
  int a, b;       /* the face's two vertices, in the order of the element whose rows are assembled */
} FaceSide;

/* Interior face, what both components share: rows of K.  own: block (K, K), added to; other: block (K, N),
 * written.  inflow as FaceInflow.  With k->a and k->b known to the compiler own stays in registers. */
static inline void ScalarFace(const FaceGeometry *face, const FaceSide *k, const FaceSide *nb,
                              double inflow[2][2], double own[9], double other[9])
{
  const double quarter = 0.25 * face->length, penalty = (k->eta + nb->eta) * face->length / 6.0;
  const int row[3] = {k->a, k->b, 3 - k->a - k->b}, col[3] = {nb->a, nb->b, 3 - nb->a - nb->b};
  double gk[3], gn[3]; /* a quarter of the tractions of the basis, in the order of row and col */
  for (int s = 0; s < 3; s++) {
    gk[s] = quarter * k->mu * (k->e->g[row[s]][0] * face->n[0] + k->e->g[row[s]][1] * face->n[1]);
    gn[s] = quarter * nb->mu * (nb->e->g[col[s]][0] * face->n[0] + nb->e->g[col[s]][1] * face->n[1]);
  }
  for (int q = 0; q < 3; q++) {
    double *column = other + 3 * col[q];
    for (int r = 0; r < 3; r++) {
      double o = (r < 2 ? gk[q] : 0.0) + (q < 2 ? gk[r] : 0.0),
             n = (q < 2 ? gk[r] : 0.0) - (r < 2 ? gn[q] : 0.0);
      if (r < 2 && q < 2) {
        const double v = penalty * (r == q ? 2.0 : 1.0) + inflow[r][q];
        o -= v, n -= v;
      }
      own[3 * row[q] + row[r]] -= o;
      column[row[r]] = n;
    }
  }
}

/* A vector [2][3] of an element in registers: a component's three values and an unused one. */
typedef double Lanes __attribute__((vector_size(32)));
typedef struct {
  Lanes c[2];
} ElementVector;

static inline void ElementVectorStore(const ElementVector *v, double u[6])
{
  memcpy(u, &v->c[0], 3 * sizeof *u);
  memcpy(u + 3, &v->c[1], 3 * sizeof *u);
}

/* r[c][i] += sum_j block[i][j] u[c][j] for both components.  Reads one number behind the block. */
static inline void ScalarBlockAdd(const double block[9], const double u[6], ElementVector *r)
{
  for (int j = 0; j < 3; j++) {
    Lanes column;
    memcpy(&column, block + 3 * j, sizeof column);
    r->c[0] += column * u[j];
    r->c[1] += column * u[3 + j];
  }
}

/* inverse = block^-1, both 3 x 3 in column-major order */
static inline void ScalarBlockInvert(const double b[9], double inverse[9])
{
  for (int j = 0; j < 3; j++)
    for (int i = 0; i < 3; i++) { /* the cofactor of entry (j, i) */
      const int r = (j + 1) % 3, s = (j + 2) % 3, p = (i + 1) % 3, q = (i + 2) % 3;
      inverse[3 * j + i] = b[3 * p + r] * b[3 * q + s] - b[3 * q + r] * b[3 * p + s];
    }
  const double scale = 1.0 / (b[0] * inverse[0] + b[3] * inverse[1] + b[6] * inverse[2]);
  for (int k = 0; k < 9; k++) inverse[k] *= scale;
}

/* The part of the viscous stress that couples the components, as it acts on element K (the scalar blocks have mu grad u):
 *
 *   (C u, w)_K = (sigma(u), grad w) - <{sigma(u) n}, w> - 1/2 <sigma_K(w) n, u_K - u_N>,
 *   sigma(u)   = theta mu (grad u^T - 2/3 div u I), constant on an element, stress[2 d + c] = sigma_cd */
static inline void CoupledStress(const double g[3][2], double theta_mu, const double u[6], double stress[4])
{
  double grad[2][2]; /* [c][d] = d u_c / d x_d */
  for (int c = 0; c < 2; c++)
    for (int d = 0; d < 2; d++)
      grad[c][d] = u[3 * c] * g[0][d] + u[3 * c + 1] * g[1][d] + u[3 * c + 2] * g[2][d];
  const double third = 2.0 / 3.0 * (grad[0][0] + grad[1][1]);
  stress[0] = theta_mu * (grad[0][0] - third);
  stress[1] = theta_mu * grad[0][1]; /* sigma_yx */
  stress[2] = theta_mu * grad[1][0];
  stress[3] = theta_mu * (grad[1][1] - third);
}

/* What grad w is multiplied with: volume and faces are collected in it. */
typedef struct {
  double s[4]; /* column-major, N */
} CoupledForce;

static inline void CoupledForceBegin(double area, const double stress[4], CoupledForce *f)
{
  for (int k = 0; k < 4; k++) f->s[k] = area * stress[k];
}

/* Interior face i of K, face j of N. */
static inline void CoupledForceFace(const FaceGeometry *face, int i, int j, double theta_mu,
                                    const double sk[4], const double sn[4], const double uk[6],
                                    const double un[6], CoupledForce *f, double r[6])
{
  const int a = (i + 1) % 3, b = (i + 2) % 3, oa = (j + 2) % 3, ob = (j + 1) % 3;
  const double *n = face->n, quarter = 0.25 * face->length;
  const double jump[2] = {uk[a] + uk[b] - un[oa] - un[ob], uk[3 + a] + uk[3 + b] - un[3 + oa] - un[3 + ob]};
  const double w = quarter * theta_mu, third = 2.0 / 3.0 * (n[0] * jump[0] + n[1] * jump[1]);
  for (int c = 0; c < 2; c++) {
    const double t = quarter * ((sk[c] + sn[c]) * n[0] + (sk[2 + c] + sn[2 + c]) * n[1]);
    r[3 * c + a] -= t;
    r[3 * c + b] -= t;
    for (int d = 0; d < 2; d++) f->s[2 * d + c] -= w * (n[c] * jump[d] - (c == d ? third : 0.0));
  }
}

static inline void CoupledForceEnd(const double g[3][2], const CoupledForce *f, double r[6])
{
  for (int c = 0; c < 2; c++)
    for (int i = 0; i < 3; i++) r[3 * c + i] += f->s[c] * g[i][0] + f->s[2 + c] * g[i][1];
}

/* Boundary face, both components, with the velocity prescribed in the directions that project[c][d] keeps (I: all; n n: free
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
