#include "coupler/force/force.h"
#include "common/link/coupling_gain.h"

/* The flow on one coupled element. */
typedef struct {
  LinearField star, start, projected;
  double remainder[2]; /* of CoracleFlow, over the solid's area, N/m2 */
} ElementFlow;

/* The element's flow seen from the centre of one of its pairs. */
static ElementFlow FlowAt(const Overlap o, const SupermeshPair *pair, const ElementFlow *flow)
{
  double d[2];
  SupermeshCentreInB(pair, &o->source_basis[pair->a], &o->basis[pair->b], d);
  return (ElementFlow){LinearFieldAt(&flow->star, d),
                       LinearFieldAt(&flow->start, d),
                       LinearFieldAt(&flow->projected, d),
                       {flow->remainder[0], flow->remainder[1]}};
}

/* R's density, at the pair's centre; inside solids a or the inertia is mostly 0. */
static LinearField Reaction(const PairTerm *term, const ElementTerm *element, const SourceTerm *source,
                            const double gravity[2], const ElementFlow *flow, const double d[2])
{
  LinearField reaction = {{0.0}, {{0.0}}};
  if (!WallIsZero(&term->a)) {
    const LinearField us = LinearFieldAt(&source->velocity, d);
    LinearField slip = flow->star;
    LinearFieldAdd(-1.0, &us, &slip);
    WallAdd(&term->a, &slip, &reaction);
  }
  if (source->density == 0.0) return reaction;
  const LinearField body = PairBodyForce(term, element, source, gravity, d);
  LinearFieldAdd(-1.0, &body, &reaction);
  LinearField change = flow->projected;
  LinearFieldAdd(-1.0, &flow->start, &change);
  LinearFieldAdd(term->inertia, &change, &reaction);
  if (!WallIsZero(&element->freed)) {
    const WallCoefficient freed = WallCoefficientScaled(&element->freed, -term->inertia);
    WallAdd(&freed, &change, &reaction);
  }
  if (!WallIsZero(&term->start)) {
    const LinearField begins = LinearFieldAt(InertiaBegins(source), d);
    LinearField difference = flow->start;
    LinearFieldAdd(-1.0, &begins, &difference);
    WallAdd(&term->start, &difference, &reaction);
  }
  return reaction;
}

/* The mean of the reaction over the pairs of an element that two solids share (slip.h). */
static void MeanReaction(const Overlap o, const PairTerm term[], const ElementTerm *element,
                         const SourceTerm source[], const double gravity[2], const ElementFlow *flow, int e,
                         LinearField *mean)
{
  VectorMoments sum = {{0.0}, {{0.0}}};
  const double area = o->solid_area[e];
  for (int i = o->first_of_element[e]; i < o->first_of_element[e + 1]; i++) {
    const int p = o->of_element[i];
    const SupermeshPair *pair = &o->pairs.pair[p];
    if (o->source[pair->a].is_shell) continue;
    const ElementFlow at = FlowAt(o, pair, flow);
    const LinearField density = Reaction(&term[p], element, &source[pair->a], gravity, &at, pair->centre);
    VectorMomentsAdd(pair, &density, pair->centre, &sum);
  }
  *mean = (LinearField){{sum.zero[0] / area, sum.zero[1] / area}, {{0.0}}};
}

/* density, of one pair: along the surface it becomes the mean. */
static void ShareAlong(const ElementTerm *element, const LinearField *mean, LinearField *density)
{
  LinearField difference = *mean;
  LinearFieldAdd(-1.0, density, &difference);
  WallAdd(&element->along, &difference, density);
}

/* The density of F_i + F_b + F_r. */
static LinearField Other(double rho, double dt, const double gravity[2], const ElementFlow *flow,
                         const LinearField *start)
{
  LinearField other = {{flow->remainder[0] - rho * gravity[0], flow->remainder[1] - rho * gravity[1]},
                       {{0.0}}};
  LinearFieldAdd(rho / dt, &flow->projected, &other);
  LinearFieldAdd(-rho / dt, start, &other);
  return other;
}

static void SetVertices(const SupermeshBasis *basis, const VectorMoments *reaction,
                        const VectorMoments *other, ForceVertex vertex[3])
{
  double r[3][2], o[3][2];
  VectorMomentsVertices(basis, reaction, r);
  VectorMomentsVertices(basis, other, o);
  for (int i = 0; i < 3; i++)
    for (int c = 0; c < 2; c++) {
      vertex[i].reaction[c] = r[i][c];
      vertex[i].other[c] = o[i][c];
    }
}

PetscErrorCode ForceOfPairs(const Overlap o, const PairTerm term[], const ElementTerm element[],
                            const SourceTerm source[], const double gravity[2], double dt,
                            const CoracleFlow *flow, ForceVertex vertex[])
{
  ElementFlow *on;
  LinearField *mean; /* of shared elements */

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(o->ncoupled, &on, o->ncoupled, &mean));
  for (int e = 0; e < o->ncoupled; e++) {
    const int k = o->coupled_element[e];
    on[e] = (ElementFlow){LinearFieldOnElement(&o->basis[k], &flow->u_star[6 * k]),
                          LinearFieldOnElement(&o->basis[k], &flow->u_start[6 * k]),
                          LinearFieldOnElement(&o->basis[k], &flow->u_projected[6 * k]),
                          {0.0, 0.0}};
    for (int c = 0; c < 2 && flow->remainder && o->solid_area[e] > 0.0; c++)
      on[e].remainder[c] = flow->remainder[2 * k + c] / o->solid_area[e];
    if (element[e].shared) MeanReaction(o, term, &element[e], source, gravity, &on[e], e, &mean[e]);
  }
  for (int t = 0, p = 0; t < o->nsources; t++) {
    VectorMoments reaction = {{0.0}, {{0.0}}}, other = {{0.0}, {{0.0}}};
    for (; p < o->pairs.n && o->pairs.pair[p].a == t; p++) {
      const SupermeshPair *pair = &o->pairs.pair[p];
      const int e = o->coupled_index[p];
      const double *d = pair->centre;
      const ElementFlow at = FlowAt(o, pair, &on[e]);
      const LinearField start = LinearFieldAt(&source[t].start, d);
      LinearField density = Reaction(&term[p], &element[e], &source[t], gravity, &at, d);
      if (element[e].shared && !o->source[t].is_shell) ShareAlong(&element[e], &mean[e], &density);
      VectorMomentsAdd(pair, &density, d, &reaction);
      if (o->source[t].is_shell) continue;
      const LinearField rest = Other(o->rho[pair->b], dt, gravity, &at, &start);
      VectorMomentsAdd(pair, &rest, d, &other);
    }
    SetVertices(&o->source_basis[t], &reaction, &other, &vertex[3 * t]);
  }
  PetscCall(PetscFree2(on, mean));
  PetscFunctionReturn(0);
}

static double DisplacedMass(const Overlap o)
{
  double mass = 0.0;
  for (int p = 0; p < o->pairs.n; p++) {
    const SupermeshPair *pair = &o->pairs.pair[p];
    if (!o->source[pair->a].is_shell) mass += o->rho[pair->b] * pair->area;
  }
  return mass;
}

/* area += that of the fluid near the solid, square += int |u|^2 over it with the vertices as points. */
static void AddSquare(const Overlap o, const double u[], double *area, double *square)
{
  for (int k = 0; k < o->nelements; k++) {
    *area += o->area[k];
    for (int i = 6 * k; i < 6 * k + 6; i++) *square += o->area[k] / 3.0 * u[i] * u[i];
  }
}

PetscErrorCode ForceSum(const Overlap o, double dt, const CoracleCoupling coupling[], const CoracleFlow *flow,
                        int nnodes, const ForceVertex node[], ForceTotals *totals)
{
  enum { GAIN, REACTION = 2, FORCE = 4, SCALE = 6, MASS, PAIRS, AREA, SQUARE, COUNT };
  double sum[COUNT] = {0};

  PetscFunctionBeginUser;
  for (int e = 0; e < o->ncoupled; e++) {
    const int k = coupling[e].element;
    const size_t first = 6 * (size_t)k;
    double gain[2] = {0.0, 0.0};
    CouplingAddGain(&coupling[e], o->rho[k] * o->area[k] / dt, flow->u_start + first, flow->u_star + first,
                    flow->u_projected + first, gain);
    for (int c = 0; c < 2; c++) sum[GAIN + c] += gain[c];
    sum[SCALE] += sqrt(gain[0] * gain[0] + gain[1] * gain[1]);
  }
  for (int i = 0; i < nnodes; i++) {
    for (int c = 0; c < 2; c++) {
      sum[REACTION + c] += node[i].reaction[c];
      sum[FORCE + c] += node[i].reaction[c] + node[i].other[c];
    }
  }
  AddSquare(o, flow->u_star, &sum[AREA], &sum[SQUARE]);
  sum[MASS] = DisplacedMass(o);
  sum[PAIRS] = o->pairs.n;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sum, COUNT, MPI_DOUBLE, MPI_SUM, o->comm));
  for (int c = 0; c < 2; c++) {
    totals->reaction[c] = sum[REACTION + c];
    totals->force[c] = sum[FORCE + c];
  }
  const double lost = hypot(sum[GAIN] + sum[REACTION], sum[GAIN + 1] + sum[REACTION + 1]);
  totals->imbalance = sum[SCALE] > 0.0 ? lost / sum[SCALE] : lost;
  totals->displaced = sum[MASS];
  totals->speed = sum[AREA] > 0.0 ? sqrt(sum[SQUARE] / sum[AREA]) : 0.0;
  totals->npairs = (long long)sum[PAIRS];
  PetscFunctionReturn(0);
}

void ForceCorrection(const Overlap o, const LinearField u[], const double u_projected[],
                     CoracleCorrection correction[])
{
  for (int e = 0; e < o->ncoupled; e++) {
    const SupermeshBasis *basis = &o->basis[o->coupled_element[e]];
    const LinearField flow = LinearFieldOnElement(basis, &u_projected[6 * o->coupled_element[e]]);
    VectorMoments sums = {{0.0}, {{0.0}}};
    double r[3][2];
    for (int i = o->first_of_element[e]; i < o->first_of_element[e + 1]; i++) {
      const SupermeshPair *pair = &o->pairs.pair[o->of_element[i]];
      double d[2];
      if (o->source[pair->a].is_shell) continue;
      SupermeshCentreInB(pair, &o->source_basis[pair->a], basis, d);
      const LinearField at = LinearFieldAt(&flow, d);
      LinearField difference = LinearFieldAt(&u[pair->a], pair->centre);
      LinearFieldAdd(-1.0, &at, &difference);
      VectorMomentsAdd(pair, &difference, d, &sums);
    }
    VectorMomentsVertices(basis, &sums, r);
    for (int i = 0; i < 6; i++) correction[e].r[i / 3][i % 3] += r[i % 3][i / 3];
  }
}
