/* Bodies that keep their shape. */
#include "solid/bodies/model_impl.h"
#include <math.h>

static void AddMass(const Model *a, int first, const double centre[2], RigidBody *rigid)
{
  for (int k = 3 * first; k < 3 * a->nelements; k++) {
    const double m = ModelCornerMass(a, k / 3);
    const Point r = PointMinus(PointAt(a->rest, a->element[k]), (Point){centre[0], centre[1]});
    rigid->mass += m;
    rigid->inertia += m * (r.x * r.x + r.y * r.y);
  }
}

/* int 1/M + (r x n)^2/I over the surface, whose facets are the model's last. */
static double SurfaceCompliance(const Model *a, int first, const RigidBody *rigid, const double centre[2])
{
  double sum = 0.0;
  int k = a->nfacets;
  while (k > 0 && a->facet_element[k - 1] >= first) k--;
  for (; k < a->nfacets; k++) {
    const Point p = PointMinus(PointAt(a->rest, a->facet[2 * k]), (Point){centre[0], centre[1]}),
                q = PointMinus(PointAt(a->rest, a->facet[2 * k + 1]), (Point){centre[0], centre[1]}),
                d = PointMinus(q, p);
    const double length = hypot(d.x, d.y), at_p = p.x * d.x + p.y * d.y, at_q = q.x * d.x + q.y * d.y;
    sum += length / rigid->mass + (at_p * at_p + at_p * at_q + at_q * at_q) / (3.0 * length * rigid->inertia);
  }
  return sum;
}

static PetscErrorCode CheckRigid(const Model *a, const BodySetup *setup, int first, PetscBool *rigid)
{
  int n = 0;
  for (int e = first; e < a->nelements; e++) n += a->material[a->element_material[e]].rigid != 0;
  *rigid = (PetscBool)(n > 0);
  if (n == 0) return 0;
  if (n < a->nelements - first)
    return ModelRefuse("a body is rigid as a whole: all of its regions have a rigid material, or none");
  if (setup->nfixed > 0) return ModelRefuse("a rigid body is held as a whole (fixed: true) or not at all");
  if (setup->position || setup->stretch[0] != 1.0 || setup->stretch[1] != 1.0)
    return ModelRefuse("a rigid body has no stretch");
  for (int k = 0; k < setup->nprescribed; k++)
    if (setup->prescribed[k].boundary)
      return ModelRefuse("a rigid body moves as prescribed as a whole: without a boundary");
  for (int e = first; e < a->nelements; e++)
    if (a->jointed[e]) return ModelRefuse("a rigid body has no joints: it does not crack");
  return 0;
}

PetscErrorCode ModelMeasureRigid(const Model *a, const BodySetup *setup, int first, Body *body)
{
  PetscBool rigid;
  const PetscErrorCode code = CheckRigid(a, setup, first, &rigid);
  if (code || !rigid || setup->fixed) return code;
  AddMass(a, first, body->centre, &body->rigid);
  body->rigid.surface_compliance = SurfaceCompliance(a, first, &body->rigid, body->centre);
  return 0;
}
