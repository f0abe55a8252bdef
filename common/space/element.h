/* Geometry of one triangle that P1 and P2 kernels need.
 *
 *            2
 *           / \
 *     face 1   face 0
 *         /     \
 *        0-------1
 *          face 2
 *
 * Face i lies opposite to vertex i and runs from vertex (i+1)%3 to (i+2)%3; vertices are counter-clockwise,
 * so that its outward normal is the right-hand side of that direction. No mesh, no MPI, no PETSc objects. */
#ifndef CORACLE_ELEMENT_H
#define CORACLE_ELEMENT_H
#include <math.h>

typedef struct {
  double n[2];   /* outward unit normal */
  double length; /* m */
} FaceGeometry;

typedef struct {
  double area;          /* m2 */
  double g[3][2];       /* gradients of the barycentric coordinates, 1/m */
  double trace;         /* perimeter / area: the constant of the trace inequality of P1 gradients, 1/m */
  FaceGeometry face[3]; /* face i lies opposite to vertex i */
} ElementGeometry;

static inline void ElementGeometryCompute(const double x0[2], const double x1[2], const double x2[2],
                                          ElementGeometry *e)
{
  const double *x[3] = {x0, x1, x2};
  const double twice = (x1[0] - x0[0]) * (x2[1] - x0[1]) - (x2[0] - x0[0]) * (x1[1] - x0[1]);
  e->area = 0.5 * twice;
  e->trace = 0.0;
  for (int i = 0; i < 3; i++) {
    const double *a = x[(i + 1) % 3], *b = x[(i + 2) % 3];
    const double length = hypot(b[0] - a[0], b[1] - a[1]);
    e->g[i][0] = (a[1] - b[1]) / twice;
    e->g[i][1] = (b[0] - a[0]) / twice;
    e->face[i] = (FaceGeometry){{(b[1] - a[1]) / length, (a[0] - b[0]) / length}, length};
    e->trace += length / e->area;
  }
}
#endif
