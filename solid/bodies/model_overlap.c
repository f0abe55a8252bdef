/* Parts of bodies that reach into each other from the start. */
#include "solid/bodies/model.h"
#include "solid/contact/cell_grid.h"
#include "solid/contact/contact_kernel.h"
#include <float.h>

/* phi up to which parts that touch are not yet said to overlap, and so many units of round-off of their coordinates */
#define TOUCH 1e-9
#define UNITS 8.0

typedef struct {
  const Model *a;
  ModelPair *pair;
} OverlapSearch;

static Point Centre(const Model *a, int e)
{
  Point centre = {0.0, 0.0};
  for (int i = 0; i < 3; i++) {
    const Point x = PointAt(a->x, a->element[3 * e + i]);
    centre.x += x.x / 3.0;
    centre.y += x.y / 3.0;
  }
  return centre;
}

/* A point of an element that lies on no edge of another whose nodes are on the same lattice, as its centre may. */
static Point InnerPoint(const Model *a, int e)
{
  static const double WEIGHT[3] = {0.2877, 0.3019, 0.4104};
  Point inner = {0.0, 0.0};
  for (int i = 0; i < 3; i++) {
    const Point x = PointAt(a->x, a->element[3 * e + i]);
    inner.x += WEIGHT[i] * x.x;
    inner.y += WEIGHT[i] * x.y;
  }
  return inner;
}

static double Squared(Point p, Point q)
{
  return PointSquared(PointMinus(p, q));
}

/* By how much a rigid disc's corners lie outside of its circle. */
static double Protrusion(const Model *a, int e)
{
  const Body *body = &a->body[a->element_body[e]];
  double squared = 0.0;
  if (body->circle == 0.0) return 0.0;
  for (int i = 0; i < 3; i++)
    squared = fmax(squared, Squared(PointAt(a->x, a->element[3 * e + i]), PointAt(body->centre, 0)));
  return fmax(0.0, sqrt(squared) - body->circle);
}

static int CirclesOverlap(const Body *one, const Body *other)
{
  const double least = (1.0 - TOUCH) * (one->circle + other->circle);
  return Squared(PointAt(one->centre, 0), PointAt(other->centre, 0)) < least * least;
}

/* The facet's edge, or a point of the triangle behind it (which tells a part laid exactly over another),
 * lies in element e. */
static int Penetrates(const Model *a, int facet, int e)
{
  const Point inner = InnerPoint(a, a->facet_element[facet]);
  ContactIntegrals f[2];
  Point t[3];
  for (int i = 0; i < 3; i++) t[i] = PointAt(a->x, a->element[3 * e + i]);
  const double twice = TensorDeterminant(TensorOfEdges(t[0], t[1], t[2])),
               longest = sqrt(fmax(Squared(t[0], t[1]), fmax(Squared(t[1], t[2]), Squared(t[2], t[0])))),
               round_off = UNITS * DBL_EPSILON * fmax(fabs(inner.x), fabs(inner.y)),
               depth = round_off + Protrusion(a, e) + Protrusion(a, a->facet_element[facet]),
               allowed =
                   TOUCH + 3.0 * depth * longest / twice; /* phi is three times the depth over the height */
  f[0] = ContactEdgeTriangle(inner, inner, t);
  f[1] = ContactEdgeTriangle(PointAt(a->x, a->facet[2 * facet]), PointAt(a->x, a->facet[2 * facet + 1]), t);
  return (f[0].inside > 0.0 && f[0].largest_phi >= allowed) ||
         (f[1].inside > 0.0 && f[1].largest_phi >= allowed);
}

static int HaveCommonNode(const Model *a, int e, int f)
{
  for (int i = 0; i < 9; i++)
    if (a->element[3 * e + i / 3] == a->element[3 * f + i % 3]) return 1;
  return 0;
}

static PetscErrorCode OverlapFound(void *context, int facet, int e)
{
  OverlapSearch *s = context;
  const Model *a = s->a;
  const int behind = a->facet_element[facet], first = PetscMin(behind, e), second = PetscMax(behind, e);
  const Body *one = &a->body[a->element_body[behind]], *other = &a->body[a->element_body[e]];
  if (s->pair->element[0] >= 0 || HaveCommonNode(a, behind, e)) return 0;
  const int circles = one != other && one->circle > 0.0 && other->circle > 0.0;
  if (circles ? !CirclesOverlap(one, other) : !Penetrates(a, facet, e)) return 0;
  *s->pair = (ModelPair){{first, second}, {Centre(a, first), Centre(a, second)}};
  return 0;
}

PetscErrorCode ModelOverlap(const Model *a, ModelPair *pair)
{
  OverlapSearch s = {a, pair};
  GeometryBox *facet, *element;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2((size_t)a->nfacets, &facet, (size_t)a->nelements, &element));
  for (int k = 0; k < a->nfacets; k++) facet[k] = GeometryBoxOfNodes(2, a->facet + 2 * k, a->x);
  for (int e = 0; e < a->nelements; e++) element[e] = GeometryBoxOfNodes(3, a->element + 3 * e, a->x);
  *pair = (ModelPair){.element = {-1, -1}};
  PetscCall(CellGridPairs(a->nfacets, facet, a->nelements, element, OverlapFound, &s));
  PetscCall(PetscFree2(facet, element));
  PetscFunctionReturn(0);
}
