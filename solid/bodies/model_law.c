/* The elements of the model: shape at rest, law. */
#include "solid/bodies/model.h"
#include <math.h>

ElementLaw MaterialLaw(const Material *m)
{
  ElementLaw law = ElementLawOf(m->youngs_modulus, m->poisson_ratio, 0.0);
  law.plane_stress = m->plane_stress;
  law.kind = m->law;
  return law;
}

Tensor ModelRestEdges(const Model *a, int e)
{
  const int *n = a->element + 3 * e;
  return TensorOfEdges(PointAt(a->rest, n[0]), PointAt(a->rest, n[1]), PointAt(a->rest, n[2]));
}

double ModelElementMass(const Model *a, int e)
{
  const Material *m = &a->material[a->element_material[e]];
  return 0.5 * m->density * m->thickness * TensorDeterminant(ModelRestEdges(a, e));
}

double ModelCornerMass(const Model *a, int corner)
{
  const Body *body = &a->body[a->element_body[corner / 3]];
  return ModelElementMass(a, corner / 3) / 3.0 * BodyMassFactor(body, PointAt(a->rest, a->element[corner]));
}

/* Of the damping ratio xi at frequency f in tension along one axis: 2 xi E'/(2 pi f) = eta (1 + q^2), E' the modulus and
 * q the contraction across the axis over the stretch along it. */
static double MaterialViscosity(const Material *m)
{
  const double nu = m->poisson_ratio, q = m->plane_stress ? nu : nu / (1.0 - nu);
  const double modulus = m->youngs_modulus / (m->plane_stress ? 1.0 : 1.0 - nu * nu);
  return m->damping_ratio > 0.0 ? m->damping_ratio * modulus / (M_PI * m->damping_frequency * (1.0 + q * q))
                                : 0.0;
}

/* eta = 2 h beta sqrt(E rho), h the smallest height at rest, and that of the material. */
static double Viscosity(const Model *a, int e)
{
  const Material *m = &a->material[a->element_material[e]];
  double longest = 0.0;
  for (int i = 0; i < 3; i++) {
    const Point d = PointMinus(PointAt(a->rest, a->element[3 * e + (i + 1) % 3]),
                               PointAt(a->rest, a->element[3 * e + i]));
    longest = fmax(longest, hypot(d.x, d.y));
  }
  const double height = TensorDeterminant(ModelRestEdges(a, e)) / longest;
  return 2.0 * height * m->damping * sqrt(m->youngs_modulus * m->density) + MaterialViscosity(m);
}

ElementLaw ModelElementLaw(const Model *a, int e)
{
  const Material *m = &a->material[a->element_material[e]];
  ElementLaw law = MaterialLaw(m);
  if (m->rigid) return (ElementLaw){.kind = LAW_NEO_HOOKEAN};
  law.mu *= m->thickness;
  law.lambda *= m->thickness;
  law.eta = m->thickness * Viscosity(a, e);
  return law;
}
