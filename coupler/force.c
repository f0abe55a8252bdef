#include "coupler/force.h"

/* change[i] = int over the pair of N_T,i (u+ - u start). */
static void Change(const SupermeshPair *pair, const double u_projected[6], const double u_start[6],
                   double change[3][2])
{
  double du[6];
  for (int k = 0; k < 6; k++) du[k] = u_projected[k] - u_start[k];
  for (int i = 0; i < 3; i++)
    for (int c = 0; c < 2; c++)
      change[i][c] =
          pair->ab[i][0] * du[3 * c] + pair->ab[i][1] * du[3 * c + 1] + pair->ab[i][2] * du[3 * c + 2];
}

/* The reaction of one pair: a slip + inertia change - q; inside solids a or the inertia is mostly 0. */
static void AddReaction(const SupermeshPair *pair, const PairTerm *term, const double u[3][2],
                        const double start_velocity[3][2], const CoracleFlow *flow, ForceVertex v[3])
{
  const size_t k = 6 * (size_t)pair->b;
  double slip[3][2], change[3][2], r[2];
  for (int i = 0; i < 3; i++)
    for (int c = 0; c < 2; c++)
      v[i].reaction[c] -=
          pair->aa[i][0] * term->q[0][c] + pair->aa[i][1] * term->q[1][c] + pair->aa[i][2] * term->q[2][c];
  if (!WallIsZero(&term->a)) {
    PairSlip(pair, &flow->u_star[k], u, slip);
    for (int i = 0; i < 3; i++) {
      WallApply(&term->a, slip[i], r);
      for (int c = 0; c < 2; c++) v[i].reaction[c] += r[c];
    }
  }
  if (!WallIsZero(&term->start)) {
    PairSlip(pair, &flow->u_start[k], start_velocity, slip);
    for (int i = 0; i < 3; i++) {
      WallApply(&term->start, slip[i], r);
      for (int c = 0; c < 2; c++) v[i].reaction[c] += r[c];
    }
  }
  if (term->inertia == 0.0) return;
  Change(pair, &flow->u_projected[k], &flow->u_start[k], change);
  for (int i = 0; i < 3; i++)
    for (int c = 0; c < 2; c++) v[i].reaction[c] += term->inertia * change[i][c];
}

void ForceReaction(const Overlap o, const PairTerm term[], const double start_velocity[][3][2],
                   const CoracleFlow *flow, ForceVertex vertex[])
{
  for (int p = 0; p < o->pairs.n; p++) {
    const SupermeshPair *pair = &o->pairs.pair[p];
    AddReaction(pair, &term[p], (const double(*)[2])o->source[pair->a].u, start_velocity[pair->a], flow,
                &vertex[3 * pair->a]);
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
    PairSlip(pair, &u_projected[6 * pair->b], start_velocity[pair->a], q);
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

/* One element's gain, the sum over its functions of s - a u* - I (u+ - kept u start), where it is covered less rho_f M/dt u start;
 * mass: rho_f |K|/dt. */
static void ElementGain(const CoracleCoupling *k, double mass, const CoracleFlow *flow, double gain[2])
{
  const int covered = k->flags & CORACLE_IS_COVERED;
  const size_t first = 6 * (size_t)k->element;
  const double *u_star = flow->u_star + first, *u_projected = flow->u_projected + first,
               *u_start = flow->u_start + first;
  for (int c = 0; c < 2; c++) {
    gain[c] = 0.0;
    for (int i = 0; i < 3; i++) {
      gain[c] += k->s[c][i];
      for (int j = 0; j < 6; j++) gain[c] -= k->a[c][i][j / 3][j % 3] * u_star[j];
      for (int j = 0; j < 3; j++)
        gain[c] -= k->implicit_inertia[i][j] *
                   (u_projected[3 * c + j] - k->kept[c][0] * u_start[j] - k->kept[c][1] * u_start[3 + j]);
      if (covered) gain[c] -= mass / 3.0 * u_start[3 * c + i];
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

PetscErrorCode ForceSum(const Overlap o, double dt, const CoracleCoupling coupling[], const CoracleFlow *flow,
                        int nnodes, const ForceVertex node[], ForceTotals *totals)
{
  enum { GAIN, REACTION = 2, FORCE = 4, SCALE = 6, MASS, PAIRS, AREA, SQUARE, COUNT };
  double sum[COUNT] = {0};

  PetscFunctionBeginUser;
  for (int e = 0; e < o->ncoupled; e++) {
    const int k = coupling[e].element;
    double gain[2];
    ElementGain(&coupling[e], o->rho[k] * o->area[k] / dt, flow, gain);
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
