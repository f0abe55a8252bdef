/* The loops over this rank's elements. */
#include "solid/solid_impl.h"
#include "solid/vectorize.h"
#include <stdio.h>

static inline Tensor RestInverse(const Elements *e, int k)
{
  return (Tensor){e->inverse[0][k], e->inverse[1][k], e->inverse[2][k], e->inverse[3][k]};
}

static inline Tensor EdgesOf(const Elements *e, int k, const double value[])
{
  return TensorOfEdges(PointAt(value, e->node[0][k]), PointAt(value, e->node[1][k]),
                       PointAt(value, e->node[2][k]));
}

void SolidListCorners(Solid s)
{
  const int ne = s->elements.n;
  for (int n = 0; n <= s->nnodes; n++) s->corner_start[n] = 0;
  for (int k = 0; k < 3 * ne; k++) s->corner_start[s->element[k] + 1]++;
  for (int n = 0; n < s->nnodes; n++) s->corner_start[n + 1] += s->corner_start[n];
  for (int k = 3 * ne - 1; k >= 0; k--) /* fills from behind, then shifts back */
    s->corner[--s->corner_start[s->element[k] + 1]] = (k % 3) * ne + k / 3;
  for (int n = 0; n < s->nnodes; n++) s->corner_start[n] = s->corner_start[n + 1];
  s->corner_start[s->nnodes] = 3 * ne;
}

void SolidElementShape(const Elements *e, int k, const double x[], Tensor *edges, Tensor *f)
{
  *edges = EdgesOf(e, k, x);
  *f = TensorProduct(*edges, RestInverse(e, k));
}

/* Forces of all corners; returns the number of elements that are inside out (or not a number).  The arrays do
 * not overlap (ivdep), so that the loop is vectorised without asking at run time; laws (which there may be),
 * damped and jointed are constants of the caller, so that what is not needed falls away. */
static inline __attribute__((always_inline)) int
CornerForces(const Elements *e, const double x[], const double v[], ElementLaws laws, int damped, int jointed)
{
  const int n = e->n, *a = e->node[0], *b = e->node[1], *c = e->node[2];
  const double *ixx = e->inverse[0], *ixy = e->inverse[1], *iyx = e->inverse[2], *iyy = e->inverse[3];
  const double *mu = e->mu, *lambda = e->lambda, *eta = e->eta;
  const double *plane_stress = e->plane_stress, *kind = e->kind;
  double *fx = e->force[0], *fy = e->force[1];
  double *sxx = e->stress[0], *syy = e->stress[1], *sxy = e->stress[2];
  int bad = 0;
  VECTORIZE
  for (int k = 0; k < n; k++) {
    const Tensor edges = TensorOfEdges(PointAt(x, a[k]), PointAt(x, b[k]), PointAt(x, c[k]));
    const Tensor f = TensorProduct(edges, (Tensor){ixx[k], ixy[k], iyx[k], iyy[k]});
    const double j = TensorDeterminant(f);
    const ElementLaw law = {mu[k], lambda[k], eta[k], laws != STRAIN_ONLY && plane_stress[k] > 0.0,
                            laws == WITH_COROTATED && kind[k] == LAW_COROTATED};
    ElementStress t = ElementElasticStress(f, j, law);
    if (jointed) {
      sxx[k] = t.xx;
      syy[k] = t.yy;
      sxy[k] = t.xy;
    }
    if (damped) {
      const Tensor rate = TensorOfEdges(PointAt(v, a[k]), PointAt(v, b[k]), PointAt(v, c[k]));
      const ElementStress d = ElementViscousStress(edges, rate, eta[k]);
      t = (ElementStress){t.xx + d.xx, t.yy + d.yy, t.xy + d.xy};
    }
    const ElementForces g = ElementForcesOf(edges, t);
    fx[k] = g.a.x;
    fy[k] = g.a.y;
    fx[n + k] = g.b.x;
    fy[n + k] = g.b.y;
    fx[2 * n + k] = g.c.x;
    fy[2 * n + k] = g.c.y;
    bad += !ElementAdmissible(f, j, law);
  }
  return bad;
}

static void SumCorners(const Solid s)
{
  const int *restrict start = s->corner_start, *restrict corner = s->corner;
  const double *restrict fx = s->elements.force[0], *restrict fy = s->elements.force[1];
  double *restrict force = s->force;
  for (int n = 0; n < s->nnodes; n++) {
    double x = 0.0, y = 0.0;
    for (int k = start[n]; k < start[n + 1]; k++) {
      x += fx[corner[k]];
      y += fy[corner[k]];
    }
    force[2 * n] = x;
    force[2 * n + 1] = y;
  }
}

/* Names the first element that is inside out, and ends the job. */
static PetscErrorCode FailOnElement(const Solid s)
{
  const Elements *e = &s->elements;
  char message[320];
  PetscFunctionBeginUser;
  for (int k = 0; k < e->n; k++) {
    Tensor edges, f;
    SolidElementShape(e, k, s->x, &edges, &f);
    const double j = TensorDeterminant(f);
    if (ElementAdmissible(f, j, ElementsLaw(e, k))) continue;
    const Point p = PointAt(s->x, e->node[0][k]);
    (void)snprintf(
        message, sizeof message,
        "body %d: element %d at (%g, %g) %s at t = %.9g s (area %.3g of its rest area): the load is too "
        "large for its stiffness, or solid.courant too large",
        e->body[k], e->number[k] - s->body[e->body[k]].first_element, p.x, p.y,
        j > 0.0  ? "has no thickness left"
        : j == j ? "has turned inside out"
                 : "is not a number any more",
        s->stats.t, j);
    break;
  }
  if (s->setup.fail) s->setup.fail(s->setup.context, message);
  (void)fprintf(stderr, "%s\n", message);
  PetscCallMPI(MPI_Abort(s->comm, 1));
  PetscFunctionReturn(PETSC_ERR_FP);
}

PetscErrorCode SolidInternalForces(Solid s)
{
  PetscFunctionBeginUser;
  const Elements *e = &s->elements;
  const double *x = s->x, *v = s->v;
  const int jointed = e->stress[0] != NULL;
  const int bad = e->laws == WITH_COROTATED      ? (jointed ? CornerForces(e, x, v, WITH_COROTATED, 1, 1)
                                                            : CornerForces(e, x, v, WITH_COROTATED, 1, 0))
                  : e->laws == WITH_PLANE_STRESS ? (jointed ? CornerForces(e, x, v, WITH_PLANE_STRESS, 1, 1)
                                                            : CornerForces(e, x, v, WITH_PLANE_STRESS, 1, 0))
                  : jointed                      ? CornerForces(e, x, v, STRAIN_ONLY, 1, 1)
                  : e->damped                    ? CornerForces(e, x, v, STRAIN_ONLY, 1, 0)
                                                 : CornerForces(e, x, v, STRAIN_ONLY, 0, 0);
  if (bad) PetscCall(FailOnElement(s));
  SumCorners(s);
  PetscFunctionReturn(0);
}

ElementRates SolidElementRates(Solid s, int k)
{
  const Elements *e = &s->elements;
  Tensor edges, f;
  SolidElementShape(e, k, s->x, &edges, &f);
  return ElementRatesOf(edges, f, e->density[k], ElementsLaw(e, k));
}

double SolidElementLimit(Solid s, ElementRates contact)
{
  double limit = HUGE_VAL;
  for (int k = 0; k < s->elements.n; k++) {
    ElementRates rates = SolidElementRates(s, k);
    rates.stiffness += contact.stiffness;
    rates.damping += contact.damping;
    limit = fmin(limit, ElementStableStep(rates));
  }
  return limit;
}

ElementLaw ElementsLaw(const Elements *e, int k)
{
  return (ElementLaw){e->mu[k], e->lambda[k], e->eta[k], e->plane_stress[k] > 0.0, (int)e->kind[k]};
}

void SolidStress(Solid s, double stress[])
{
  const Elements *e = &s->elements;
  for (int k = 0; k < e->n; k++) {
    const ElementLaw law = ElementsLaw(e, k);
    Tensor edges, f;
    SolidElementShape(e, k, s->x, &edges, &f);
    const double j = TensorDeterminant(f);
    const ElementStress t = ElementElasticStress(f, j, law);
    const ElementStress d = ElementViscousStress(edges, EdgesOf(e, k, s->v), law.eta);
    const double scale = 1.0 / (e->thickness[k] * ElementThicknessStretch(f, j, law));
    stress[3 * k] = scale * (t.xx + d.xx);
    stress[3 * k + 1] = scale * (t.yy + d.yy);
    stress[3 * k + 2] = scale * (t.xy + d.xy);
  }
}

void SolidEnergyDensity(Solid s, double density[])
{
  const Elements *e = &s->elements;
  for (int k = 0; k < e->n; k++) {
    Tensor edges, f;
    SolidElementShape(e, k, s->x, &edges, &f);
    density[k] = ElementEnergy(f, ElementsLaw(e, k)) / e->thickness[k];
  }
}
