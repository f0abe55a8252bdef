/* Box meshes: exact area, conforming, no small angle, the wanted sizes, named boundary, mirror symmetry. */
#include "tests/mesh/strip.h"

typedef struct {
  double lower[2], upper[2], size_max;
  Strip strip;
  double angle; /* degrees that no corner may go below */
} Box;

/* The angle at corner i, degrees. */
static double Angle(const double x[], const int v[3], int i)
{
  const double *a = &x[2 * v[i]], *b = &x[2 * v[(i + 1) % 3]], *c = &x[2 * v[(i + 2) % 3]];
  const double p[2] = {b[0] - a[0], b[1] - a[1]}, q[2] = {c[0] - a[0], c[1] - a[1]};
  return atan2(p[0] * q[1] - p[1] * q[0], p[0] * q[0] + p[1] * q[1]) * 180.0 / M_PI;
}

static void CheckTriangles(const MeshSerial *m, const Box *box)
{
  const double whole = (box->upper[0] - box->lower[0]) * (box->upper[1] - box->lower[1]);
  double area = 0.0, angle = 180.0;
  for (int e = 0; e < m->ne; e++) {
    const int *v = &m->vertex[3 * e];
    CHECK(TriangleArea(m->x, v) > 0.0, "triangle %d is clockwise or flat", e);
    area += TriangleArea(m->x, v);
    for (int i = 0; i < 3; i++) angle = fmin(angle, Angle(m->x, v, i));
  }
  CHECK(fabs(area - whole) < 1e-11 * whole, "area %.17g, not %.17g", area, whole);
  CHECK(angle >= box->angle, "smallest angle %g, not %g", angle, box->angle);
}

/* The longest edge along an axis: the edge of the cell, or half of it at a hanging node. */
static double CellEdge(const double x[], const int v[3])
{
  double axis = 0.0;
  for (int i = 0; i < 3; i++) {
    const double *a = &x[2 * v[i]], *b = &x[2 * v[(i + 1) % 3]];
    const double dx = fabs(a[0] - b[0]), dy = fabs(a[1] - b[1]);
    if (dx < 1e-12 || dy < 1e-12) axis = fmax(axis, fmax(dx, dy));
  }
  return axis;
}

/* Sizes: at no point of a triangle does its cell exceed what is wanted there.  Points are vertices and the
 * centroid. */
static void CheckSizes(const MeshSerial *m, const Box *box)
{
  Strip strip = box->strip;
  for (int e = 0; e < m->ne; e++) {
    const int *v = &m->vertex[3 * e];
    const double edge = CellEdge(m->x, v);
    double point[4][2] = {{0.0}};
    for (int i = 0; i < 3; i++) {
      for (int c = 0; c < 2; c++) {
        point[i][c] = m->x[2 * v[i] + c];
        point[3][c] += point[i][c] / 3.0;
      }
    }
    for (int k = 0; k < 4; k++) {
      const double wanted = fmin(box->size_max, StripSize(&strip, point[k]));
      CHECK(edge <= wanted * (1.0 + 1e-8), "edge %g at (%g, %g), not %g", edge, point[k][0], point[k][1],
            wanted);
    }
  }
}

/* Every edge has two triangles inside and one on the boundary, by counting over a dense sorted list; Euler: V
 * - E + F = 1. */
static int ByEnds(const void *a, const void *b)
{
  return memcmp(a, b, 2 * sizeof(int));
}

static void CheckConforming(const MeshSerial *m, const Box *box)
{
  int(*edge)[2] = malloc(3 * (size_t)m->ne * sizeof *edge), nedge = 0, outer = 0;
  double length[4] = {0.0};
  for (int k = 0; k < 3 * m->ne; k++) {
    const int *v = &m->vertex[k - k % 3], a = v[(k + 1) % 3], b = v[(k + 2) % 3];
    edge[k][0] = a < b ? a : b;
    edge[k][1] = a < b ? b : a;
  }
  qsort(edge, 3 * (size_t)m->ne, sizeof *edge, ByEnds);
  for (int k = 0, n; k < 3 * m->ne; k += n, nedge++) {
    for (n = 1; k + n < 3 * m->ne && !ByEnds(edge[k], edge[k + n]); n++) {
    }
    CHECK(n <= 2, "%d triangles on one edge", n);
    outer += n == 1;
  }
  free(edge);
  CHECK(outer == m->nb, "%d edges of one triangle, %d boundary edges", outer, m->nb);
  CHECK(m->nv - nedge + m->ne == 1, "Euler: %d vertices, %d edges, %d triangles", m->nv, nedge, m->ne);
  for (int k = 0; k < m->nb; k++) {
    const double *a = &m->x[2 * m->facet[2 * k]], *b = &m->x[2 * m->facet[2 * k + 1]];
    const int tag = m->facet_tag[k], d = tag < 2 ? 0 : 1;
    const double at = tag % 2 ? box->upper[d] : box->lower[d];
    CHECK(a[d] == at && b[d] == at, "an edge of '%s' at %g, not %g", m->tag_name[tag], a[d], at);
    length[tag] += fabs(a[1 - d] - b[1 - d]);
  }
  for (int k = 0; k < 4; k++) {
    const int d = k < 2 ? 1 : 0;
    CHECK(fabs(length[k] - (box->upper[d] - box->lower[d])) < 1e-11, "'%s' is %g long", m->tag_name[k],
          length[k]);
  }
}

static int ByPosition(const void *a, const void *b)
{
  const long *p = a, *q = b;
  for (int k = 0; k < 2; k++) {
    if (p[k] != q[k]) return p[k] < q[k] ? -1 : 1;
  }
  return 0;
}

/* Centroids mirrored at the middle of the box are centroids again. */
static void CheckMirror(const MeshSerial *m, const Box *box)
{
  long(*left)[2] = malloc((size_t)m->ne * sizeof *left), (*right)[2] = malloc((size_t)m->ne * sizeof *right);
  for (int e = 0; e < m->ne; e++) {
    double c[2] = {0.0, 0.0};
    for (int i = 0; i < 6; i++) c[i % 2] += m->x[2 * m->vertex[3 * e + i / 2] + i % 2] / 3.0;
    left[e][0] = lround((c[0] - box->lower[0]) * 1e8);
    right[e][0] = lround((box->upper[0] - c[0]) * 1e8);
    left[e][1] = right[e][1] = lround((c[1] - box->lower[1]) * 1e8);
  }
  qsort(left, (size_t)m->ne, sizeof *left, ByPosition);
  qsort(right, (size_t)m->ne, sizeof *right, ByPosition);
  int differ = 0;
  for (int e = 0; e < m->ne; e++)
    differ += labs(left[e][0] - right[e][0]) > 2 || labs(left[e][1] - right[e][1]) > 2;
  CHECK(!differ, "%d of %d triangles have no mirror image", differ, m->ne);
  free(left);
  free(right);
}

int main(int argc, char **argv)
{
  /* In turn: the falling cylinder; uniform; a point, over seven levels; a sudden change of size, which
   * balance alone grades; a box narrower than size_max; the worst stretching. */
  const Box box[] = {
      {{0, 0}, {2.5, 5.5}, 0.06, {0.01, {1.08, 1.0}, {1.42, 4.95}, 0.25}, 42.0},
      {{0, 0}, {1, 1}, 0.25, {0.25, {0, 0}, {1, 1}, 0.0}, 44.99},
      {{-1.5, -1.5}, {1.5, 1.5}, 0.2, {0.001, {0.3, 0.3}, {0.3, 0.3}, 0.25}, 44.0},
      {{0, 0}, {1, 1}, 0.25, {0.004, {0.375, 0.375}, {0.499, 0.499}, 1e3}, 44.99},
      {{0, 0}, {0.1, 10}, 1.0, {1.0, {0, 0}, {1, 10}, 0.0}, 44.0},
      {{0, 0}, {1.02, 1}, 1.0, {1.0, {0, 0}, {1, 1}, 0.0}, 26.0},
  };
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  for (size_t k = 0; k < sizeof box / sizeof *box; k++) {
    MeshSerial m;
    Strip strip = box[k].strip;
    PetscCall(MeshBox(box[k].lower, box[k].upper, box[k].size_max, StripSize, &strip, &m));
    CheckTriangles(&m, &box[k]);
    CheckSizes(&m, &box[k]);
    CheckConforming(&m, &box[k]);
    if (k == 0) {
      CheckMirror(&m, &box[k]);
      CHECK(m.ne > 20000 && m.ne < 60000, "%d triangles", m.ne);
    }
    if (k == 1) CHECK(m.ne == 32 && m.nv == 25, "%d triangles, %d vertices", m.ne, m.nv);
    PetscCall(MeshSerialDestroy(&m));
  }
  return PetscFinalize();
}
