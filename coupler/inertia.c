#include "coupler/inertia.h"
#include "coupler/node_sum.h"

/* A node's mass beyond that of the fluid in its place counts (less than 0 for a light solid: with the fluid's own it is
 * still positive), and never less than this part of it, for m - m_f divides. */
#define MIN_MASS_FRACTION 1e-3

/* Where a node gives way its volume is held that much more firmly: no stability is at stake, and what slips
 * through is dt f/m over the relaxation. */
#define PENALTY_SCALE 1e4

enum { IMPEDANCE, DISPLACED, NSUMS };

/* z[nnodes]: over all ranks' pairs the sums of int a N_i, a the mean of the weight's two eigenvalues, kg/s,
 * and of int rho N_i over the volume, kg. */
static PetscErrorCode Impedance(const Overlap o, const SolidState *solid, const WallCoefficient coefficient[],
                                double z[][NSUMS])
{
  double(*vertex)[3][NSUMS];
  NodeSum sum;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(o->nsources, &vertex));
  for (int p = 0; p < o->pairs.n; p++) {
    const SupermeshPair *pair = &o->pairs.pair[p];
    const double a = 0.5 * (coefficient[p].xx + coefficient[p].yy);
    const double rho = o->source[pair->a].is_shell ? 0.0 : o->rho[pair->b];
    for (int i = 0; i < 3; i++) {
      const double area = pair->aa[i][0] + pair->aa[i][1] + pair->aa[i][2];
      vertex[pair->a][i][IMPEDANCE] += a * area;
      vertex[pair->a][i][DISPLACED] += rho * area;
    }
  }
  PetscCall(OverlapSourcesToNodes(o, NSUMS, (const double *)vertex, solid->nnodes, &z[0][0]));
  PetscCall(NodeSumCreate(o->comm, solid->nnodes, solid->gid, &sum));
  PetscCall(NodeSumApply(sum, NSUMS, &z[0][0]));
  PetscCall(NodeSumDestroy(&sum));
  PetscCall(PetscFree(vertex));
  PetscFunctionReturn(0);
}

static double Largest(const double v[3])
{
  return fmax(v[0], fmax(v[1], v[2]));
}

static PetscErrorCode ScalePenalty(Overlap o, const double mobility[], WallCoefficient coefficient[])
{
  double(*vertex)[3];

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(o->nsources, &vertex));
  PetscCall(OverlapNodesToSources(o, 1, mobility, &vertex[0][0]));
  for (int p = 0; p < o->pairs.n; p++) {
    const int t = o->pairs.pair[p].a;
    if (!o->source[t].is_shell && Largest(vertex[t]) > 0.0)
      coefficient[p] = WallCoefficientScaled(&coefficient[p], PENALTY_SCALE);
  }
  PetscCall(PetscFree(vertex));
  PetscFunctionReturn(0);
}

/* b and v' of one node */
static void EffectiveVelocity(const SolidState *solid, int i, double dt, const double gravity[2],
                              const double z[NSUMS], double *b, double v[2])
{
  const double mobility = solid->mobility[i];
  const double excess = 1.0 - z[DISPLACED] * mobility;
  const double mass_fraction =
      fabs(excess) < MIN_MASS_FRACTION ? MIN_MASS_FRACTION : excess; /* of the node's mass that counts */
  *b = mass_fraction / (mass_fraction + dt * z[IMPEDANCE] * mobility);
  for (int c = 0; c < 2; c++)
    v[c] = solid->u[2 * i + c] +
           dt / mass_fraction * (solid->acceleration[2 * i + c] - z[DISPLACED] * mobility * gravity[c]);
}

/* Firmness and v' of the pieces. */
static PetscErrorCode ApplyEffectiveVelocity(Overlap o, const double b[], const double v[][2],
                                             double implicit_factor[])
{
  double(*vertex)[3], (*velocity)[3][2];

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(o->nsources, &vertex, o->nsources, &velocity));
  PetscCall(OverlapNodesToSources(o, 1, b, &vertex[0][0]));
  PetscCall(OverlapNodesToSources(o, 2, &v[0][0], &velocity[0][0][0]));
  for (int t = 0; t < o->nsources; t++) {
    implicit_factor[t] = (vertex[t][0] + vertex[t][1] + vertex[t][2]) / 3.0;
    PetscCall(PetscMemcpy(o->source[t].u, velocity[t], sizeof velocity[t]));
  }
  PetscCall(PetscFree2(vertex, velocity));
  PetscFunctionReturn(0);
}

PetscErrorCode InertiaMakeImplicit(Overlap o, const SolidState *solid, double dt, const double gravity[2],
                                   WallCoefficient coefficient[], double implicit_factor[])
{
  int any_free = 0;
  double(*z)[NSUMS], *b, (*v)[2];

  PetscFunctionBeginUser;
  for (int i = 0; i < solid->nnodes; i++) any_free |= solid->mobility[i] > 0.0;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &any_free, 1, MPI_INT, MPI_LOR, o->comm));
  if (!any_free) PetscFunctionReturn(0);
  PetscCall(PetscMalloc3(solid->nnodes, &z, solid->nnodes, &b, solid->nnodes, &v));
  PetscCall(ScalePenalty(o, solid->mobility, coefficient));
  PetscCall(Impedance(o, solid, coefficient, z));
  for (int i = 0; i < solid->nnodes; i++) EffectiveVelocity(solid, i, dt, gravity, z[i], &b[i], v[i]);
  PetscCall(ApplyEffectiveVelocity(o, b, (const double(*)[2])v, implicit_factor));
  for (int p = 0; p < o->pairs.n; p++)
    coefficient[p] = WallCoefficientScaled(&coefficient[p], implicit_factor[o->pairs.pair[p].a]);
  PetscCall(PetscFree3(z, b, v));
  PetscFunctionReturn(0);
}
