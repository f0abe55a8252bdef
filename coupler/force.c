#include "coupler/force.h"

/* q[i] = int over the pair of N_T,i (u - u_s): u [2][3] on the fluid element, u_s [3][2] on the source
 * triangle. */
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

/* u = b u* + (1 - b) u+, the fluid velocity in the reaction, on the pair's element. */
static void ReactionVelocity(double implicit_factor, const double u_star[6], const double u_projected[6],
                             double u[6])
{
  for (int i = 0; i < 6; i++)
    u[i] = implicit_factor == 1.0 ? u_star[i]
                                  : implicit_factor * u_star[i] + (1.0 - implicit_factor) * u_projected[i];
}

void ForceReaction(const Overlap o, const WallCoefficient coefficient[], const double implicit_factor[],
                   const double body_force[][3][2], const CoracleFlow *flow, ForceVertex vertex[])
{
  for (int p = 0; p < o->pairs.n; p++) {
    const SupermeshPair *pair = &o->pairs.pair[p];
    ForceVertex *v = &vertex[3 * pair->a];
    double u[6], q[3][2], r[2];
    ReactionVelocity(implicit_factor[pair->a], &flow->u_star[6 * pair->b], &flow->u_projected[6 * pair->b],
                     u);
    Slip(pair, u, o->source[pair->a].u, q);
    for (int i = 0; i < 3; i++) {
      WallApply(&coefficient[p], q[i], r);
      for (int c = 0; c < 2; c++) {
        v[i].reaction[c] += r[c];
        for (int j = 0; j < 3; j++) v[i].reaction[c] -= pair->aa[i][j] * body_force[p][j][c];
      }
    }
  }
}

void ForceInertia(const Overlap o, double dt, const double gravity[2], const double u_projected[],
                  const double start_velocity[][3][2], ForceVertex vertex[])
{
  for (int p = 0; p < o->pairs.n; p++) {
    const SupermeshPair *pair = &o->pairs.pair[p];
    if (o->source[pair->a].is_shell) continue;
    const double rho = o->rho[pair->b];
    ForceVertex *v = &vertex[3 * pair->a];
    double q[3][2];
    Slip(pair, &u_projected[6 * pair->b], start_velocity[pair->a], q);
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

/* One element's gain, the sum over its functions of s - a u* - (1 - b) a (u+ - u*). */
static void ElementGain(const CoracleCoupling *k, const double u_star[6], const double u_projected[6],
                        double gain[2])
{
  for (int c = 0; c < 2; c++) {
    gain[c] = 0.0;
    for (int i = 0; i < 3; i++) {
      gain[c] += k->s[c][i];
      for (int j = 0; j < 6; j++) {
        gain[c] -= k->a[c][i][j / 3][j % 3] * u_star[j];
        gain[c] -= k->implicit_inertia[c][i][j / 3][j % 3] * (u_projected[j] - u_star[j]);
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

/* area += that of the fluid near the solid, square += int |u|^2 over it with the vertices as points. */
static void AddSquare(const Overlap o, const double u[], double *area, double *square)
{
  for (int k = 0; k < o->nelements; k++) {
    *area += o->area[k];
    for (int i = 6 * k; i < 6 * k + 6; i++) *square += o->area[k] / 3.0 * u[i] * u[i];
  }
}

PetscErrorCode ForceSum(const Overlap o, const CoracleCoupling coupling[], const CoracleFlow *flow,
                        int nnodes, const ForceVertex node[], ForceTotals *totals)
{
  enum { GAIN, REACTION = 2, FORCE = 4, SCALE = 6, MASS, PAIRS, AREA, SQUARE, COUNT };
  double sum[COUNT] = {0};

  PetscFunctionBeginUser;
  for (int e = 0; e < o->ncoupled; e++) {
    const int k = 6 * coupling[e].element;
    double gain[2];
    ElementGain(&coupling[e], &flow->u_star[k], &flow->u_projected[k], gain);
    for (int c = 0; c < 2; c++) sum[GAIN + c] += gain[c];
    sum[SCALE] += hypot(gain[0], gain[1]);
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
    totals->gain[c] = sum[GAIN + c];
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

/* r -= B u+ of one pair. */
static void SubtractFluid(const SupermeshPair *pair, const double u_projected[6], double r[2][3])
{
  for (int c = 0; c < 2; c++) {
    for (int i = 0; i < 3; i++) {
      for (int j = 0; j < 3; j++) r[c][i] -= pair->bb[i][j] * u_projected[3 * c + j];
    }
  }
}

void ForceCorrection(const Overlap o, const double u[][3][2], const double u_projected[],
                     CoracleCorrection correction[])
{
  for (int p = 0; p < o->pairs.n; p++) {
    const SupermeshPair *pair = &o->pairs.pair[p];
    if (o->source[pair->a].is_shell) continue;
    CoracleCorrection *k = &correction[o->coupled_index[p]];
    SubtractFluid(pair, &u_projected[6 * pair->b], k->r);
    for (int c = 0; c < 2; c++) {
      for (int j = 0; j < 3; j++) {
        for (int i = 0; i < 3; i++) k->r[c][j] += pair->ab[i][j] * u[pair->a][i][c];
      }
    }
  }
}
