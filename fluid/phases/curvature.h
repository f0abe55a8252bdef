/* Curvature of an interface from the volumes of the elements that it cuts.  Kernel: no mesh, no MPI.
 *
 *           h                         In a frame on the interface, h along the normal out of the first phase, s along
 *           |    __---__              the tangent, the interface is fitted with an arc
 *        __-+--/--   . \__
 *      /.   |           .  \              h(s) = a + b s - c s^2/2 + b c^2 s^3/2 - c^3 s^4/8
 *     ------+---------------- s
 *
 * by least squares of the elements' volumes below it (Renardy and Renardy 2002 for parabolas, on squares).  The area of a
 * polygon below the arc is the integral of min(h, h of its outline) ds along its outline.  The higher powers are those of a
 * circle, so that circles of a few elements across are found.  At a wall, or a solid's surface, the contact angle is one
 * more condition: the slope at the contact point. */
#ifndef CORACLE_PHASES_CURVATURE_H
#define CORACLE_PHASES_CURVATURE_H
#include <math.h>

enum { CURVATURE_CELLS = 64, CURVATURE_CORNERS = 4, CURVATURE_CONTACTS = 8, CURVATURE_ITERATIONS = 12 };

/* What the conditions at walls weigh beside all elements together. */
#define CURVATURE_CONTACT 10.0

/* What a cut element has outside of solids: corners (s, h), counter-clockwise, m; the first phase's volume, m2. */
typedef struct {
  int n;
  double x[CURVATURE_CORNERS][2], volume, weight;
} CurvatureCell;

typedef struct {
  double s, slope; /* m; dh/ds */
} CurvatureContact;

/* length: of the neighbourhood, m */
typedef struct {
  int n, ncontacts;
  double length;
  CurvatureCell cell[CURVATURE_CELLS];
  CurvatureContact contact[CURVATURE_CONTACTS];
} CurvatureData;

/* h(s) = f[0] + f[1] s - f[2] s^2/2 + f[3] s^3 - f[4] s^4 */
typedef struct {
  double f[5];
} CurvatureArc;

/* Area below, and its derivatives by f[0 .. 2]. */
typedef struct {
  double area, derivative[3];
} CurvatureBelow;

/* Adds -integral of h, where the arc is the lower one, or of the edge (p + q s) from s0 to s1. */
static inline void CurvatureAddPart(const CurvatureArc *arc, double p, double q, double s0, double s1,
                                    CurvatureBelow *below)
{
  const double *f = arc->f, m = 0.5 * (s0 + s1), d = s1 - s0, ss = s0 * s0 + s0 * s1 + s1 * s1;
  if (f[0] - p + m * (f[1] - q - 0.5 * f[2] * m) > 0.0) {
    below->area -= d * (p + q * m);
    return;
  }
  const double s2 = d * ss / 3.0, s3 = 0.5 * d * m * (s0 * s0 + s1 * s1),
               s4 = d * (s0 * s0 * s0 * s0 + s1 * s1 * s1 * s1 + s0 * s1 * ss) / 5.0;
  below->area -= d * (f[0] + f[1] * m) - 0.5 * f[2] * s2 + f[3] * s3 - f[4] * s4;
  below->derivative[0] -= d;
  below->derivative[1] -= d * m;
  below->derivative[2] += 0.5 * s2;
}

/* The edge a -> b, divided where it crosses the arc (without its higher powers). */
static inline void CurvatureAddEdge(const CurvatureArc *arc, const double a[2], const double b[2],
                                    CurvatureBelow *below)
{
  const double d = b[0] - a[0];
  if (d == 0.0) return;
  const double q = (b[1] - a[1]) / d, p = a[1] - q * a[0];
  const double c0 = arc->f[0] - p, c1 = arc->f[1] - q, c2 = -0.5 * arc->f[2]; /* arc less edge */
  double cut[4] = {a[0], b[0], b[0], b[0]};
  int n = 1;
  const double square = c1 * c1 - 4.0 * c0 * c2;
  if (square > 0.0) {
    const double w = -0.5 * (c1 + copysign(sqrt(square), c1));
    double root[2] = {w != 0.0 ? c0 / w : a[0], c2 != 0.0 ? w / c2 : a[0]};
    if ((root[0] > root[1]) == (d > 0.0)) {
      const double swap = root[0];
      root[0] = root[1];
      root[1] = swap;
    }
    for (int k = 0; k < 2; k++)
      if ((root[k] - a[0]) * (b[0] - root[k]) > 0.0) cut[n++] = root[k];
    cut[n] = b[0];
  }
  for (int k = 0; k < n; k++) CurvatureAddPart(arc, p, q, cut[k], cut[k + 1], below);
}

/* Solves a symmetric system a x = r of three equations; 0 if it is singular. */
static inline int CurvatureSolve(const double a[3][3], const double r[3], double x[3])
{
  double cof[3][3], det = 0.0;
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) {
      const int p = (i + 1) % 3, q = (i + 2) % 3, u = (j + 1) % 3, v = (j + 2) % 3;
      cof[i][j] = a[p][u] * a[q][v] - a[p][v] * a[q][u];
    }
  for (int j = 0; j < 3; j++) det += a[0][j] * cof[0][j];
  if (!(fabs(det) > 1e-10 * a[0][0] * a[1][1] * a[2][2])) return 0;
  for (int i = 0; i < 3; i++) x[i] = (cof[i][0] * r[0] + cof[i][1] * r[1] + cof[i][2] * r[2]) / det;
  return 1;
}

/* An arc, the weighted sum of its squared errors, and the step of Gauss and Newton from it, in units of the length. */
typedef struct {
  CurvatureArc arc;
  double energy, step[3];
  int determined;
} CurvatureState;

/* The equation of cell k, or of contact k - n: row . change of f[0 .. 2] = value, in units of the length; returns its weight,
 * that of the contacts being that of all cells together, `cells`. */
static inline double CurvatureEquation(const CurvatureData *data, const CurvatureArc *arc, int k,
                                       double cells, double row[3], double *value)
{
  const double l = data->length, *f = arc->f;
  if (k < data->n) {
    const CurvatureCell *c = &data->cell[k];
    CurvatureBelow below = {0.0, {0.0, 0.0, 0.0}};
    for (int i = 0; i < c->n; i++) CurvatureAddEdge(arc, c->x[i], c->x[(i + 1) % c->n], &below);
    *value = (c->volume - below.area) / (l * l);
    row[0] = below.derivative[0] / l;
    row[1] = below.derivative[1] / (l * l);
    row[2] = below.derivative[2] / (l * l * l);
    return c->weight;
  }
  const CurvatureContact *c = &data->contact[k - data->n];
  row[0] = 0.0;
  row[1] = 1.0;
  row[2] = -c->s / l;
  *value = c->slope - f[1] + c->s * (f[2] - 3.0 * c->s * f[3] + 4.0 * c->s * c->s * f[4]);
  return CURVATURE_CONTACT * cells;
}

static inline void CurvatureEvaluate(const CurvatureData *data, const double f[3], CurvatureState *state)
{
  const double most = 2.0 / data->length;
  double a[3][3] = {{0.0}}, r[3] = {0.0}, cells = 0.0;
  state->arc = (CurvatureArc){{f[0], f[1], fmax(fmin(f[2], most), -most), 0.0, 0.0}};
  state->arc.f[3] = 0.5 * state->arc.f[1] * state->arc.f[2] * state->arc.f[2];
  state->arc.f[4] = 0.125 * state->arc.f[2] * state->arc.f[2] * state->arc.f[2];
  state->energy = 0.0;
  for (int k = 0; k < data->n + data->ncontacts; k++) {
    double row[3], value;
    const double weight = CurvatureEquation(data, &state->arc, k, cells, row, &value);
    if (k < data->n) cells += weight * row[0] * row[0];
    state->energy += weight * value * value;
    for (int i = 0; i < 3; i++) {
      for (int j = 0; j < 3; j++) a[i][j] += weight * row[i] * row[j];
      r[i] += weight * row[i] * value;
    }
  }
  state->determined = CurvatureSolve((const double(*)[3])a, r, state->step);
}

/* *curvature at s = 0, 1/m, positive where the first phase is convex; 0 is returned where there is too little to fit.  Steps are
 * halved until the errors decrease. */
static inline int CurvatureFit(const CurvatureData *data, double *curvature)
{
  const double l = data->length, scale[3] = {l, 1.0, 1.0 / l}, start[3] = {0.0, 0.0, 0.0};
  CurvatureState now, next;
  CurvatureEvaluate(data, start, &now);
  if (!now.determined) return 0;
  for (int k = 0; k < CURVATURE_ITERATIONS; k++) {
    double size = 0.0, part = 1.0;
    for (int half = 0; half < 8; half++, part *= 0.5) {
      double f[3];
      for (int i = 0; i < 3; i++) f[i] = now.arc.f[i] + part * scale[i] * now.step[i];
      CurvatureEvaluate(data, f, &next);
      if (next.determined && next.energy < now.energy) break;
    }
    if (!next.determined || !(next.energy < now.energy)) break;
    for (int i = 0; i < 3; i++) size = fmax(size, part * fabs(now.step[i]));
    now = next;
    if (size < 1e-10) break;
  }
  const double root = sqrt(1.0 + now.arc.f[1] * now.arc.f[1]);
  *curvature = now.arc.f[2] / (root * root * root);
  return 1;
}
#endif
