/* The loops over this rank's elements. */
#include "common/supermesh/vectorize.h"
#include "solid/six_node_kernel.h"
#include "solid/solid_impl.h"
#include <stdio.h>

static inline Tensor RestInverse(const Elements *e, int k)
{
  return (Tensor){e->inverse[0][k], e->inverse[1][k], e->inverse[2][k], e->inverse[3][k]};
}

/* x, y of the corners of elements first .. first + n - 1: of nodes, or carried along in a six-node triangle */
static inline __attribute__((always_inline)) void
GatherCorners(const Elements *e, int first, int n, int bends, const double value[], double corner[6][STRIP])
{
  for (int i = 0; i < 3; i++) {
    const int *node = e->node[i] + first;
    for (int k = 0; k < n; k++) {
      corner[2 * i][k] = value[2 * node[k]];
      corner[2 * i + 1][k] = value[2 * node[k] + 1];
    }
  }
  for (int k = 0; bends && k < n; k++) {
    const double w = SixNodeIsCorner(e->six_node[first + k]) ? 1.0 : 0.0,
                 *next = value + 2 * e->far[0][first + k], *last = value + 2 * e->far[1][first + k],
                 *between = value + 2 * e->far[2][first + k];
    for (int c = 0; c < 2; c++)
      SixNodeCarry(w, next[c], last[c], between[c], &corner[c][k], &corner[2 + c][k], &corner[4 + c][k]);
  }
}

static inline __attribute__((always_inline)) Tensor StripEdges(const double corner[6][STRIP], int k)
{
  return TensorOfEdges((Point){corner[0][k], corner[1][k]}, (Point){corner[2][k], corner[3][k]},
                       (Point){corner[4][k], corner[5][k]});
}

Tensor SolidElementEdges(const Elements *e, int k, const double value[])
{
  double corner[6][STRIP];
  GatherCorners(e, k, 1, 1, value, corner);
  return StripEdges((const double(*)[STRIP])corner, 0);
}

void SolidElementShape(const Elements *e, int k, const double x[], Tensor *edges, Tensor *f)
{
  *edges = SolidElementEdges(e, k, x);
  *f = TensorProduct(*edges, RestInverse(e, k));
}

/* Forces of all corners; returns the number of elements that are inside out (or not a number).  The arrays do
 * not overlap (ivdep), so that the loop is vectorised without asking at run time; laws (which there may be),
 * damped and jointed are constants of the caller, so that what is not needed falls away. */
static inline __attribute__((always_inline)) int StripForces(const Elements *e, int first, int n,
                                                             const double x[], const double v[],
                                                             ElementLaws laws, int damped, int jointed)
{
  const double *ixx = e->inverse[0] + first, *ixy = e->inverse[1] + first, *iyx = e->inverse[2] + first,
               *iyy = e->inverse[3] + first;
  const double *mu = e->mu + first, *lambda = e->lambda + first, *eta = e->eta + first;
  const double *plane_stress = e->plane_stress + first, *kind = e->kind + first;
  double *fx = e->force[0] + first, *fy = e->force[1] + first, at[6][STRIP], rates[6][STRIP], fit[STRIP];
  double *sxx = e->stress[0], *syy = e->stress[1], *sxy = e->stress[2];
  const int bends = e->bends[first / STRIP];
  int bad = 0;
  GatherCorners(e, first, n, bends, x, at);
  if (damped) GatherCorners(e, first, n, bends, v, rates);
  VECTORIZE
  for (int k = 0; k < n; k++) {
    const Tensor edges = StripEdges((const double(*)[STRIP])at, k);
    const Tensor f = TensorProduct(edges, (Tensor){ixx[k], ixy[k], iyx[k], iyy[k]});
    const double j = TensorDeterminant(f);
    const ElementLaw law = {mu[k], lambda[k], eta[k], laws != STRAIN_ONLY && plane_stress[k] > 0.0,
                            laws == ALL_LAWS ? (int)kind[k] : LAW_NEO_HOOKEAN};
    ElementStress t = ElementElasticStress(f, j, law);
    if (jointed) {
      sxx[first + k] = t.xx;
      syy[first + k] = t.yy;
      sxy[first + k] = t.xy;
    }
    if (damped) {
      const ElementStress d =
          ElementViscousStress(edges, StripEdges((const double(*)[STRIP])rates, k), eta[k]);
      t = (ElementStress){t.xx + d.xx, t.yy + d.yy, t.xy + d.xy};
    }
    const ElementForces g = ElementForcesOf(edges, t);
    fx[k] = g.a.x;
    fy[k] = g.a.y;
    fx[e->n + k] = g.b.x;
    fy[e->n + k] = g.b.y;
    fx[2 * e->n + k] = g.c.x;
    fy[2 * e->n + k] = g.c.y;
    fit[k] = ElementAdmissible(f, j, law) ? 1.0 : 0.0;
  }
  for (int k = 0; k < n; k++) bad += fit[k] == 0.0;
  return bad;
}

static inline __attribute__((always_inline)) int
CornerForces(const Elements *e, const double x[], const double v[], ElementLaws laws, int damped, int jointed)
{
  int bad = 0;
  for (int first = 0; first < e->n; first += STRIP)
    if (!e->held_known || !e->held[first / STRIP])
      bad += StripForces(e, first, e->n - first < STRIP ? e->n - first : STRIP, x, v, laws, damped, jointed);
  return bad;
}

static WIDE int AllForces(const Elements *e, const double x[], const double v[])
{
  const int jointed = e->stress[0] != NULL;
  if (e->laws == ALL_LAWS)
    return jointed ? CornerForces(e, x, v, ALL_LAWS, 1, 1) : CornerForces(e, x, v, ALL_LAWS, 1, 0);
  if (e->laws == WITH_PLANE_STRESS)
    return jointed ? CornerForces(e, x, v, WITH_PLANE_STRESS, 1, 1)
                   : CornerForces(e, x, v, WITH_PLANE_STRESS, 1, 0);
  if (jointed) return CornerForces(e, x, v, STRAIN_ONLY, 1, 1);
  return e->damped ? CornerForces(e, x, v, STRAIN_ONLY, 1, 0) : CornerForces(e, x, v, STRAIN_ONLY, 0, 0);
}

/* What acts on the corners that six-node triangles carry along acts on their nodes. */
static void ReturnForces(const Elements *e)
{
  for (int k = 0; k < e->nsix; k++) {
    const int first = e->six_first[k];
    if (e->held_known && e->held[first / STRIP] && e->held[(first + 2) / STRIP]) continue;
    for (int c = 0; c < 2; c++) {
      double on[3][3];
      for (int q = 0; q < 3; q++)
        for (int v = 0; v < 3; v++) on[q][v] = e->force[c][v * e->n + first + q];
      SixNodeReturn((const double(*)[3])on, e->force[c] + 3 * e->n + 6 * k);
    }
  }
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

/* The step cannot be made: names the first element that is inside out. */
static void NoteFailure(Solid s)
{
  const Elements *e = &s->elements;
  /* of an area of 0 but for round-off none is found again */
  (void)snprintf(s->failure, sizeof s->failure, "an element has turned inside out at t = %.9g s", s->stats.t);
  for (int k = 0; k < e->n; k++) {
    Tensor edges, f;
    SolidElementShape(e, k, s->x, &edges, &f);
    const double j = TensorDeterminant(f);
    if (ElementAdmissible(f, j, ElementsLaw(e, k))) continue;
    const Point p = PointAt(s->x, e->node[0][k]);
    (void)snprintf(
        s->failure, sizeof s->failure,
        "body %d: element %d at (%g, %g) %s at t = %.9g s (area %.3g of its rest area): the load is too "
        "large for its stiffness, or solid.courant too large",
        e->body[k], e->number[k] - s->body[e->body[k]].first_element, p.x, p.y,
        j > 0.0  ? "has no thickness left"
        : j == j ? "has turned inside out"
                 : "is not a number any more",
        s->stats.t, j);
    return;
  }
}

/* What the rank goes on with until all have heard of it: the step's start, at rest, without forces. */
static PetscErrorCode Stand(Solid s)
{
  const size_t n = 2 * (size_t)s->nnodes;
  PetscFunctionBeginUser;
  PetscCall(PetscArraycpy(s->x, s->start, n));
  PetscCall(PetscArrayzero(s->v, n));
  PetscCall(PetscArrayzero(s->force, n));
  for (int c = 0; c < 3 && s->elements.stress[0]; c++)
    PetscCall(PetscArrayzero(s->elements.stress[c], (size_t)s->elements.n));
  PetscFunctionReturn(0);
}

PetscErrorCode SolidInternalForces(Solid s)
{
  PetscFunctionBeginUser;
  if (!s->failure[0] && AllForces(&s->elements, s->x, s->v)) NoteFailure(s);
  if (s->failure[0]) {
    PetscCall(Stand(s));
    PetscFunctionReturn(0);
  }
  ReturnForces(&s->elements);
  s->elements.held_known = PETSC_TRUE;
  SumCorners(s);
  PetscFunctionReturn(0);
}

/* The stable substep of each of elements first .. first + n - 1. */
static inline __attribute__((always_inline)) void StripLimits(const Elements *e, int first, int n,
                                                              const double x[], ElementRates contact,
                                                              ElementLaws laws, double limit[STRIP])
{
  double at[6][STRIP];
  GatherCorners(e, first, n, e->bends[first / STRIP], x, at);
  for (int i = 0; i < n; i++) {
    const int k = first + i;
    const double factor = SixNodeIsCorner(e->six_node[k]) ? SIX_NODE_RATE : 1.0;
    const Tensor edges = StripEdges((const double(*)[STRIP])at, i);
    const Tensor f = TensorProduct(edges, RestInverse(e, k));
    const ElementLaw law = {e->mu[k], e->lambda[k], e->eta[k],
                            laws != STRAIN_ONLY && e->plane_stress[k] > 0.0,
                            laws == ALL_LAWS ? (int)e->kind[k] : LAW_NEO_HOOKEAN};
    const ElementRates rates = ElementRatesOf(edges, f, e->density[k], law);
    limit[i] = ElementStableStep((ElementRates){factor * rates.stiffness + contact.stiffness,
                                                factor * rates.damping + contact.damping});
  }
}

/* Over the elements that can move. */
static WIDE double Limit(const Elements *e, const double x[], const double inverse_mass[],
                         ElementRates contact)
{
  double limit = HUGE_VAL, strip[STRIP];
  for (int first = 0; first < e->n; first += STRIP) {
    const int n = e->n - first < STRIP ? e->n - first : STRIP;
    if (e->held[first / STRIP]) continue;
    if (e->laws == STRAIN_ONLY)
      StripLimits(e, first, n, x, contact, STRAIN_ONLY, strip);
    else
      StripLimits(e, first, n, x, contact, ALL_LAWS, strip);
    for (int k = 0; k < n; k++)
      if (strip[k] < limit && !SolidElementHeld(e, first + k, inverse_mass)) limit = strip[k];
  }
  return limit;
}

double SolidElementLimit(Solid s, ElementRates contact)
{
  const double rigid = s->nrigid > 0 ? ElementStableStep(contact) : HUGE_VAL;
  return fmin(rigid, Limit(&s->elements, s->x, s->inverse_mass, contact));
}

ElementLaw ElementsLaw(const Elements *e, int k)
{
  return (ElementLaw){e->mu[k], e->lambda[k], e->eta[k], e->plane_stress[k] > 0.0, (int)e->kind[k]};
}

/* value[n][components] of the middle of a six-node triangle, k, from its corners: what is linear. */
static void MeanOfCorners(int k, int components, double value[])
{
  double *mean = value + components * k;
  for (int c = 0; c < components; c++)
    mean[c] = (mean[c - components] + mean[c - 2 * components] + mean[c - 3 * components]) / 3.0;
}

void SolidStress(Solid s, double stress[])
{
  const Elements *e = &s->elements;
  for (int k = 0; k < e->n; k++) {
    if (e->six_node[k] == SIX_NODE_MIDDLE) {
      MeanOfCorners(k, 3, stress);
      continue;
    }
    const ElementLaw law = ElementsLaw(e, k);
    Tensor edges, f;
    SolidElementShape(e, k, s->x, &edges, &f);
    const double j = TensorDeterminant(f);
    const ElementStress t = ElementElasticStress(f, j, law);
    const ElementStress d = ElementViscousStress(edges, SolidElementEdges(e, k, s->v), law.eta);
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
    if (e->six_node[k] == SIX_NODE_MIDDLE) {
      MeanOfCorners(k, 1, density);
      continue;
    }
    SolidElementShape(e, k, s->x, &edges, &f);
    density[k] = ElementEnergy(f, ElementsLaw(e, k)) / e->thickness[k];
  }
}
