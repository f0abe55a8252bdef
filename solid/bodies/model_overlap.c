/* Bodies that reach into each other from the start. */
#include "solid/bodies/model.h"
#include "solid/contact/cell_grid.h"
#include "solid/contact/contact_kernel.h"

#define TOUCH 1e-9 /* phi up to which bodies that touch are not yet said to overlap */

typedef struct {
  const Model *a;
  int first, second;
} OverlapSearch;

/* The facet's edge, or the centre of the triangle behind it (which tells a body laid exactly over another),
 * lies in element e. */
static int Penetrates(const Model *a, int facet, int e)
{
  const int *behind = a->element + 3 * a->facet_element[facet];
  ContactIntegrals f[2];
  Point t[3], centre = {0.0, 0.0};
  for (int i = 0; i < 3; i++) {
    t[i] = PointAt(a->x, a->element[3 * e + i]);
    centre.x += PointAt(a->x, behind[i]).x / 3.0;
    centre.y += PointAt(a->x, behind[i]).y / 3.0;
  }
  f[0] = ContactEdgeTriangle(centre, centre, t);
  f[1] = ContactEdgeTriangle(PointAt(a->x, a->facet[2 * facet]), PointAt(a->x, a->facet[2 * facet + 1]), t);
  return (f[0].inside > 0.0 && f[0].largest_phi >= TOUCH) || (f[1].inside > 0.0 && f[1].largest_phi >= TOUCH);
}

static PetscErrorCode OverlapFound(void *context, int facet, int e)
{
  OverlapSearch *s = context;
  const Model *a = s->a;
  const int one = a->element_body[a->facet_element[facet]], other = a->element_body[e];
  if (one == other || s->first >= 0 || !Penetrates(a, facet, e)) return 0;
  s->first = PetscMin(one, other);
  s->second = PetscMax(one, other);
  return 0;
}

PetscErrorCode ModelOverlap(const Model *a, int *first, int *second)
{
  OverlapSearch s = {a, -1, -1};
  GeometryBox *facet, *element;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2((size_t)a->nfacets, &facet, (size_t)a->nelements, &element));
  for (int k = 0; k < a->nfacets; k++) facet[k] = GeometryBoxOfNodes(2, a->facet + 2 * k, a->x);
  for (int e = 0; e < a->nelements; e++) element[e] = GeometryBoxOfNodes(3, a->element + 3 * e, a->x);
  if (a->nbodies > 1) PetscCall(CellGridPairs(a->nfacets, facet, a->nelements, element, OverlapFound, &s));
  PetscCall(PetscFree2(facet, element));
  *first = s.first;
  *second = s.second;
  PetscFunctionReturn(0);
}
