#include "fluid/pressure/rotational_increment.h"
#include "fluid/discretization/ghosted.h"

struct RotationalIncrement_s {
  const FluidDomain *domain; /* borrowed */
  const char *is_fixed;      /* borrowed */
  int revision;              /* of the viscosity in coefficient, -1: there is none */
  int (*end)
      [2]; /* [nowned] local vertices of the edge with an owned node in its middle; twice itself: a vertex */
  /* at vertices: mean viscosity over the lumped mass, 0 where the pressure is prescribed, Pa s/m2; div u times viscosity, Pa */
  Vec coefficient, value;
};

/* On owners: the sum over the elements at a vertex of weight |K|/3; weight[ne], NULL: 1. */
static PetscErrorCode SumToVertices(const FluidDomain *d, const double weight[], Vec to)
{
  PetscScalar *sum;
  PetscFunctionBeginUser;
  PetscCall(GhostedGetArrayZero(to, &sum));
  for (int k = 0; k < 3 * d->mesh->ne; k++) {
    const int e = k / 3;
    sum[d->p2->node[6 * e + k % 3]] += (weight ? weight[e] : 1.0) * d->geometry[e].area / 3.0;
  }
  PetscCall(GhostedRestoreArray(to, &sum));
  PetscCall(GhostedSum(to));
  PetscFunctionReturn(0);
}

PetscErrorCode RotationalIncrementCreate(const FluidDomain *domain, Vec like, const char is_fixed[],
                                         RotationalIncrement *increment)
{
  const P2Space *p2 = domain->p2;
  RotationalIncrement r;
  PetscFunctionBeginUser;
  PetscCall(PetscNew(&r));
  r->domain = domain;
  r->is_fixed = is_fixed;
  r->revision = -1;
  PetscCall(VecDuplicate(like, &r->coefficient));
  PetscCall(VecDuplicate(like, &r->value));
  PetscCall(PetscMalloc1(p2->nowned, &r->end));
  for (int k = 0; k < p2->nowned; k++) r->end[k][0] = r->end[k][1] = k;
  for (int k = 0; k < 3 * domain->mesh->ne; k++) {
    const int *node = p2->node + 6 * (k / 3), middle = node[3 + k % 3];
    for (int i = 0; i < 2 && middle < p2->nowned; i++) r->end[middle][i] = node[(k + 1 + i) % 3];
  }
  *increment = r;
  PetscFunctionReturn(0);
}

PetscErrorCode RotationalIncrementDestroy(RotationalIncrement *increment)
{
  RotationalIncrement r = *increment;
  PetscFunctionBeginUser;
  if (!r) PetscFunctionReturn(0);
  PetscCall(VecDestroy(&r->coefficient));
  PetscCall(VecDestroy(&r->value));
  PetscCall(PetscFree(r->end));
  PetscCall(PetscFree(*increment));
  PetscFunctionReturn(0);
}

/* A vertex' linear function is its quadratic one and half of those of the edges that end there: value, on owners, becomes
 * the sum of what divergence has at those. */
static PetscErrorCode SumToLinear(RotationalIncrement r, Vec divergence)
{
  const PetscScalar *d;
  PetscScalar *value;
  PetscFunctionBeginUser;
  PetscCall(VecGetArrayRead(divergence, &d));
  PetscCall(GhostedGetArrayZero(r->value, &value));
  for (int k = 0; k < r->domain->p2->nowned; k++)
    for (int i = 0; i < 2; i++) value[r->end[k][i]] += 0.5 * d[k];
  PetscCall(GhostedRestoreArray(r->value, &value));
  PetscCall(VecRestoreArrayRead(divergence, &d));
  PetscCall(GhostedSum(r->value));
  PetscFunctionReturn(0);
}

/* sum of mu |K|/3 over the elements at a vertex, over the square of the sum of |K|/3 */
static PetscErrorCode SetCoefficient(RotationalIncrement r, const double mu[])
{
  const PetscScalar *mass;
  PetscScalar *c;
  Vec lumped;
  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(r->coefficient, &lumped));
  PetscCall(SumToVertices(r->domain, NULL, lumped));
  PetscCall(SumToVertices(r->domain, mu, r->coefficient));
  PetscCall(VecGetArrayRead(lumped, &mass));
  PetscCall(VecGetArray(r->coefficient, &c));
  for (int k = 0; k < r->domain->p2->nowned; k++)
    c[k] = r->is_fixed[k] || r->end[k][0] != k ? 0.0 : c[k] / PetscSqr(mass[k]);
  PetscCall(VecRestoreArray(r->coefficient, &c));
  PetscCall(VecRestoreArrayRead(lumped, &mass));
  PetscCall(VecDestroy(&lumped));
  PetscFunctionReturn(0);
}

PetscErrorCode RotationalIncrementAdd(RotationalIncrement r, Vec divergence, const double mu[], int revision,
                                      double factor, Vec p)
{
  const PetscScalar *value;
  PetscScalar *sum;
  PetscFunctionBeginUser;
  if (revision != r->revision) PetscCall(SetCoefficient(r, mu));
  r->revision = revision;
  PetscCall(SumToLinear(r, divergence));
  PetscCall(VecPointwiseMult(r->value, r->value, r->coefficient));
  PetscCall(GhostedUpdate(r->value));
  PetscCall(GhostedGetArrayRead(r->value, &value));
  PetscCall(VecGetArray(p, &sum));
  for (int k = 0; k < r->domain->p2->nowned; k++)
    if (!r->is_fixed[k]) sum[k] += 0.5 * factor * (value[r->end[k][0]] + value[r->end[k][1]]);
  PetscCall(VecRestoreArray(p, &sum));
  PetscCall(GhostedRestoreArrayRead(r->value, &value));
  PetscCall(GhostedUpdate(p));
  PetscFunctionReturn(0);
}
