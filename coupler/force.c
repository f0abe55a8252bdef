#include "coupler/force.h"

/* q[i] = int over the pair of N_T,i (u - u_s): u [2][3] on the fluid element, u_s [3][2] on the piece. */
static void Slip(const SupermeshPair *pair, const double u[6], const double us[3][2], double q[3][2])
{
  for (int i = 0; i < 3; i++) {
    const double *ab = pair->ab[i], *aa = pair->aa[i];
    for (int c = 0; c < 2; c++) {
      q[i][c] = ab[0] * u[3 * c] + ab[1] * u[3 * c + 1] + ab[2] * u[3 * c + 2] -
                (aa[0] * us[0][c] + aa[1] * us[1][c] + aa[2] * us[2][c]);
    }
  }
}

/* The velocity that the reaction is to, on the pair's element. */
static void ReactionVelocity(double implicit_factor, const double u_star[6], const double u_plus[6],
                             double u[6])
{
  for (int i = 0; i < 6; i++)
    u[i] = implicit_factor == 1.0 ? u_star[i]
                                  : implicit_factor * u_star[i] + (1.0 - implicit_factor) * u_plus[i];
}

void ForceReaction(const Overlap o, const WallCoefficient coefficient[], const double implicit_factor[],
                   const FluidFlow *flow, ForceVertex vertex[])
{
  for (int p = 0; p < o->pairs.n; p++) {
    const SupermeshPair *pair = &o->pairs.pair[p];
    ForceVertex *v = &vertex[3 * pair->a];
    double u[6], q[3][2], r[2];
    ReactionVelocity(implicit_factor[pair->a], &flow->u_star[6 * pair->b], &flow->u_plus[6 * pair->b], u);
    Slip(pair, u, o->source[pair->a].u, q);
    for (int i = 0; i < 3; i++) {
      WallApply(&coefficient[p], q[i], r);
      v[i].reaction[0] += r[0];
      v[i].reaction[1] += r[1];
    }
  }
}

void ForceInertia(const Overlap o, double dt, const double gravity[2], const double u_plus[],
                  const double start_velocity[][3][2], ForceVertex vertex[])
{
  for (int p = 0; p < o->pairs.n; p++) {
    const SupermeshPair *pair = &o->pairs.pair[p];
    if (o->source[pair->a].is_shell) continue;
    const double rho = o->rho[pair->b];
    ForceVertex *v = &vertex[3 * pair->a];
    double q[3][2];
    Slip(pair, &u_plus[6 * pair->b], start_velocity[pair->a], q);
    for (int i = 0; i < 3; i++) {
      const double mass = rho * (pair->aa[i][0] + pair->aa[i][1] + pair->aa[i][2]);
      for (int c = 0; c < 2; c++) v[i].other[c] += rho / dt * q[i][c] - mass * gravity[c];
    }
  }
}

PetscErrorCode ForceAssembleToOwners(Overlap o, const ForceVertex vertex[], int nnodes, ForceVertex node[])
{
  PetscFunctionBeginUser;
  PetscCall(OverlapSourcesToNodes(o, 4, (const double *)vertex, nnodes, (double *)node));
  PetscFunctionReturn(0);
}

/* One element's gain: sum over its functions of s - a u* - give (u+ - u*). */
static void ElementGain(const CoracleCoupling *k, const double u_star[6], const double u_plus[6],
                        double gain[2])
{
  for (int c = 0; c < 2; c++) {
    gain[c] = 0.0;
    for (int i = 0; i < 3; i++) {
      gain[c] += k->s[c][i];
      for (int j = 0; j < 6; j++) {
        gain[c] -= k->a[c][i][j / 3][j % 3] * u_star[j];
        gain[c] -= k->give[c][i][j / 3][j % 3] * (u_plus[j] - u_star[j]);
      }
    }
  }
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

PetscErrorCode ForceSum(const Overlap o, const CoracleCoupling coupling[], const FluidFlow *flow, int nnodes,
                        const ForceVertex node[], ForceTotals *totals)
{
  enum { GAIN, REACTION = 2, FORCE = 4, SCALE = 6, MASS, PAIRS, COUNT };
  double sum[COUNT] = {0};

  PetscFunctionBeginUser;
  for (int e = 0; e < o->ncoupled; e++) {
    const int k = 6 * coupling[e].element;
    double gain[2];
    ElementGain(&coupling[e], &flow->u_star[k], &flow->u_plus[k], gain);
    for (int c = 0; c < 2; c++) sum[GAIN + c] += gain[c];
    sum[SCALE] += hypot(gain[0], gain[1]);
  }
  for (int i = 0; i < nnodes; i++) {
    for (int c = 0; c < 2; c++) {
      sum[REACTION + c] += node[i].reaction[c];
      sum[FORCE + c] += node[i].reaction[c] + node[i].other[c];
    }
  }
  sum[MASS] = DisplacedMass(o);
  sum[PAIRS] = o->pairs.n;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sum, COUNT, MPI_DOUBLE, MPI_SUM, o->comm));
  for (int c = 0; c < 2; c++) {
    totals->gain[c] = sum[GAIN + c];
    totals->reaction[c] = sum[REACTION + c];
    totals->force[c] = sum[FORCE + c];
  }
  const double lost = hypot(sum[GAIN] + sum[REACTION], sum[GAIN + 1] + sum[REACTION + 1]);
  totals->imbalance = sum[SCALE] > 0.0 ? lost / sum[SCALE] : lost;
  totals->displaced = sum[MASS];
  totals->npairs = (long long)sum[PAIRS];
  PetscFunctionReturn(0);
}

/* r -= int over the pair of N_K u+ */
static void SubtractFluid(const SupermeshPair *pair, const double u_plus[6], double r[2][3])
{
  for (int c = 0; c < 2; c++) {
    for (int i = 0; i < 3; i++) {
      for (int j = 0; j < 3; j++) r[c][i] -= pair->bb[i][j] * u_plus[3 * c + j];
    }
  }
}

void ForceCorrection(const Overlap o, const double u[][3][2], const double u_plus[],
                     CoracleCorrection correction[])
{
  for (int p = 0; p < o->pairs.n; p++) {
    const SupermeshPair *pair = &o->pairs.pair[p];
    if (o->source[pair->a].is_shell) continue;
    CoracleCorrection *k = &correction[o->coupled_index[p]];
    SubtractFluid(pair, &u_plus[6 * pair->b], k->r);
    for (int c = 0; c < 2; c++) {
      for (int j = 0; j < 3; j++) {
        for (int i = 0; i < 3; i++) k->r[c][j] += pair->ab[i][j] * u[pair->a][i][c];
      }
    }
  }
}
