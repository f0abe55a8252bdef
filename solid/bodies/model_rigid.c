/* Bodies that keep their shape. */
#include "solid/bodies/model_impl.h"
#include <math.h>

#define LEAST_FACTOR 0.1 /* of a node's mass */
#define SINGULAR 1e-9    /* of a pivot of the moments' matrix */

/* r.r over a triangle of mass m is m/12 (the sum over the corners, and that of the corners' sum). */
static void AddMass(const Model *a, int first, const double centre[2], RigidBody *rigid)
{
  for (int e = first; e < a->nelements; e++) {
    const double m = ModelElementMass(a, e);
    Point sum = {0.0, 0.0};
    rigid->mass += m;
    for (int i = 0; i < 3; i++) {
      const Point r = PointMinus(PointAt(a->rest, a->element[3 * e + i]), (Point){centre[0], centre[1]});
      rigid->inertia += m / 12.0 * PointSquared(r);
      sum = (Point){sum.x + r.x, sum.y + r.y};
    }
    rigid->inertia += m / 12.0 * PointSquared(sum);
  }
}

/* Solves A x = b, A positive definite, by A = L D L^T; 0: it is singular. */
static int SolveMoments(double a[4][4], double x[4])
{
  for (int k = 0; k < 4; k++) {
    const double diagonal = a[k][k];
    for (int j = 0; j < k; j++) a[k][k] -= a[k][j] * a[k][j] * a[j][j];
    if (!(a[k][k] > SINGULAR * diagonal)) return 0;
    for (int i = k + 1; i < 4; i++) {
      for (int j = 0; j < k; j++) a[i][k] -= a[i][j] * a[k][j] * a[j][j];
      a[i][k] /= a[k][k];
    }
  }
  for (int k = 0; k < 4; k++)
    for (int j = 0; j < k; j++) x[k] -= a[k][j] * x[j];
  for (int k = 3; k >= 0; k--) {
    x[k] /= a[k][k];
    for (int i = k + 1; i < 4; i++) x[k] -= a[i][k] * x[i];
  }
  return 1;
}

/* The masses at the nodes times a polynomial, so that mass and mass centre stay and their moment of inertia is the body's: the thirds' is larger, 4 % for a disc of
 * 24 edges.  Nodes that are all as far from the centre (four corners) have no such masses: then theirs is the body's. */
static void MatchInertia(Model *a, int first, Body *body)
{
  RigidBody *rigid = &body->rigid;
  const double length = sqrt(rigid->inertia / rigid->mass);
  double moment[4][4] = {{0.0}}, x[4] = {0.0}, lumped = 0.0, least = HUGE_VAL;
  for (int k = 3 * first; k < 3 * a->nelements; k++) {
    const Point r = PointMinus(PointAt(a->rest, a->element[k]), PointAt(body->centre, 0));
    const double m = ModelElementMass(a, k / 3) / (3.0 * rigid->mass),
                 p[4] = {1.0, r.x / length, r.y / length, PointSquared(r) / (length * length)};
    lumped += m * rigid->mass * PointSquared(r);
    for (int i = 0; i < 16; i++) moment[i / 4][i % 4] += m * p[i / 4] * p[i % 4];
  }
  x[3] = (rigid->inertia - lumped) / (rigid->mass * length * length);
  if (SolveMoments(moment, x))
    for (int i = 0; i < 4; i++)
      rigid->mass_factor[i] = x[i] / (i == 0 ? 1.0 : i < 3 ? length : length * length);
  for (int k = 3 * first; k < 3 * a->nelements; k++)
    least = fmin(least, 3.0 * ModelCornerMass(a, k) / ModelElementMass(a, k / 3));
  if (least >= LEAST_FACTOR && rigid->mass_factor[3] != 0.0) return;
  for (int i = 0; i < 4; i++) rigid->mass_factor[i] = 0.0;
  rigid->inertia = lumped;
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

PetscErrorCode ModelMeasureRigid(Model *a, const BodySetup *setup, int first, Body *body)
{
  PetscBool rigid;
  const PetscErrorCode code = CheckRigid(a, setup, first, &rigid);
  if (code || !rigid) return code;
  body->circle = setup->circle;
  if (setup->fixed) return 0;
  AddMass(a, first, body->centre, &body->rigid);
  MatchInertia(a, first, body);
  body->rigid.surface_compliance = SurfaceCompliance(a, first, &body->rigid, body->centre);
  return 0;
}
