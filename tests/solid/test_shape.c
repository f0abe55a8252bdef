/* Built-in bodies: area, quality, orientation, surface and boundary names; what a model refuses. */
#include "solid/plane.h"
#include "tests/solid/build.h"

static Point At(const MeshSerial *m, int v)
{
  return PointAt(m->x, v);
}

/* Positive area everywhere; smallest angle, degrees; longest edge. */
static void Quality(const MeshSerial *m, double *area, double *angle, double *longest)
{
  *area = *longest = 0.0;
  *angle = 180.0;
  for (int e = 0; e < m->ne; e++) {
    Point p[3];
    for (int i = 0; i < 3; i++) p[i] = At(m, m->vertex[3 * e + i]);
    const double twice = TensorDeterminant(TensorOfEdges(p[0], p[1], p[2]));
    CHECK(twice > 0.0, "element %d has area %g", e, 0.5 * twice);
    *area += 0.5 * twice;
    for (int i = 0; i < 3; i++) {
      const Point a = PointMinus(p[(i + 1) % 3], p[i]), b = PointMinus(p[(i + 2) % 3], p[i]);
      *angle = fmin(*angle, atan2(PointCross(a, b), a.x * b.x + a.y * b.y) * 180.0 / M_PI);
      *longest = fmax(*longest, hypot(a.x, a.y));
    }
  }
}

static PetscErrorCode Disc(double radius, double size)
{
  const double centre[2] = {1.25, 18.0};
  double area, angle, longest, perimeter = 0.0;
  MeshSerial m;
  PetscCall(ShapeDisc(centre, radius, size, &m));
  Quality(&m, &area, &angle, &longest);
  CHECK(fabs(area / (M_PI * radius * radius) - 1.0) < 1e-12, "area %.15g", area);
  CHECK(angle > 40.0, "smallest angle %g", angle);
  for (int b = 0; b < m.nb; b++) {
    const Point p = At(&m, m.facet[2 * b]), q = At(&m, m.facet[2 * b + 1]),
                centred = {p.x - 1.25, p.y - 18.0};
    const double length = hypot(q.x - p.x, q.y - p.y);
    CHECK(PointCross(centred, PointMinus(q, p)) > 0.0, "facet %d: the disc is not on the left", b);
    perimeter += length;
    CHECK(length < size * 1.02, "edge %g, size %g", length, size);
  }
  /* a regular polygon of n sides: perimeter^2 = 4 n area tan(pi/n) */
  CHECK(fabs(perimeter * perimeter / (4.0 * m.nb * area * tan(M_PI / m.nb)) - 1.0) < 1e-12, "perimeter %g",
        perimeter);
  return MeshSerialDestroy(&m);
}

/* Area; where it ends along its axes, which are turned; edges of the boundary. */
static PetscErrorCode Ellipse(void)
{
  const double centre[2] = {0.3, -0.2}, radii[2] = {0.25, 1.0}, turned = 0.4;
  double area, angle, longest, extent[2] = {0.0, 0.0};
  MeshSerial m;
  PetscCall(ShapeEllipse(centre, radii, turned, 0.1, &m));
  Quality(&m, &area, &angle, &longest);
  CHECK(fabs(area / (M_PI * radii[0] * radii[1]) - 1.0) < 1e-12, "area %.15g", area);
  for (int b = 0; b < m.nb; b++) {
    const Point p = At(&m, m.facet[2 * b]), q = At(&m, m.facet[2 * b + 1]),
                d = {p.x - centre[0], p.y - centre[1]};
    extent[0] = fmax(extent[0], d.x * cos(turned) + d.y * sin(turned));
    extent[1] = fmax(extent[1], d.y * cos(turned) - d.x * sin(turned));
    CHECK(hypot(q.x - p.x, q.y - p.y) < 0.1 * 1.02, "edge %g", hypot(q.x - p.x, q.y - p.y));
  }
  for (int k = 0; k < 2; k++)
    CHECK(fabs(extent[k] / radii[k] - 1.0) < 2e-3, "it ends %g from its centre, not %g", extent[k], radii[k]);
  return MeshSerialDestroy(&m);
}

static PetscErrorCode Rectangle(void)
{
  const double centre[2] = {0.3, -0.2};
  double area, angle, longest;
  int edges[4] = {0, 0, 0, 0};
  MeshSerial m;
  PetscCall(ShapeRectangle(centre, 1.0, 0.4, 0.7, 0.1, &m));
  Quality(&m, &area, &angle, &longest);
  CHECK(m.ne == 2 * 10 * 4, "%d elements", m.ne);
  CHECK(fabs(area - 0.4) < 1e-14 && angle > 44.999, "area %.15g, angle %g", area, angle);
  for (int b = 0; b < m.nb; b++) edges[m.facet_tag[b]]++;
  CHECK(edges[0] == 4 && edges[1] == 4 && edges[2] == 10 && edges[3] == 10, "%d %d %d %d", edges[0], edges[1],
        edges[2], edges[3]);
  CHECK(!strcmp(m.tag_name[1], "right"), "%s", m.tag_name[1]);
  return MeshSerialDestroy(&m);
}

/* The surface found in the model is the one that the shape gave, and nodes of a boundary are fixed. */
static PetscErrorCode Surface(void)
{
  static const char *const NAMES[] = {"bottom", "right"};
  BodySetup setup = BodyAtRest(MaterialOf(1000.0, 1e6, 0.3, 0.0));
  Model a = {0};
  double circulation = 0.0;
  int fixed = 0;
  setup.nfixed = 2;
  setup.fixed_name = NAMES;
  setup.velocity[1] = 3.0;
  AddRectangle(&a, 0.0, 0.0, 1.0, 0.4, 0.0, 0.1, 1, &setup);
  CHECK(a.nfacets == 28, "%d facets", a.nfacets);
  for (int k = 0; k < a.nfacets; k++)
    circulation += 0.5 * PointCross(PointAt(a.x, a.facet[2 * k]), PointAt(a.x, a.facet[2 * k + 1]));
  CHECK(fabs(circulation - 0.4) < 1e-14, "area within the facets %g", circulation);
  for (int n = 0; n < a.nnodes; n++) {
    const int expected = a.rest[2 * n + 1] < -0.1999 || a.rest[2 * n] > 0.4999;
    CHECK(a.fixed[n] == expected && a.u[2 * n + 1] == (expected ? 0.0 : 3.0), "node %d", n);
    fixed += a.fixed[n];
  }
  CHECK(fixed == 15, "%d fixed", fixed);
  return ModelDestroy(&a);
}

static void Refused(int vertex_moved, double x, const char *name, const char *expected)
{
  const double centre[2] = {0.0, 0.0};
  BodySetup setup = BodyAtRest(MaterialOf(1000.0, 1e6, 0.3, 0.0));
  MeshSerial m;
  Model a = {0};
  const char *why = "";
  (void)ShapeRectangle(centre, 1.0, 1.0, 0.0, 0.5, &m);
  m.x[2 * vertex_moved] = x;
  setup.nfixed = name != NULL;
  setup.fixed_name = &name;
  const PetscErrorCode code = ModelAdd(&a, &m, &setup, &why);
  CHECK(code && strstr(why, expected), "got '%s', expected '%s'", why, expected);
  (void)MeshSerialDestroy(&m);
  (void)ModelDestroy(&a);
}

int main(int argc, char **argv)
{
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(Disc(0.125, 0.015));
  PetscCall(Disc(0.125, 0.2));
  PetscCall(Disc(2.0, 0.05));
  PetscCall(Ellipse());
  PetscCall(Rectangle());
  PetscCall(Surface());
  Refused(4, 0.6, NULL, "is inverted: its area is");
  Refused(4, 0.5, NULL, "is degenerate: its area is");
  Refused(0, -0.5, "lid", "no boundary or region 'lid'; it has left, right, bottom, top");
  return PetscFinalize();
}
