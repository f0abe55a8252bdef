/* Points and 2 x 2 tensors of the plane, as small structs that the compiler keeps in registers. */
#ifndef SOLID_PLANE_H
#define SOLID_PLANE_H

typedef struct {
  double x, y;
} Point;

typedef struct {
  double xx, xy, yx, yy;
} Tensor;

/* Without the C library's care for what is not a number, which costs a call. */
static inline double Lesser(double a, double b)
{
  return a < b ? a : b;
}

static inline double Greater(double a, double b)
{
  return a > b ? a : b;
}

static inline Point PointAt(const double x[], int i)
{
  return (Point){x[2 * i], x[2 * i + 1]};
}

static inline Point PointMinus(Point a, Point b)
{
  return (Point){a.x - b.x, a.y - b.y};
}

static inline double PointSquared(Point a)
{
  return a.x * a.x + a.y * a.y;
}

static inline double PointCross(Point a, Point b)
{
  return a.x * b.y - a.y * b.x;
}

/* The edges b - a and c - a as columns: its determinant is twice the triangle's area. */
static inline Tensor TensorOfEdges(Point a, Point b, Point c)
{
  return (Tensor){b.x - a.x, c.x - a.x, b.y - a.y, c.y - a.y};
}

static inline double TensorDeterminant(Tensor a)
{
  return a.xx * a.yy - a.xy * a.yx;
}

static inline Tensor TensorProduct(Tensor a, Tensor b)
{
  return (Tensor){a.xx * b.xx + a.xy * b.yx, a.xx * b.xy + a.xy * b.yy, a.yx * b.xx + a.yy * b.yx,
                  a.yx * b.xy + a.yy * b.yy};
}

static inline Tensor TensorInverse(Tensor a)
{
  const double s = 1.0 / TensorDeterminant(a);
  return (Tensor){s * a.yy, -s * a.xy, -s * a.yx, s * a.xx};
}
#endif
