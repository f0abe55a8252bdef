/* Convex polygons and half planes: kernels without memory, mesh or MPI.  Coordinates are taken relative to an
 * origin nearby, so that areas are exact to round-off of the polygon's own size, whatever its place. */
#ifndef CORACLE_PHASES_POLYGON_H
#define CORACLE_PHASES_POLYGON_H
#include <math.h>
#include <string.h>

/* The intersection of two triangles has 6 vertices, each further line adds one; round-off may leave a polygon
 * slightly non-convex, where a line can add more: cutting stops at the last vertex that fits. */
enum { POLYGON_MAX = 24 };

typedef struct {
  int n;
  double x[POLYGON_MAX][2];
} Polygon;

/* The half plane n.x <= d. */
typedef struct {
  double n[2], d;
} HalfPlane;

/* What a line leaves of a polygon, and the segment of the line inside: its length and the mean of t = tau.x
 * on it, tau = (-n[1], n[0]). */
typedef struct {
  double area, length, middle;
} PolygonCut;

static inline double PolygonArea(const Polygon *p)
{
  double twice = 0.0;
  for (int k = 1; k + 1 < p->n; k++) {
    const double a[2] = {p->x[k][0] - p->x[0][0], p->x[k][1] - p->x[0][1]};
    const double b[2] = {p->x[k + 1][0] - p->x[0][0], p->x[k + 1][1] - p->x[0][1]};
    twice += a[0] * b[1] - a[1] * b[0];
  }
  return 0.5 * twice;
}

/* moment: int x over the polygon, m3. */
static inline void PolygonMoment(const Polygon *p, double moment[2])
{
  moment[0] = moment[1] = 0.0;
  for (int k = 1; k + 1 < p->n; k++) {
    const double *a = p->x[0], *b = p->x[k], *c = p->x[k + 1];
    const double area = 0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
    for (int d = 0; d < 2; d++) moment[d] += area / 3.0 * (a[d] + b[d] + c[d]);
  }
}

/* Triangle x, moved so that origin is 0. */
static inline void PolygonTriangle(const double x[3][2], const double origin[2], Polygon *p)
{
  p->n = 3;
  for (int i = 0; i < 3; i++) {
    for (int c = 0; c < 2; c++) p->x[i][c] = x[i][c] - origin[c];
  }
}

/* Left of the line p -> q; n is not of unit length. */
static inline HalfPlane HalfPlaneLeft(const double p[2], const double q[2])
{
  HalfPlane h = {{q[1] - p[1], p[0] - q[0]}, 0.0};
  h.d = h.n[0] * p[0] + h.n[1] * p[1];
  return h;
}

static inline HalfPlane HalfPlaneOther(const HalfPlane *h)
{
  return (HalfPlane){{-h->n[0], -h->n[1]}, -h->d};
}

/* Sutherland and Hodgman (1974): *out is the part of *in within the half plane.  A vertex on the line stays
 * and cuts no edge; a crossing is a convex combination of the edge's ends.  in and out differ. */
static inline void PolygonClip(const Polygon *in, const HalfPlane *h, Polygon *out)
{
  double s[POLYGON_MAX];
  int inside = 0, m = 0;
  const int n = in->n;
  for (int i = 0; i < n; i++) {
    s[i] = h->d - h->n[0] * in->x[i][0] - h->n[1] * in->x[i][1];
    inside += s[i] >= 0.0;
  }
  out->n = 0;
  if (!inside) return;
  if (inside == n) {
    out->n = n;
    memcpy(out->x, in->x, (size_t)n * sizeof out->x[0]);
    return;
  }
  for (int i = 0; i < n && m + 2 <= POLYGON_MAX; i++) {
    const int j = i + 1 < n ? i + 1 : 0;
    if (s[i] >= 0.0) {
      out->x[m][0] = in->x[i][0];
      out->x[m++][1] = in->x[i][1];
    }
    if ((s[i] > 0.0 && s[j] < 0.0) || (s[i] < 0.0 && s[j] > 0.0)) {
      const double t = s[i] / (s[i] - s[j]);
      out->x[m][0] = (1.0 - t) * in->x[i][0] + t * in->x[j][0];
      out->x[m++][1] = (1.0 - t) * in->x[i][1] + t * in->x[j][1];
    }
  }
  out->n = m < 3 ? 0 : m;
}

/* *out is the part of *in within triangle x. */
static inline void PolygonClipTriangle(const Polygon *in, const double x[3][2], Polygon *out)
{
  Polygon a, b;
  const HalfPlane h0 = HalfPlaneLeft(x[0], x[1]), h1 = HalfPlaneLeft(x[1], x[2]),
                  h2 = HalfPlaneLeft(x[2], x[0]);
  PolygonClip(in, &h0, &a);
  PolygonClip(&a, &h1, &b);
  PolygonClip(&b, &h2, out);
}

/* Area of the part within the half plane (unit normal) of a polygon of area `all`, and the line's segment in
 * it. */
static inline PolygonCut PolygonCutBy(const Polygon *p, double all, const HalfPlane *h)
{
  PolygonCut cut = {0.0, 0.0, 0.0};
  double s[POLYGON_MAX], low = HUGE_VAL, high = -HUGE_VAL, twice = 0.0;
  const double *first = NULL, *last = NULL;
  double cross[4][2];
  int inside = 0, n = 0;
  for (int i = 0; i < p->n; i++) {
    s[i] = h->d - h->n[0] * p->x[i][0] - h->n[1] * p->x[i][1];
    inside += s[i] >= 0.0;
  }
  if (!inside) return cut;
  if (inside == p->n) {
    cut.area = all;
    return cut;
  }
  for (int i = 0; i < p->n; i++) { /* a fan around the first vertex that stays */
    const int j = i + 1 < p->n ? i + 1 : 0;
    const double *next[2] = {s[i] >= 0.0 ? p->x[i] : NULL, NULL};
    if ((s[i] >= 0.0) != (s[j] >= 0.0) && n < 4) {
      const double w = s[i] / (s[i] - s[j]);
      for (int c = 0; c < 2; c++) cross[n][c] = (1.0 - w) * p->x[i][c] + w * p->x[j][c];
      const double t = h->n[0] * cross[n][1] - h->n[1] * cross[n][0];
      low = t < low ? t : low;
      high = t > high ? t : high;
      next[1] = cross[n++];
    }
    for (int k = 0; k < 2; k++) {
      if (!next[k]) continue;
      if (!first) {
        first = next[k];
        continue;
      }
      if (last)
        twice +=
            (last[0] - first[0]) * (next[k][1] - first[1]) - (last[1] - first[1]) * (next[k][0] - first[0]);
      last = next[k];
    }
  }
  cut.area = 0.5 * twice;
  cut.length = high - low;
  cut.middle = 0.5 * (high + low);
  return cut;
}

/* PolygonFindOffset of a triangle: the part is a triangle at one end, or all but one at the other. */
static inline double PolygonTriangleOffset(const Polygon *p, const double n[2], double area)
{
  const double all = PolygonArea(p);
  double s[3];
  for (int i = 0; i < 3; i++) s[i] = n[0] * p->x[i][0] + n[1] * p->x[i][1];
  for (int i = 0; i < 3; i++) { /* sorts three numbers */
    const int j = i % 2;
    const double low = s[j] < s[j + 1] ? s[j] : s[j + 1], high = s[j] < s[j + 1] ? s[j + 1] : s[j];
    s[j] = low;
    s[j + 1] = high;
  }
  if (area <= 0.0) return s[0];
  if (area >= all) return s[2];
  const double below = all * (s[1] - s[0]) / (s[2] - s[0]);
  if (area <= below) return s[0] + sqrt(area / all * (s[1] - s[0]) * (s[2] - s[0]));
  return s[2] - sqrt((all - area) / all * (s[2] - s[1]) * (s[2] - s[0]));
}

/* d such that the part n.x <= d of a convex polygon has the given area, to round-off: the vertices sorted
 * along n bound strips in which the area is quadratic in d.  n of unit length; the area is cut to [0, all].
 * */
static inline double PolygonFindOffset(const Polygon *p, const double n[2], double area)
{
  double s[POLYGON_MAX] = {0.0}, below = 0.0, width = 0.0;
  const int m = p->n;
  if (m == 3) return PolygonTriangleOffset(p, n, area);
  for (int i = 0; i < m; i++) s[i] = n[0] * p->x[i][0] + n[1] * p->x[i][1];
  for (int i = 1; i < m; i++) {
    const double v = s[i];
    int j = i;
    for (; j > 0 && s[j - 1] > v; j--) s[j] = s[j - 1];
    s[j] = v;
  }
  if (area <= 0.0) return s[0];
  for (int i = 0; i + 1 < m; i++) { /* between s[i] and s[i + 1] the width is linear */
    const double step = s[i + 1] - s[i];
    if (!(step > 0.0)) continue;
    double t[2] = {HUGE_VAL, -HUGE_VAL}; /* the width just above s[i] and at s[i + 1], from the outline */
    double u[2] = {HUGE_VAL, -HUGE_VAL};
    for (int k = 0; k < m; k++) {
      const double *a = p->x[k], *b = p->x[k + 1 < m ? k + 1 : 0];
      const double sa = n[0] * a[0] + n[1] * a[1], sb = n[0] * b[0] + n[1] * b[1];
      if (fmin(sa, sb) > s[i] || fmax(sa, sb) < s[i + 1] || sa == sb) continue;
      const double ta = n[0] * a[1] - n[1] * a[0], tb = n[0] * b[1] - n[1] * b[0],
                   slope = (tb - ta) / (sb - sa);
      const double t0 = ta + (s[i] - sa) * slope, t1 = ta + (s[i + 1] - sa) * slope;
      t[0] = fmin(t[0], t0), t[1] = fmax(t[1], t0);
      u[0] = fmin(u[0], t1), u[1] = fmax(u[1], t1);
    }
    if (!(t[1] >= t[0])) continue;
    width = t[1] - t[0];
    const double grow = (u[1] - u[0] - width) / step, strip = step * (width + 0.5 * grow * step);
    if (below + strip >= area || i + 2 == m) {
      const double rest = fmax(area - below, 0.0), root = width * width + 2.0 * grow * rest;
      const double w = width + sqrt(fmax(root, 0.0));
      return s[i] + fmin(w > 0.0 ? 2.0 * rest / w : 0.0, step);
    }
    below += strip;
  }
  return m > 0 ? s[m - 1] : 0.0;
}
#endif
