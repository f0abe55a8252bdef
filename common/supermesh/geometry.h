/* Kernels on plane triangles: area, barycentric coordinates, clipping.  No memory, no MPI; a
 * triangle is x[3][2], counter-clockwise, in metres.  Everything is exact up to round-off of the coordinates'
 * differences. */
#ifndef CORACLE_GEOMETRY_H
#define CORACLE_GEOMETRY_H
#include <math.h>
#include <string.h>

/* Vertices of a clipped triangle: 6 in exact arithmetic.  Round-off may leave a polygon a hair non-convex,
 * then a half plane can cut every other vertex off: 3 -> 4 -> 6 -> 9. */
#define GEOMETRY_CLIP_MAX 9

typedef struct {
  double lower[2], upper[2];
} GeometryBox;

/* Boxes that are given as corner[n][2][2], lower and upper: the same memory. */
static inline const GeometryBox *GeometryBoxes(const double corner[])
{
  return (const GeometryBox *)corner;
}

/* Twice the signed area of p, q, r: > 0 when they turn counter-clockwise. */
static inline double GeometryTurn(const double p[2], const double q[2], const double r[2])
{
  return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
}

/* Signed area, m2. */
static inline double GeometryArea(const double x[3][2])
{
  return 0.5 * GeometryTurn(x[0], x[1], x[2]);
}

/* A box that contains nothing and is neutral in GeometryBoxGrow. */
static inline GeometryBox GeometryBoxEmpty(void)
{
  return (GeometryBox){{HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL}};
}

static inline void GeometryBoxGrow(GeometryBox *box, const double x[2])
{
  for (int c = 0; c < 2; c++) {
    if (x[c] < box->lower[c]) box->lower[c] = x[c];
    if (x[c] > box->upper[c]) box->upper[c] = x[c];
  }
}

static inline void GeometryBoxJoin(GeometryBox *box, const GeometryBox *other)
{
  GeometryBoxGrow(box, other->lower);
  GeometryBoxGrow(box, other->upper);
}

/* With a margin on all sides, m. */
static inline GeometryBox GeometryBoxWidened(GeometryBox box, double margin)
{
  for (int c = 0; c < 2; c++) {
    box.lower[c] -= margin;
    box.upper[c] += margin;
  }
  return box;
}

/* Around nodes node[n] of x[][2]. */
static inline GeometryBox GeometryBoxOfNodes(int n, const int node[], const double x[])
{
  GeometryBox box = GeometryBoxEmpty();
  for (int i = 0; i < n; i++) GeometryBoxGrow(&box, x + 2 * node[i]);
  return box;
}

static inline GeometryBox GeometryBoxOf(const double x[3][2])
{
  GeometryBox box = GeometryBoxEmpty();
  for (int i = 0; i < 3; i++) GeometryBoxGrow(&box, x[i]);
  return box;
}

/* Closed boxes: touching counts. */
static inline int GeometryBoxOverlap(const GeometryBox *a, const GeometryBox *b)
{
  return (a->lower[0] <= b->upper[0]) & (b->lower[0] <= a->upper[0]) & (a->lower[1] <= b->upper[1]) &
         (b->lower[1] <= a->upper[1]);
}

/* From the nearest point of the box, 0 inside, m. */
static inline double GeometryBoxDistance(const GeometryBox *box, const double x[2])
{
  double square = 0.0;
  for (int c = 0; c < 2; c++) {
    const double d = fmax(fmax(box->lower[c] - x[c], x[c] - box->upper[c]), 0.0);
    square += d * d;
  }
  return sqrt(square);
}

/* The three P1 functions of triangle x at point p; their sum is 1 to the last bit or two. */
static inline void GeometryBarycentric(const double x[3][2], const double p[2], double n[3])
{
  const double inverse = 1.0 / GeometryTurn(x[0], x[1], x[2]);
  n[1] = GeometryTurn(x[2], x[0], p) * inverse;
  n[2] = GeometryTurn(x[0], x[1], p) * inverse;
  n[0] = 1.0 - n[1] - n[2];
}

/* The place s on a + s (b - a), 0 .. 1, that is nearest to p; 0 where b is a. */
static inline double GeometrySegmentPlace(const double a[2], const double b[2], const double p[2])
{
  const double d[2] = {b[0] - a[0], b[1] - a[1]}, square = d[0] * d[0] + d[1] * d[1];
  return fmin(fmax(((p[0] - a[0]) * d[0] + (p[1] - a[1]) * d[1]) / fmax(square, 1e-300), 0.0), 1.0);
}

/* Of p from a + s (b - a), m. */
static inline double GeometryDistanceAt(const double a[2], const double b[2], double s, const double p[2])
{
  return hypot(p[0] - a[0] - s * (b[0] - a[0]), p[1] - a[1] - s * (b[1] - a[1]));
}

/* Of a point from the triangle's sides, m. */
static inline double GeometrySideDistance(const double x[3][2], const double p[2])
{
  double least = HUGE_VAL;
  for (int i = 0; i < 3; i++) {
    const double *a = x[i], *b = x[(i + 1) % 3];
    least = fmin(least, GeometryDistanceAt(a, b, GeometrySegmentPlace(a, b, p), p));
  }
  return least;
}

/* Keeps of *polygon, n vertices, what lies on the left of the line p -> q (Sutherland and Hodgman 1974): a polygon
 * that lies there as a whole stays where it is, else *polygon becomes out.  A vertex on the line stays
 * and cuts no edge; a crossing is a convex combination of the edge's ends, so it never leaves the edge. */
static inline int GeometryClipHalfPlane(int n, const double (**polygon)[2], const double p[2],
                                        const double q[2], double out[][2])
{
  const double(*in)[2] = *polygon;
  double side[GEOMETRY_CLIP_MAX];
  int inside = 0, m = 0;
  for (int i = 0; i < n; i++) {
    side[i] = GeometryTurn(p, q, in[i]);
    inside += side[i] >= 0.0;
  }
  if (!inside) return 0;
  if (inside == n) return n;
  *polygon = (const double(*)[2])out;
  for (int i = 0; i < n; i++) {
    const int j = i + 1 < n ? i + 1 : 0;
    if (side[i] >= 0.0) {
      out[m][0] = in[i][0];
      out[m++][1] = in[i][1];
    }
    if ((side[i] > 0.0 && side[j] < 0.0) || (side[i] < 0.0 && side[j] > 0.0)) {
      const double t = side[i] / (side[i] - side[j]);
      out[m][0] = (1.0 - t) * in[i][0] + t * in[j][0];
      out[m++][1] = (1.0 - t) * in[i][1] + t * in[j][1];
    }
  }
  return m;
}

/* The convex polygon that triangles a and b share: its number of vertices (0: nothing), counter-clockwise. */
static inline int GeometryClip(const double a[3][2], const double b[3][2],
                               double polygon[GEOMETRY_CLIP_MAX][2])
{
  double first[GEOMETRY_CLIP_MAX][2], second[GEOMETRY_CLIP_MAX][2];
  const double(*now)[2] = a;
  int n = GeometryClipHalfPlane(3, &now, b[0], b[1], first);
  n = GeometryClipHalfPlane(n, &now, b[1], b[2], second);
  n = GeometryClipHalfPlane(n, &now, b[2], b[0], polygon);
  for (int i = 0; i < n && now != (const double(*)[2])polygon; i++)
    for (int c = 0; c < 2; c++) polygon[i][c] = now[i][c];
  return n < 3 ? 0 : n;
}
#endif
