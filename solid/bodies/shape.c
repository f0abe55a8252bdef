#include "solid/bodies/shape.h"

static PetscErrorCode Allocate(int nv, int ne, int nb, int ntags, const char *const names[], MeshSerial *m)
{
  PetscFunctionBeginUser;
  memset(m, 0, sizeof *m);
  m->nv = nv;
  m->ne = ne;
  m->nb = nb;
  m->ntags = ntags;
  PetscCall(PetscMalloc1(2 * (size_t)nv, &m->x));
  PetscCall(PetscMalloc1(3 * (size_t)ne, &m->vertex));
  PetscCall(PetscMalloc1(2 * (size_t)nb, &m->facet));
  PetscCall(PetscMalloc1((size_t)nb, &m->facet_tag));
  PetscCall(PetscMalloc1((size_t)ntags, &m->tag_name));
  for (int k = 0; k < ntags; k++) PetscCall(PetscStrncpy(m->tag_name[k], names[k], sizeof m->tag_name[k]));
  PetscFunctionReturn(0);
}

static void SetTriangle(MeshSerial *m, int e, int a, int b, int c)
{
  m->vertex[3 * e] = a;
  m->vertex[3 * e + 1] = b;
  m->vertex[3 * e + 2] = c;
}

static void SetFacet(MeshSerial *m, int b, int from, int to, int tag)
{
  m->facet[2 * b] = from;
  m->facet[2 * b + 1] = to;
  m->facet_tag[b] = tag;
}

/* Node i (taken round) of ring k; ring 0 is the centre. */
static int RingNode(int k, int i)
{
  return k == 0 ? 0 : 1 + 3 * k * (k - 1) + i % (6 * k);
}

/* The triangles between rings k - 1 and k: in each of six sectors k point inwards and k - 1 outwards.
 *
 *     ring k      0---1---2---3
 *                  \ / \ / \ /
 *     ring k-1      0---1---2                                                                              */
static int FillRing(MeshSerial *m, int k, int e)
{
  for (int sector = 0; sector < 6; sector++)
    for (int i = 0; i < k; i++) {
      const int outer = sector * k + i, inner = sector * (k - 1) + i;
      SetTriangle(m, e++, RingNode(k, outer), RingNode(k, outer + 1), RingNode(k - 1, inner));
      if (i < k - 1)
        SetTriangle(m, e++, RingNode(k - 1, inner), RingNode(k, outer + 1), RingNode(k - 1, inner + 1));
    }
  return e;
}

PetscErrorCode ShapeEllipse(const double centre[2], const double radii[2], double turned, double size,
                            MeshSerial *mesh)
{
  static const char *const NAMES[] = {"boundary"};
  const int rings = PetscMax(2, (int)ceil(M_PI * PetscMax(radii[0], radii[1]) / (3.0 * size))),
            sides = 6 * rings;
  /* polygon of n sides and circumradius R: area n R^2 sin(2 pi/n)/2 */
  const double outside = sqrt(2.0 * M_PI / (sides * sin(2.0 * M_PI / sides))), cosine = cos(turned),
               sine = sin(turned);
  PetscFunctionBeginUser;
  PetscCall(Allocate(1 + 3 * rings * (rings + 1), 6 * rings * rings, sides, 1, NAMES, mesh));
  for (int k = 0, e = 0; k <= rings; k++) {
    for (int i = 0; i < PetscMax(1, 6 * k); i++) {
      const double angle = k ? 2.0 * M_PI * i / (6 * k) : 0.0,
                   x = radii[0] * outside * k / rings * cos(angle),
                   y = radii[1] * outside * k / rings * sin(angle);
      mesh->x[2 * RingNode(k, i)] = centre[0] + cosine * x - sine * y;
      mesh->x[2 * RingNode(k, i) + 1] = centre[1] + sine * x + cosine * y;
    }
    if (k) e = FillRing(mesh, k, e);
  }
  for (int i = 0; i < sides; i++) SetFacet(mesh, i, RingNode(rings, i), RingNode(rings, i + 1), 0);
  PetscFunctionReturn(0);
}

PetscErrorCode ShapeDisc(const double centre[2], double radius, double size, MeshSerial *mesh)
{
  const double radii[2] = {radius, radius};
  return ShapeEllipse(centre, radii, 0.0, size, mesh);
}

static void FillCells(MeshSerial *m, int nx, int ny)
{
  for (int j = 0, e = 0; j < ny; j++)
    for (int i = 0; i < nx; i++, e += 2) {
      const int a = j * (nx + 1) + i, b = a + 1, c = b + nx + 1, d = c - 1;
      if ((i + j) % 2) {
        SetTriangle(m, e, a, b, d);
        SetTriangle(m, e + 1, b, c, d);
      } else {
        SetTriangle(m, e, a, b, c);
        SetTriangle(m, e + 1, a, c, d);
      }
    }
}

static void FillSides(MeshSerial *m, int nx, int ny)
{
  const int row = nx + 1;
  int b = 0;
  for (int j = ny; j > 0; j--) SetFacet(m, b++, j * row, (j - 1) * row, 0);
  for (int j = 0; j < ny; j++) SetFacet(m, b++, j * row + nx, (j + 1) * row + nx, 1);
  for (int i = 0; i < nx; i++) SetFacet(m, b++, i, i + 1, 2);
  for (int i = nx; i > 0; i--) SetFacet(m, b++, ny * row + i, ny * row + i - 1, 3);
}

PetscErrorCode ShapeRectangle(const double centre[2], double width, double height, double angle, double size,
                              MeshSerial *mesh)
{
  static const char *const NAMES[] = {"left", "right", "bottom", "top"};
  /* a hair of slack, so that 1.0 / 0.1 gives 10 */
  const int nx = PetscMax(1, (int)ceil(width / size - 1e-9)),
            ny = PetscMax(1, (int)ceil(height / size - 1e-9));
  const double cosine = cos(angle), sine = sin(angle);
  PetscFunctionBeginUser;
  PetscCall(Allocate((nx + 1) * (ny + 1), 2 * nx * ny, 2 * (nx + ny), 4, NAMES, mesh));
  for (int j = 0; j <= ny; j++)
    for (int i = 0; i <= nx; i++) {
      const double x = width * ((double)i / nx - 0.5), y = height * ((double)j / ny - 0.5);
      double *node = mesh->x + 2 * (j * (nx + 1) + i);
      node[0] = centre[0] + cosine * x - sine * y;
      node[1] = centre[1] + sine * x + cosine * y;
    }
  FillCells(mesh, nx, ny);
  FillSides(mesh, nx, ny);
  PetscFunctionReturn(0);
}

/*     outer   b---c        cells of two triangles, diagonals alternating
 *             |   |
 *     inner   a---d   i counts counter-clockwise */
PetscErrorCode ShapeRing(const double centre[2], double inner, double outer, int layers, double size,
                         MeshSerial *mesh)
{
  static const char *const NAMES[] = {"inner", "outer"};
  const int n = PetscMax(6, 2 * (int)ceil(M_PI * outer / size - 1e-9));
  const double factor = sqrt(2.0 * M_PI / (n * sin(2.0 * M_PI / n)));
  PetscFunctionBeginUser;
  PetscCall(Allocate(n * (layers + 1), 2 * n * layers, 2 * n, 2, NAMES, mesh));
  for (int j = 0; j <= layers; j++)
    for (int i = 0; i < n; i++) {
      const double angle = 2.0 * M_PI * i / n, r = factor * (inner + (outer - inner) * j / layers);
      mesh->x[2 * (j * n + i)] = centre[0] + r * cos(angle);
      mesh->x[2 * (j * n + i) + 1] = centre[1] + r * sin(angle);
    }
  for (int j = 0, e = 0; j < layers; j++)
    for (int i = 0; i < n; i++, e += 2) {
      const int a = j * n + i, d = j * n + (i + 1) % n, b = a + n, c = d + n;
      SetTriangle(mesh, e, a, b, (i + j) % 2 ? d : c);
      SetTriangle(mesh, e + 1, (i + j) % 2 ? b : a, c, d);
    }
  for (int i = 0; i < n; i++) {
    SetFacet(mesh, i, (i + 1) % n, i, 0);
    SetFacet(mesh, n + i, layers * n + i, layers * n + (i + 1) % n, 1);
  }
  PetscFunctionReturn(0);
}

void ShapeRingStretched(const double centre[2], const double stretch[2], ElementLaw law,
                        const MeshSerial *mesh, double x[])
{
  const Point inner = PointAt(mesh->x, 0), outer = PointAt(mesh->x, mesh->nv - 1);
  const double middle = 0.5 * (hypot(inner.x - centre[0], inner.y - centre[1]) +
                               hypot(outer.x - centre[0], outer.y - centre[1]));
  for (int v = 0; v < mesh->nv; v++) {
    const double rx = mesh->x[2 * v] - centre[0], ry = mesh->x[2 * v + 1] - centre[1], r = hypot(rx, ry);
    const double cosine = rx / r, sine = ry / r;
    const double along = hypot(stretch[0] * sine, stretch[1] * cosine); /* of the tangent */
    const double thickness_stretch = ElementFreeStretch(along, law) * (r - middle) / along;
    x[2 * v] = centre[0] + stretch[0] * middle * cosine + thickness_stretch * stretch[1] * cosine;
    x[2 * v + 1] = centre[1] + stretch[1] * middle * sine + thickness_stretch * stretch[0] * sine;
  }
}
