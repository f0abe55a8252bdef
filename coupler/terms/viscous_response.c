#include "coupler/terms/viscous_response.h"

/* Nodes with a larger explicit fraction of the inertia need several coupling iterations over any step. */
#define LIGHT 0.01

/* friction[nnodes], N s/m: int N f of the shell's pairs, of all ranks. */
static PetscErrorCode Friction(Overlap o, const PairTerm term[], double thickness, double dt, int nnodes,
                               double friction[])
{
  double(*vertex)[3];

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(o->nsources, &vertex));
  for (int p = 0; p < o->pairs.n; p++) {
    const SupermeshPair *pair = &o->pairs.pair[p];
    if (!o->source[pair->a].is_shell) continue;
    const double a = 0.5 * (term[p].a.xx + term[p].a.yy), mu = o->mu[pair->b];
    const double layer = o->phases ? 0.0 : sqrt(mu * dt / o->rho_mean[pair->b]);
    const double f = mu > 0.0 ? a / (1.0 + a * thickness * layer / mu) : 0.0;
    for (int i = 0; i < 3; i++) vertex[pair->a][i] += pair->area * f / 3.0;
  }
  PetscCall(OverlapSourcesToNodes(o, 1, (const double *)vertex, nnodes, friction));
  PetscCall(CopiesSum(o->nodes, 1, friction));
  PetscCall(PetscFree(vertex));
  PetscFunctionReturn(0);
}

/* chi[nnodes]: of a node's part.  turn: int f r^2, int r^2 dm about the part's centre. */
static PetscErrorCode Response(Overlap o, const SolidState *solid, const double friction[], double dt,
                               double chi[])
{
  enum { FRICTION, MASS, CENTRE, NSUMS = CENTRE + 2 };
  double(*sum)[NSUMS], (*turn)[2];

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc2(solid->nnodes, &sum, solid->nnodes, &turn));
  for (int i = 0; i < solid->nnodes; i++) {
    if (!(solid->mobility[i] > 0.0 && CopiesIsFirst(o->nodes, i))) continue;
    const double mass = 1.0 / solid->mobility[i];
    sum[i][FRICTION] = friction[i];
    sum[i][MASS] = mass;
    for (int c = 0; c < 2; c++) sum[i][CENTRE + c] = mass * solid->x[2 * i + c];
  }
  PetscCall(CopiesSum(o->parts, NSUMS, (double *)sum));
  for (int i = 0; i < solid->nnodes; i++) {
    if (!(solid->mobility[i] > 0.0 && CopiesIsFirst(o->nodes, i))) continue;
    const double r[2] = {solid->x[2 * i] - sum[i][CENTRE] / sum[i][MASS],
                         solid->x[2 * i + 1] - sum[i][CENTRE + 1] / sum[i][MASS]};
    turn[i][0] = friction[i] * (r[0] * r[0] + r[1] * r[1]);
    turn[i][1] = (r[0] * r[0] + r[1] * r[1]) / solid->mobility[i];
  }
  PetscCall(CopiesSum(o->parts, 2, (double *)turn));
  for (int i = 0; i < solid->nnodes; i++) {
    chi[i] = sum[i][MASS] > 0.0 ? dt * sum[i][FRICTION] / sum[i][MASS] : 0.0;
    if (turn[i][1] > 0.0) chi[i] = fmax(chi[i], dt * turn[i][0] / turn[i][1]);
  }
  PetscCall(PetscFree2(sum, turn));
  PetscFunctionReturn(0);
}

PetscErrorCode ViscousExplicitFraction(Overlap o, const SolidState *solid, const PairTerm term[],
                                       double thickness, double dt, double explicit_fraction[],
                                       double *single)
{
  double *friction, *chi;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(solid->nnodes, &friction, solid->nnodes, &chi));
  PetscCall(Friction(o, term, thickness, dt, solid->nnodes, friction));
  PetscCall(Response(o, solid, friction, dt, chi));
  *single = HUGE_VAL;
  for (int i = 0; i < solid->nnodes; i++) {
    if (solid->mobility[i] == 0.0) continue;
    *single = explicit_fraction[i] > LIGHT
                  ? 0.0
                  : fmin(*single, chi[i] > 0.0 ? dt * VISCOUS_LIMIT / chi[i] : HUGE_VAL);
    if (chi[i] > VISCOUS_LIMIT)
      explicit_fraction[i] = fmax(explicit_fraction[i], 1.0 - VISCOUS_LIMIT / chi[i]);
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, single, 1, MPI_DOUBLE, MPI_MIN, o->comm));
  PetscCall(PetscFree2(friction, chi));
  PetscFunctionReturn(0);
}
