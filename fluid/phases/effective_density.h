/* The effective density of an element that an interface cuts: what a continuous pressure without a kink sees.  Kernel: no
 * mesh, no MPI.
 *
 * Across the interface the pressure's gradient jumps by [rho] (g - a).n, a the acceleration: for water and air by a
 * factor of a thousand.  With distances d_i of the vertices from the interface (negative in the first phase) and G =
 * (g - a).n such a pressure is rho_i d_i G at the vertices, and between them its interpolant has one gradient,
 *
 *     grad p_I = q G,    q = sum rho_i d_i grad lambda_i / |m|,    m = sum d_i grad lambda_i,    n = m/|m|
 *
 *        0          heavy above the line through the edges of vertex 0 at the share f of their lengths: the share of the
 *       /h\         area is f^2, but that of the pressure's difference from vertex 0 to the edge opposite is f.
 *      /---\
 *     /  l  \       An acceleration a = g - R^-1 grad p with R n = q, R symmetric, is g in free fall (p = 0) and 0 at
 *    1-------2      rest, for any line and mesh, and no part of R is lighter than the lightest phase.
 *
 * The distances are those of the vertices, shared by all elements around them: then rho_i d_i G is one pressure for all
 * elements, and errors of the distances do not set the light phase in motion (the densities of edges of Kang, Fedkiw
 * and Liu 2000 on squares have the same property).  Along the line R has the mean density of the element.
 *
 * What differs from one element to the next is lost in such distances: the flow raises water in one and lowers it in another, and no
 * weight restores them.  So a part of what the
 * element holds beyond the volume that the distances give it weighs: of b g,  b = SURPLUS (rho_K - rho_d)/rho_heavy,  rho_d the density of
 * the linear d.  0 at rest on any mesh, of order h times the curvature else; over the heavier density, as light elements would leap.
 *
 * Of several lines in an element the last one has the normal n, and rho_i d_i becomes the integral of the density along it from
 * that line to the vertex: rho_i d_i + sum [rho]_k min(d_ki, 0) cos_k over the other lines k, [rho]_k = below - above and
 * cos_k = n_k.n.  This is exact for layers. */
#ifndef CORACLE_PHASES_EFFECTIVE_DENSITY_H
#define CORACLE_PHASES_EFFECTIVE_DENSITY_H
#include <math.h>

/* The part of an element's surplus that weighs. */
#define EFFECTIVE_DENSITY_SURPLUS 0.25

/* How much lighter than its part along the line R may be across it; beyond, an obtuse element's pressure cannot be
 * balanced by any such R. */
#define EFFECTIVE_DENSITY_SPREAD 4.0

typedef struct {
  double inverse[3]; /* R^-1: xx, xy, yy, m3/kg */
  double weight
      [2]; /* gravity, or what balances the pressure at rest where there is no R, and R^-1 surface; m/s2 */
  double surface[2]; /* surface tension, N/m3 */
} InverseDensity;

static inline void InverseDensityUniform(double rho, const double gravity[2], InverseDensity *r)
{
  *r = (InverseDensity){{1.0 / rho, 0.0, 1.0 / rho}, {gravity[0], gravity[1]}, {0.0, 0.0}};
}

/* force: N/m3 */
static inline void InverseDensityAddSurface(const double force[2], InverseDensity *r)
{
  for (int c = 0; c < 2; c++) {
    r->surface[c] += force[c];
    r->weight[c] += r->inverse[c] * force[0] + r->inverse[c + 1] * force[1];
  }
}

/* weight - R^-1 grad p, m/s2 */
static inline void InverseDensityAcceleration(const InverseDensity *r, const double grad[2],
                                              double acceleration[2])
{
  for (int c = 0; c < 2; c++)
    acceleration[c] = r->weight[c] - r->inverse[c] * grad[0] - r->inverse[c + 1] * grad[1];
}

/* The inverse of (xx, xy, yy). */
static inline void SymmetricInvert(const double a[3], double inverse[3])
{
  const double det = a[0] * a[2] - a[1] * a[1];
  inverse[0] = a[2] / det;
  inverse[1] = -a[1] / det;
  inverse[2] = a[0] / det;
}

/* R weight less the surface tension: the weight that the pressure at rest bears, N/m3. */
static inline void InverseDensityBears(const InverseDensity *r, double borne[2])
{
  double density[3];
  SymmetricInvert(r->inverse, density);
  for (int c = 0; c < 2; c++)
    borne[c] = density[c] * r->weight[0] + density[c + 1] * r->weight[1] - r->surface[c];
}

/* Of the mean of two R and of their loads R weight: the middle of a step, between its ends. */
static inline void InverseDensityMiddle(const InverseDensity *a, const InverseDensity *b,
                                        InverseDensity *middle)
{
  double ra[3], rb[3], load[2];
  SymmetricInvert(a->inverse, ra);
  SymmetricInvert(b->inverse, rb);
  for (int c = 0; c < 2; c++)
    load[c] = 0.5 * (ra[c] * a->weight[0] + ra[c + 1] * a->weight[1] + rb[c] * b->weight[0] +
                     rb[c + 1] * b->weight[1]);
  for (int k = 0; k < 3; k++) ra[k] = 0.5 * (ra[k] + rb[k]);
  for (int c = 0; c < 2; c++) middle->surface[c] = 0.5 * (a->surface[c] + b->surface[c]);
  SymmetricInvert(ra, middle->inverse);
  for (int c = 0; c < 2; c++)
    middle->weight[c] = middle->inverse[c] * load[0] + middle->inverse[c + 1] * load[1];
}

/* A line of an element: distances of the vertices, m; the densities where they are negative and positive, kg/m3. */
typedef struct {
  double d[3], rho[2];
} DensityLine;

/* sum value[i] grad[i] */
static inline void DensityGradient(const double grad[3][2], const double value[3], double sum[2])
{
  for (int c = 0; c < 2; c++) sum[c] = value[0] * grad[0][c];
  for (int i = 1; i < 3; i++)
    for (int c = 0; c < 2; c++) sum[c] += value[i] * grad[i][c];
}

/* integral[i] += [rho] min(d_i, 0) cos of a line that is not the last, whose m is given. */
static inline void DensityAddLine(const double grad[3][2], const DensityLine *line, const double last[2],
                                  double integral[3])
{
  double m[2];
  DensityGradient(grad, line->d, m);
  const double square = m[0] * m[0] + m[1] * m[1];
  if (!(square > 0.0)) return;
  const double weight = (line->rho[0] - line->rho[1]) * (m[0] * last[0] + m[1] * last[1]) / square;
  for (int i = 0; i < 3; i++) integral[i] += weight * fmin(line->d[i], 0.0);
}

/* The share of a triangle's area in which a linear d is negative. */
static inline double DensityShareBelow(const double d[3])
{
  const int below = (d[0] < 0.0) + (d[1] < 0.0) + (d[2] < 0.0);
  if (below == 0 || below == 3) return below / 3;
  int odd = 0; /* alone on its side */
  while ((d[odd] < 0.0) != (below == 1)) odd++;
  const double a = d[odd], b = d[(odd + 1) % 3], c = d[(odd + 2) % 3], share = a * a / ((a - b) * (a - c));
  return below == 1 ? share : 1.0 - share;
}

/* The weight of the surplus of an element with one line; mean: density of its content, kg/m3. */
static inline void InverseDensityAddSurplus(const DensityLine *line, double mean, const double gravity[2],
                                            InverseDensity *r)
{
  const double share = DensityShareBelow(line->d), *rho = line->rho;
  const double surplus = mean - share * rho[0] - (1.0 - share) * rho[1];
  for (int c = 0; c < 2; c++)
    r->weight[c] += EFFECTIVE_DENSITY_SURPLUS * surplus / fmax(rho[0], rho[1]) * gravity[c];
}

/* grad[i]: of the barycentric coordinates; line[n_lines], at least one; mean: density of the element's content, kg/m3. */
static inline void InverseDensityCut(const double grad[3][2], int n_lines, const DensityLine line[],
                                     double mean, const double gravity[2], InverseDensity *r)
{
  const DensityLine *last = &line[n_lines - 1];
  double m[2], q[2], integral[3], low = fmin(last->rho[0], last->rho[1]);
  DensityGradient(grad, last->d, m);
  for (int i = 0; i < 3; i++) integral[i] = last->rho[last->d[i] > 0.0] * last->d[i];
  for (int k = 0; k + 1 < n_lines; k++) {
    DensityAddLine(grad, &line[k], m, integral);
    low = fmin(low, line[k].rho[0]);
  }
  DensityGradient(grad, integral, q);
  const double size = hypot(m[0], m[1]);
  if (!(size > 0.0)) {
    InverseDensityUniform(mean, gravity, r);
    return;
  }
  const double n[2] = {m[0] / size, m[1] / size};
  const double nn = (q[0] * n[0] + q[1] * n[1]) / size, nt = (q[1] * n[0] - q[0] * n[1]) / size;
  const double need = nn > low ? low + nt * nt / (nn - low) : fabs(nt) > 1e-12 * low ? HUGE_VAL : low;
  const double tt = fmax(mean, need), det = nn * tt - nt * nt;
  InverseDensityUniform(fmax(mean, hypot(nn, nt)), gravity, r);
  if (need > EFFECTIVE_DENSITY_SPREAD * fmax(mean, nn) || nn < low * (1.0 - 1e-9)) {
    const double along = gravity[1] * n[0] - gravity[0] * n[1],
                 across = gravity[0] * n[0] + gravity[1] * n[1];
    for (int c = 0; c < 2; c++)
      r->weight[c] = r->inverse[0] * across * q[c] / size + (c ? n[0] : -n[1]) * along;
    return;
  }
  const double t[2] = {-n[1], n[0]};
  r->inverse[0] = (tt * n[0] * n[0] - 2.0 * nt * n[0] * t[0] + nn * t[0] * t[0]) / det;
  r->inverse[1] = (tt * n[0] * n[1] - nt * (n[0] * t[1] + t[0] * n[1]) + nn * t[0] * t[1]) / det;
  r->inverse[2] = (tt * n[1] * n[1] - 2.0 * nt * n[1] * t[1] + nn * t[1] * t[1]) / det;
}
#endif
