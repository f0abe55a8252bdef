#include "fluid/momentum/momentum_operator.h"
#include "fluid/discretization/ghosted.h"

PetscErrorCode MomentumOperatorCreate(const FluidDomain *domain, Vec like, MomentumOperator *op)
{
  const Mesh *m = domain->mesh;
  PetscMPIInt size;
  PetscFunctionBeginUser;
  memset(op, 0, sizeof *op);
  PetscCallMPI(MPI_Comm_size(m->comm, &size));
  op->alone = (PetscBool)(size == 1);
  op->domain = domain;
  PetscCall(PetscMalloc5(m->ne + 1, &op->block, m->ne, &op->volume, m->ne + m->ng, &op->theta_mu,
                         m->ne + m->ng, &op->stress, m->ne, &op->dense_at));
  for (int e = 0; e < m->ne; e++) op->dense_at[e] = -1;
  PetscCall(VecDuplicate(like, &op->ghosted));
  PetscFunctionReturn(0);
}

PetscErrorCode MomentumOperatorDestroy(MomentumOperator *op)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree5(op->block, op->volume, op->theta_mu, op->stress, op->dense_at));
  PetscCall(PetscFree(op->dense_element));
  PetscCall(PetscFree(op->dense));
  PetscCall(VecDestroy(&op->ghosted));
  PetscFunctionReturn(0);
}

static PetscErrorCode Reserve(MomentumOperator *op)
{
  PetscFunctionBeginUser;
  if (op->ndense < op->dense_capacity) PetscFunctionReturn(0);
  op->dense_capacity = 64 + 2 * op->dense_capacity;
  PetscCall(PetscRealloc(op->dense_capacity * sizeof *op->dense_element, &op->dense_element));
  PetscCall(PetscRealloc(op->dense_capacity * sizeof *op->dense, &op->dense));
  PetscFunctionReturn(0);
}

/* xx = yy, xy = yx = 0 */
static PetscBool IsScalar(const double block[36])
{
  int same = 1;
  for (int j = 0; j < 3; j++)
    for (int i = 0; i < 3; i++)
      same &= (block[6 * j + i] == block[6 * (3 + j) + 3 + i]) & (block[6 * j + 3 + i] == 0.0) &
              (block[6 * (3 + j) + i] == 0.0);
  return (PetscBool)same;
}

void MomentumOperatorClearDense(MomentumOperator *op)
{
  for (int k = 0; k < op->ndense; k++) op->dense_at[op->dense_element[k]] = -1;
  op->ndense = 0;
}

PetscErrorCode MomentumOperatorAddDense(MomentumOperator *op, int e, const double block[36])
{
  const PetscBool scalar = IsScalar(block);
  PetscFunctionBeginUser;
  for (int j = 0; j < 3; j++)
    for (int i = 0; i < 3; i++) {
      op->volume[e][3 * j + i] += 0.5 * (block[6 * j + i] + block[6 * (3 + j) + 3 + i]);
      if (scalar) op->block[e][0][3 * j + i] += block[6 * j + i];
    }
  if (scalar) PetscFunctionReturn(0);
  if (op->dense_at[e] < 0) {
    PetscCall(Reserve(op));
    PetscCall(PetscArrayzero(op->dense[op->ndense], 36));
    op->dense_at[e] = op->ndense;
    op->dense_element[op->ndense++] = e;
  }
  for (int i = 0; i < 36; i++) op->dense[op->dense_at[e]][i] += block[i];
  PetscFunctionReturn(0);
}

void MomentumOperatorApplyDense(const MomentumOperator *op, const double x[], double y[])
{
  for (int k = 0; k < op->ndense; k++) {
    const double *d = op->dense[k], *from = x + 6 * op->dense_element[k];
    double *to = y + 6 * op->dense_element[k];
    for (int j = 0; j < 6; j++)
      for (int i = 0; i < 6; i++) to[i] += d[6 * j + i] * from[j];
  }
}

/* C's stress in all elements, ghosts too. */
static void Stresses(const MomentumOperator *op, const double x[])
{
  const Mesh *m = op->domain->mesh;
  for (int e = 0; e < m->ne + m->ng; e++)
    CoupledStress(op->domain->geometry[e].g, op->theta_mu[e], x + 6 * e, op->stress[e]);
}

PetscErrorCode MomentumOperatorGetGhosted(MomentumOperator *op, Vec x, const PetscScalar **u)
{
  PetscFunctionBeginUser;
  if (op->alone) {
    PetscCall(VecGetArrayRead(x, u));
  } else {
    PetscCall(VecCopy(x, op->ghosted));
    PetscCall(GhostedUpdate(op->ghosted));
    PetscCall(GhostedGetArrayRead(op->ghosted, u));
  }
  PetscFunctionReturn(0);
}

PetscErrorCode MomentumOperatorRestoreGhosted(MomentumOperator *op, Vec x, const PetscScalar **u)
{
  PetscFunctionBeginUser;
  PetscCall(op->alone ? VecRestoreArrayRead(x, u) : GhostedRestoreArrayRead(op->ghosted, u));
  PetscFunctionReturn(0);
}

PetscErrorCode MomentumOperatorApply(MomentumOperator *op, Vec x, Vec y)
{
  const Mesh *m = op->domain->mesh;
  const PetscScalar *u;
  PetscScalar *v;
  PetscFunctionBeginUser;
  PetscCall(MomentumOperatorGetGhosted(op, x, &u));
  PetscCall(VecGetArrayWrite(y, &v));
  Stresses(op, u);
  for (int e = 0; e < m->ne; e++) {
    ElementVector scalar = {{{0}, {0}}};
    double r[6] = {0};
    CoupledForce c;
    ScalarBlockAdd(op->block[e][0], u + 6 * e, &scalar);
    CoupledForceBegin(op->domain->geometry[e].area, op->stress[e], &c);
    for (int i = 0; i < 3; i++) {
      const int nb = m->neighbor[3 * e + i];
      if (nb < 0) continue;
      ScalarBlockAdd(op->block[e][1 + i], u + 6 * nb, &scalar);
      CoupledForceFace(op->domain->geometry[e].face + i, i, m->neighbor_face[3 * e + i], op->theta_mu[e],
                       op->stress[e], op->stress[nb], u + 6 * e, u + 6 * nb, &c, r);
    }
    CoupledForceEnd(op->domain->geometry[e].g, &c, r);
    ElementVectorStore(&scalar, v + 6 * e);
    for (int k = 0; k < 6; k++) v[6 * e + k] += r[k];
  }
  MomentumOperatorApplyDense(op, u, v);
  PetscCall(VecRestoreArrayWrite(y, &v));
  PetscCall(MomentumOperatorRestoreGhosted(op, x, &u));
  PetscFunctionReturn(0);
}
