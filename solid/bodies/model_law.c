/* The elements of the model: shape at rest, law. */
#include "solid/bodies/model.h"

ElementLaw MaterialLaw(const Material *m)
{
  ElementLaw law = ElementLawOf(m->youngs_modulus, m->poisson_ratio, 0.0);
  law.plane_stress = m->plane_stress;
  law.corotated = m->corotated;
  return law;
}

Tensor ModelRestEdges(const Model *a, int e)
{
  const int *n = a->element + 3 * e;
  return TensorOfEdges(PointAt(a->rest, n[0]), PointAt(a->rest, n[1]), PointAt(a->rest, n[2]));
}

/* eta = 2 h beta sqrt(E rho), h the smallest height at rest. */
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
  return 2.0 * height * m->damping * sqrt(m->youngs_modulus * m->density);
}

ElementLaw ModelElementLaw(const Model *a, int e)
{
  const Material *m = &a->material[a->element_material[e]];
  ElementLaw law = MaterialLaw(m);
  law.mu *= m->thickness;
  law.lambda *= m->thickness;
  law.eta = m->thickness * Viscosity(a, e);
  return law;
}
