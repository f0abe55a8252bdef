/* Inertia and pressure of an element that an interface cuts.  Kernel: no mesh, no MPI.
 *
 * Sub-cell mass matrix W = int rho N_i N_j, rho as the phases' polygons have it, so that weight is W g.  A P2
 * pressure cannot balance it: the pressure has a kink along the interface.  Each line has one ridge function
 *
 *     psi = sum_i |d_i| lambda_i - |d|,    d(x) = n.x - d_0 the distance from the line, d_i at the vertices:
 *
 *       \        |        /      0 at the vertices and on edges that the line does not cut, one kink along
 *     ---\------/ \------/---    the line.  Hydrostatic pressure = its interpolant at the vertices
 *                                + kappa psi, exactly.
 *
 * (Moes, Cloirec, Cartraud and Remacle 2003 for such functions.)  With c = int N grad psi there are two ways:
 *
 *   kink     kappa = 1/2 [rho] g.n is known: W u+ = W u* + dt (W g - kappa c - C phi), and the pressure's
 *            matrix has W^-1; hydrostatics is exact, nothing is asked of the velocity.  What accelerates the
 *            interface is not in kappa.
 *   ridge    kappa is an unknown with c.u+ = 0 as its equation, condensed: R = Q W^-1 in place of W^-1,
 *            Q = I - W^-1 c c^T/(c^T W^-1 c).  Also exact at rest, but psi is not 0 on the edges that the
 *            line cuts, so c.u = 0 fails for a uniform u: Q slows a fluid that flows along its surface
 *            (tests/phases/test_wave.c).
 *
 * Velocity unknown 3 c + i is component c at vertex i. */
#ifndef CORACLE_PHASES_INERTIA_H
#define CORACLE_PHASES_INERTIA_H
#include "fluid/phases/polygon.h"

enum { INERTIA_NU = 6, INERTIA_RIDGES = 7 };

/* A ridge whose c^T W^-1 c is below this share of the largest one possible is dropped: the sliver that it
 * belongs to has no weight. */
#define INERTIA_SLIVER 1e-20

typedef struct {
  double x[3][2];       /* relative to the first vertex, m */
  double area;          /* m2 */
  double mass[3][3];    /* int rho N_i N_j, kg/m */
  double inverse[3][3]; /* of mass; InertiaCondense */
  int n;
  double ridge[INERTIA_RIDGES][INERTIA_NU]; /* c; after InertiaCondense orthonormal: c_a W^-1 c_b = delta */
  double moved[INERTIA_RIDGES][INERTIA_NU]; /* W^-1 c */
} Inertia;

static inline void InertiaBegin(const double x[3][2], Inertia *m)
{
  memset(m, 0, sizeof *m);
  for (int i = 0; i < 3; i++) {
    for (int c = 0; c < 2; c++) m->x[i][c] = x[i][c] - x[0][c];
  }
  m->area = 0.5 * (m->x[1][0] * m->x[2][1] - m->x[1][1] * m->x[2][0]);
}

static inline void InertiaBarycentric(const Inertia *m, const double p[2], double n[3])
{
  const double(*x)[2] = m->x, inverse = 0.5 / m->area;
  n[1] = (p[0] * x[2][1] - p[1] * x[2][0]) * inverse;
  n[2] = (x[1][0] * p[1] - x[1][1] * p[0]) * inverse;
  n[0] = 1.0 - n[1] - n[2];
}

/* A phase's polygon, relative to the element's first vertex, of density rho, kg/m3. */
static inline void InertiaAdd(const Polygon *part, double rho, Inertia *m)
{
  double n[POLYGON_MAX][3];
  for (int k = 0; k < part->n; k++) InertiaBarycentric(m, part->x[k], n[k]);
  for (int k = 1; k + 1 < part->n; k++) {
    const double *o = part->x[0], *a = part->x[k], *b = part->x[k + 1];
    const double twice = (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]),
                 w = rho * twice / 24.0;
    for (int i = 0; i < 3; i++) {
      const double si = n[0][i] + n[k][i] + n[k + 1][i];
      for (int j = 0; j < 3; j++)
        m->mass[i][j] += w * (n[0][i] * n[0][j] + n[k][i] * n[k][j] + n[k + 1][i] * n[k + 1][j] +
                              si * (n[0][j] + n[k][j] + n[k + 1][j]));
    }
  }
}

/* moment[i] += int N_i over a polygon */
static inline void InertiaMoment(const Inertia *m, const Polygon *part, double moment[3])
{
  for (int k = 1; k + 1 < part->n; k++) {
    const double *o = part->x[0], *a = part->x[k], *b = part->x[k + 1];
    const double third = ((a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0])) / 6.0;
    double n[3];
    for (int v = 0; v < 3; v++) {
      InertiaBarycentric(m, v == 0 ? o : v == 1 ? a : b, n);
      for (int i = 0; i < 3; i++) moment[i] += third * n[i];
    }
  }
}

/* The ridge along a line (unit normal), relative to the element's first vertex. */
static inline void InertiaRidge(const HalfPlane *line, Inertia *m)
{
  double *c = m->ridge[m->n], low[3] = {0.0}, high[3] = {0.0}, slope[2] = {0.0, 0.0};
  const double(*x)[2] = m->x;
  const HalfPlane other = HalfPlaneOther(line);
  const Polygon whole = {3, {{x[0][0], x[0][1]}, {x[1][0], x[1][1]}, {x[2][0], x[2][1]}}};
  Polygon part;
  if (m->n == INERTIA_RIDGES) return;
  PolygonClip(&whole, line, &part);
  InertiaMoment(m, &part, low);
  PolygonClip(&whole, &other, &part);
  InertiaMoment(m, &part, high);
  for (int i = 0; i < 3; i++) { /* grad lambda_i = the edge opposite, turned inward, over 2 |K| */
    const double *a = x[(i + 1) % 3], *b = x[(i + 2) % 3];
    const double d = fabs(line->n[0] * x[i][0] + line->n[1] * x[i][1] - line->d) / (2.0 * m->area);
    slope[0] += d * (a[1] - b[1]);
    slope[1] += d * (b[0] - a[0]);
  }
  for (int k = 0; k < 2; k++) {
    for (int i = 0; i < 3; i++) c[3 * k + i] = slope[k] * m->area / 3.0 - line->n[k] * (high[i] - low[i]);
  }
  m->n++;
}

/* force[6] = -kappa c of the last ridge added, before InertiaCondense: kappa = (below - above)/2 g.n, for
 * densities below n.x = d_0 and above it, kg/m3, and gravity, m/s2. */
static inline void InertiaKink(const Inertia *m, const double n[2], double below, double above,
                               const double g[2], double force[INERTIA_NU])
{
  const double kappa = 0.5 * (below - above) * (g[0] * n[0] + g[1] * n[1]);
  for (int i = 0; i < INERTIA_NU; i++) force[i] -= kappa * m->ridge[m->n - 1][i];
}

static inline double InertiaDot(const double a[INERTIA_NU], const double b[INERTIA_NU])
{
  double sum = 0.0;
  for (int i = 0; i < INERTIA_NU; i++) sum += a[i] * b[i];
  return sum;
}

/* out = W^-1 in */
static inline void InertiaSolve(const Inertia *m, const double in[INERTIA_NU], double out[INERTIA_NU])
{
  for (int k = 0; k < INERTIA_NU; k++) {
    const double *row = m->inverse[k % 3], *from = in + k - k % 3;
    out[k] = row[0] * from[0] + row[1] * from[1] + row[2] * from[2];
  }
}

/* Inverts the mass matrix and makes the ridges orthonormal in W^-1 (Gram and Schmidt).  Returns 0, or 1 if
 * the mass matrix is not positive. */
static inline int InertiaCondense(Inertia *m)
{
  const double(*a)[3] = m->mass;
  const double det = a[0][0] * (a[1][1] * a[2][2] - a[1][2] * a[2][1]) -
                     a[0][1] * (a[1][0] * a[2][2] - a[1][2] * a[2][0]) +
                     a[0][2] * (a[1][0] * a[2][1] - a[1][1] * a[2][0]);
  int kept = 0;
  if (!(det > 0.0)) return 1;
  for (int i = 0; i < 3; i++) {
    for (int j = 0; j < 3; j++) {
      const int p = (j + 1) % 3, q = (j + 2) % 3, r = (i + 1) % 3, s = (i + 2) % 3;
      m->inverse[i][j] = (a[p][r] * a[q][s] - a[p][s] * a[q][r]) / det;
    }
  }
  for (int k = 0; k < m->n; k++) {
    double *c = m->ridge[kept], *w = m->moved[kept];
    memmove(c, m->ridge[k], sizeof m->ridge[k]);
    InertiaSolve(m, c, w);
    const double most = m->area * m->area / a[0][0], size = InertiaDot(c, w);
    for (int b = 0; b < kept; b++) {
      const double share = InertiaDot(m->ridge[b], w);
      for (int i = 0; i < INERTIA_NU; i++) c[i] -= share * m->ridge[b][i];
    }
    InertiaSolve(m, c, w);
    const double rest = InertiaDot(c, w);
    if (!(rest > INERTIA_SLIVER * most) || rest < 1e-12 * size) continue;
    for (int i = 0; i < INERTIA_NU; i++) c[i] /= sqrt(rest), w[i] /= sqrt(rest);
    kept++;
  }
  m->n = kept;
  return 0;
}

/* out = Q W^-1 in, in a force */
static inline void InertiaResponse(const Inertia *m, const double in[INERTIA_NU], double out[INERTIA_NU])
{
  InertiaSolve(m, in, out);
  for (int b = 0; b < m->n; b++) {
    const double share = InertiaDot(m->moved[b], in);
    for (int i = 0; i < INERTIA_NU; i++) out[i] -= share * m->moved[b][i];
  }
}

/* u <- Q u */
static inline void InertiaProject(const Inertia *m, double u[INERTIA_NU])
{
  for (int b = 0; b < m->n; b++) {
    const double share = InertiaDot(m->ridge[b], u);
    for (int i = 0; i < INERTIA_NU; i++) u[i] -= share * m->moved[b][i];
  }
}
#endif
