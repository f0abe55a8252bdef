/* A strip of small triangles, and the area of one. */
#ifndef TESTS_MESH_STRIP_H
#define TESTS_MESH_STRIP_H
#include "common/mesh/mesh.h"
#include "tests/check.h"
#include <math.h>
#include <string.h>

/* A strip of size `smallest` as the falling disc sweeps it, growing by `growth` m/m outside. */
typedef struct {
  double smallest, lower[2], upper[2], growth;
} Strip;

static inline double StripSize(void *context, const double x[2])
{
  const Strip *s = context;
  double d[2];
  for (int c = 0; c < 2; c++) d[c] = fmax(fmax(s->lower[c] - x[c], x[c] - s->upper[c]), 0.0);
  return s->smallest + s->growth * hypot(d[0], d[1]);
}

static inline double TriangleArea(const double x[], const int v[3])
{
  const double *a = &x[2 * v[0]], *b = &x[2 * v[1]], *c = &x[2 * v[2]];
  return 0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
}
#endif
