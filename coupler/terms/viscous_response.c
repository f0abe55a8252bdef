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

PetscErrorCode ViscousExplicitFraction(Overlap o, const SolidState *solid, const PairTerm term[],
                                       double thickness, double dt, double explicit_fraction[],
                                       double *single)
{
  enum { FRICTION, MASS, NSUMS };
  double *friction, (*sum)[NSUMS];

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(solid->nnodes, &friction, solid->nnodes, &sum));
  PetscCall(Friction(o, term, thickness, dt, solid->nnodes, friction));
  for (int i = 0; i < solid->nnodes; i++) {
    const PetscBool counts = (PetscBool)(solid->mobility[i] > 0.0 && CopiesIsFirst(o->nodes, i));
    sum[i][FRICTION] = counts ? friction[i] : 0.0;
    sum[i][MASS] = counts ? 1.0 / solid->mobility[i] : 0.0;
  }
  PetscCall(CopiesSum(o->parts, NSUMS, (double *)sum));
  *single = HUGE_VAL;
  for (int i = 0; i < solid->nnodes; i++) {
    const double chi = sum[i][MASS] > 0.0 ? 2.0 * dt * sum[i][FRICTION] / sum[i][MASS] : 0.0;
    if (solid->mobility[i] == 0.0) continue;
    *single =
        explicit_fraction[i] > LIGHT ? 0.0 : fmin(*single, chi > 0.0 ? dt * VISCOUS_LIMIT / chi : HUGE_VAL);
    if (chi > VISCOUS_LIMIT) explicit_fraction[i] = fmax(explicit_fraction[i], 1.0 - VISCOUS_LIMIT / chi);
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, single, 1, MPI_DOUBLE, MPI_MIN, o->comm));
  PetscCall(PetscFree2(friction, sum));
  PetscFunctionReturn(0);
}
