/* Algebra of one metric tensor M = [m0 m1; m1 m2], symmetric and positive definite, 1/m^2.  A vector e has
 * the length sqrt(e^T M e); the unit ball of M is an ellipse whose semi-axes h_i = 1/sqrt(lambda_i) are the
 * wanted edge lengths.  Kernels: neither mesh nor solver. */
#ifndef CORACLE_METRIC_TENSOR_H
#define CORACLE_METRIC_TENSOR_H
#include <math.h>

/* Eigenvalues lambda[0] >= lambda[1] of a symmetric tensor and the unit vector of the first; the second is
 * (-axis[1], axis[0]). */
static inline void MetricEigen(const double m[3], double lambda[2], double axis[2])
{
  const double half = 0.5 * (m[0] - m[2]), mean = 0.5 * (m[0] + m[2]), radius = hypot(half, m[1]);
  double c = half >= 0.0 ? half + radius : m[1], s = half >= 0.0 ? m[1] : radius - half;
  const double norm = hypot(c, s);
  lambda[0] = mean + radius;
  lambda[1] = mean - radius;
  axis[0] = norm > 0.0 ? c / norm : 1.0;
  axis[1] = norm > 0.0 ? s / norm : 0.0;
}

static inline void MetricCompose(const double lambda[2], const double axis[2], double m[3])
{
  const double c = axis[0], s = axis[1];
  m[0] = lambda[0] * c * c + lambda[1] * s * s;
  m[1] = (lambda[0] - lambda[1]) * c * s;
  m[2] = lambda[0] * s * s + lambda[1] * c * c;
}

static inline double MetricDet(const double m[3])
{
  return m[0] * m[2] - m[1] * m[1];
}

/* Finite and positive definite, as far as round-off can tell. */
static inline int MetricIsValid(const double m[3])
{
  return isfinite(m[0]) && isfinite(m[1]) && isfinite(m[2]) && m[0] > 0.0 && m[2] > 0.0 &&
         MetricDet(m) > 1e-14 * m[0] * m[2];
}

/* e^T M e */
static inline double MetricSquare(const double m[3], double ex, double ey)
{
  return m[0] * ex * ex + 2.0 * m[1] * ex * ey + m[2] * ey * ey;
}

/* Length of the edge from p to q: the integral of sqrt(e^T M e) when it changes geometrically from one end to
 * the other, (lp - lq)/ln(lp/lq) (Alauzet, Finite Elem. Anal. Des. 46, 2010). */
static inline double MetricLength(const double p[2], const double q[2], const double mp[3],
                                  const double mq[3])
{
  const double ex = q[0] - p[0], ey = q[1] - p[1];
  const double a = MetricSquare(mp, ex, ey), b = MetricSquare(mq, ex, ey);
  const double lp = sqrt(a > 0.0 ? a : 0.0), lq = sqrt(b > 0.0 ? b : 0.0);
  const double d = (lp - lq) / (lp + lq + 1e-300);
  /* ln(lp/lq) = 2 atanh d; its series is exact to round-off up to a ratio of 1.2, so that there is no jump */
  const double s = d * d;
  if (s < 0.01)
    return 0.5 * (lp + lq) /
           (1.0 +
            s * (1.0 / 3.0 + s * (0.2 + s * (1.0 / 7.0 + s * (1.0 / 9.0 + s * (1.0 / 11.0 + s / 13.0))))));
  return 0.5 * (lp + lq) * d / (lq > 0.0 && lp > 0.0 ? 0.5 * log(lp / lq) : copysign(1e3, d));
}

static inline void MetricLog(const double m[3], double log_m[3])
{
  const double half = 0.5 * (m[0] - m[2]), mean = 0.5 * (m[0] + m[2]), radius = hypot(half, m[1]);
  const double first = log(mean + radius), second = log(MetricDet(m)) - first;
  const double s = 0.5 * (first + second);
  const double stretch = radius > 1e-6 * mean ? 0.5 * (first - second) / radius : 1.0 / mean;
  log_m[0] = s + stretch * half;
  log_m[1] = stretch * m[1];
  log_m[2] = s - stretch * half;
}

/* exp(s I + D) = e^s (cosh r I + sinh r / r D) with D free of trace and r its norm. */
static inline void MetricExp(const double log_m[3], double m[3])
{
  const double half = 0.5 * (log_m[0] - log_m[2]), r = hypot(half, log_m[1]);
  const double size = exp(0.5 * (log_m[0] + log_m[2])), up = exp(r), down = 1.0 / up;
  const double c = 0.5 * (up + down), s = r > 1e-3 ? 0.5 * (up - down) / r : 1.0 + r * r / 6.0;
  m[0] = size * (c + s * half);
  m[1] = size * s * log_m[1];
  m[2] = size * (c - s * half);
}

/* M becomes the intersection of M and N by simultaneous reduction: with M = L L^T and the eigenvalues mu of
 * L^-1 N L^-T, M <- L max(1, mu) L^T, whose unit ball is the largest of that shape in both.  Changes nothing
 * and returns 0 unless N asks for more than a factor (1 + tolerance). */
static inline int MetricIntersectTensor(const double n[3], double tolerance, double m[3])
{
  const double a = sqrt(m[0]), b = m[1] / a, c = sqrt(fmax(m[2] - b * b, 1e-16 * m[2]));
  const double y = n[1] - b / a * n[0];                                /* row 2 of c L^-1 N, column 1 */
  const double z = n[2] - 2.0 * b / a * n[1] + b * b / (a * a) * n[0]; /* c^2 times entry (2, 2) */
  const double r[3] = {n[0] / (a * a), y / (a * c), z / (c * c)};
  double mu[2], axis[2], k[3];
  MetricEigen(r, mu, axis);
  if (mu[0] <= 1.0 + tolerance) return 0;
  mu[0] = fmax(mu[0], 1.0);
  mu[1] = fmax(mu[1], 1.0);
  MetricCompose(mu, axis, k);
  m[0] = a * a * k[0];
  m[1] = a * (b * k[0] + c * k[1]);
  m[2] = b * b * k[0] + 2.0 * b * c * k[1] + c * c * k[2];
  return 1;
}

/* Shape of a triangle in the mean M of its corners' metrics, and the mean square of its edges' lengths:
 * q = 4 sqrt 3 A sqrt(det M) / sum e^T M e, 1 for an equilateral triangle in M, negative if clockwise. */
static inline double MetricQuality(const double *const x[3], const double *const m[3], double *mean_square)
{
  const double e[3][2] = {{x[2][0] - x[1][0], x[2][1] - x[1][1]},
                          {x[0][0] - x[2][0], x[0][1] - x[2][1]},
                          {x[1][0] - x[0][0], x[1][1] - x[0][1]}};
  const double mean[3] = {(m[0][0] + m[1][0] + m[2][0]) / 3.0, (m[0][1] + m[1][1] + m[2][1]) / 3.0,
                          (m[0][2] + m[1][2] + m[2][2]) / 3.0};
  const double twice = e[2][1] * e[1][0] - e[2][0] * e[1][1];
  double sum = 0.0;
  for (int i = 0; i < 3; i++) sum += MetricSquare(mean, e[i][0], e[i][1]);
  *mean_square = sum / 3.0;
  const double det = MetricDet(mean);
  return 3.4641016151377546 * twice * sqrt(det > 0.0 ? det : 0.0) / sum;
}
#endif
