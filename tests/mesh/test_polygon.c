/* Meshes of polygons: area, smallest angle, edges, sides and their names; either sense, map coordinates, a sharp corner, a wall thinner than an edge. */
#include "tests/mesh/strip.h"

typedef struct {
  int n;
  double corner[8][2], size;
  double area, angle, least; /* m2; degrees; the shortest edge over the size */
} Outline;

static void CheckTriangles(const MeshSerial *m, const Outline *o)
{
  double area = 0.0, angle = M_PI, shortest = HUGE_VAL, longest = 0.0;
  for (int e = 0; e < m->ne; e++) {
    const int *v = &m->vertex[3 * e];
    area += TriangleArea(m->x, v);
    CHECK(TriangleArea(m->x, v) > 0.0, "triangle %d is clockwise or flat", e);
    for (int i = 0; i < 3; i++) {
      const double *a = &m->x[2 * v[i]], *b = &m->x[2 * v[(i + 1) % 3]], *c = &m->x[2 * v[(i + 2) % 3]];
      const double p[2] = {b[0] - a[0], b[1] - a[1]}, q[2] = {c[0] - a[0], c[1] - a[1]};
      angle = fmin(angle, atan2(p[0] * q[1] - p[1] * q[0], p[0] * q[0] + p[1] * q[1]));
      shortest = fmin(shortest, hypot(p[0], p[1]));
      longest = fmax(longest, hypot(p[0], p[1]));
    }
  }
  CHECK(fabs(area / o->area - 1.0) < 1e-9, "area %.15g, not %.15g", area, o->area);
  CHECK(angle * 180.0 / M_PI > o->angle, "smallest angle %g, not %g", angle * 180.0 / M_PI, o->angle);
  CHECK(shortest > o->least * o->size && longest < 1.35 * o->size, "edges from %g to %g, size %g", shortest,
        longest, o->size);
}

/* Edges of side k, called "side <k>", lie on it, run on with the domain to their left, none longer than the size, and add up to its length. */
static void CheckSides(const MeshSerial *m, const Outline *o, int turns)
{
  double length[8] = {0.0};
  for (int b = 0; b < m->nb; b++) {
    const double *p = &m->x[2 * m->facet[2 * b]], *q = &m->x[2 * m->facet[2 * b + 1]];
    const int k = m->tag_name[m->facet_tag[b]][5] - '0';
    const double *from = o->corner[k], *to = o->corner[(k + 1) % o->n];
    const double side = hypot(to[0] - from[0], to[1] - from[1]),
                 t[2] = {(to[0] - from[0]) / side, (to[1] - from[1]) / side};
    const double off = fmax(fabs((p[0] - from[0]) * t[1] - (p[1] - from[1]) * t[0]),
                            fabs((q[0] - from[0]) * t[1] - (q[1] - from[1]) * t[0]));
    const double along = turns * ((q[0] - p[0]) * t[0] + (q[1] - p[1]) * t[1]);
    CHECK(off < 1e-15 * (fabs(from[0]) + fabs(from[1]) + side) * 4.0, "an edge of side %d is %g off", k, off);
    CHECK(along > 0.0 && along < o->size * (1.0 + 1e-9), "an edge of side %d is %g long", k, along);
    length[k] += along;
  }
  for (int k = 0; k < o->n; k++) {
    const double *from = o->corner[k], *to = o->corner[(k + 1) % o->n];
    CHECK(fabs(length[k] / hypot(to[0] - from[0], to[1] - from[1]) - 1.0) < 1e-9, "side %d is %g long", k,
          length[k]);
  }
}

static PetscErrorCode Check(const Outline *o, int turns)
{
  static const char *const NAMES[] = {"side 0", "side 1", "side 2", "side 3",
                                      "side 4", "side 5", "side 6", "side 7"};
  MeshSerial m;
  int components;
  PetscCall(MeshPolygon(o->n, o->corner, NAMES, o->size, &m));
  CheckTriangles(&m, o);
  CheckSides(&m, o, turns);
  PetscCall(MeshSerialComponents(&m, &components));
  CHECK(components == 1 && m.ntags == o->n, "%d components, %d boundaries", components, m.ntags);
  return MeshSerialDestroy(&m);
}

/* Sides of one name are one boundary; the mesh repeats itself. */
static PetscErrorCode Names(const Outline *o)
{
  static const char *const NAMES[] = {"wall", "slope", "wall", "top", "wall", "wall", "wall", "wall"};
  MeshSerial m, again;
  PetscCall(MeshPolygon(o->n, o->corner, NAMES, o->size, &m));
  PetscCall(MeshPolygon(o->n, o->corner, NAMES, o->size, &again));
  CHECK(m.ntags == 3 && !strcmp(m.tag_name[0], "wall") && !strcmp(m.tag_name[2], "top"), "%d names", m.ntags);
  CHECK(m.nv == again.nv && !memcmp(m.x, again.x, 2 * (size_t)m.nv * sizeof *m.x), "another mesh");
  PetscCall(MeshSerialDestroy(&again));
  return MeshSerialDestroy(&m);
}

static PetscErrorCode Run(void)
{
  const Outline
      square = {4, {{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}}, 0.04, 1.0, 29.0, 0.4},
      turned = {4, {{0.0, 0.0}, {0.0, 1.0}, {1.0, 1.0}, {1.0, 0.0}}, 0.1, 1.0, 29.0, 0.4},
      beach = {5, {{0.0, 0.0}, {2.0, 0.0}, {4.0, 0.8}, {4.0, 1.2}, {0.0, 1.2}}, 0.1, 4.0, 28.0, 0.4},
      corner = {6,  {{0.0, 0.0}, {2.0, 0.0}, {2.0, 1.0}, {1.0, 1.0}, {1.0, 2.0}, {0.0, 2.0}}, 0.13, 3.0, 28.0,
                0.4},
      map = {4,    {{4e5, 6e6}, {4e5 + 3.0, 6e6}, {4e5 + 4.0, 6e6 + 1.0}, {4e5 - 1.0, 6e6 + 1.0}},
             0.2,  4.0,
             28.0, 0.4},
      sharp = {3, {{0.0, 0.0}, {10.0, 0.0}, {10.0, 1.0}}, 0.2, 5.0, 5.6, 0.05},
      thin = {4, {{0.0, 0.0}, {3.0, 0.0}, {3.0, 0.02}, {0.0, 0.02}}, 0.3, 0.06, 20.0, 0.05},
      notch = {7,    {{0.0, 0.0}, {2.0, 0.0}, {2.0, 0.99}, {1.0, 1.0}, {2.0, 1.01}, {2.0, 2.0}, {0.0, 2.0}},
               0.2,  3.99,
               25.0, 0.2};
  PetscFunctionBeginUser;
  PetscCall(Check(&square, 1));
  PetscCall(Check(&turned, -1));
  PetscCall(Check(&beach, 1));
  PetscCall(Check(&corner, 1));
  PetscCall(Check(&map, 1));
  PetscCall(Check(&sharp, 1));
  PetscCall(Check(&thin, 1));
  PetscCall(Check(&notch, 1));
  PetscCall(Names(&beach));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(Run());
  return PetscFinalize();
}
