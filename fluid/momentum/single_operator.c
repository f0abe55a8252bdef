#include "fluid/momentum/single_operator.h"

struct SingleOperator_s {
  MomentumOperator *op;     /* borrowed */
  SingleBlocks *block;      /* [ne + 1], the last one is only read over */
  SingleGeometry *geometry; /* [ne + ng], like all below */
  SingleVector *x;
  float (*stress)[4];
};

static void SetGeometry(SingleOperator s)
{
  const Mesh *m = s->op->domain->mesh;
  for (int e = 0; e < m->ne + m->ng; e++) {
    const ElementGeometry *g = s->op->domain->geometry + e;
    s->geometry[e].gradient = (float)(-2.0 / g->area);
    for (int i = 0; i < 3; i++)
      for (int d = 0; d < 2; d++) s->geometry[e].q[i][d] = (float)(-0.5 * g->area * g->g[i][d]);
  }
}

PetscErrorCode SingleOperatorCreate(MomentumOperator *op, SingleOperator *single)
{
  const Mesh *m = op->domain->mesh;
  const int n = m->ne + m->ng;
  SingleOperator s;
  PetscFunctionBeginUser;
  PetscCall(PetscNew(&s));
  s->op = op;
  PetscCall(PetscCalloc1(m->ne + 1, &s->block));
  PetscCall(PetscMalloc3(n, &s->geometry, n, &s->x, n, &s->stress));
  SetGeometry(s);
  *single = s;
  PetscFunctionReturn(0);
}

PetscErrorCode SingleOperatorDestroy(SingleOperator *single)
{
  SingleOperator s = *single;
  PetscFunctionBeginUser;
  if (!s) PetscFunctionReturn(0);
  PetscCall(PetscFree(s->block));
  PetscCall(PetscFree3(s->geometry, s->x, s->stress));
  PetscCall(PetscFree(*single));
  PetscFunctionReturn(0);
}

PetscErrorCode SingleOperatorUpdate(SingleOperator s)
{
  const Mesh *m = s->op->domain->mesh;
  PetscFunctionBeginUser;
  for (int e = 0; e < m->ne + m->ng; e++) s->geometry[e].theta_mu = (float)s->op->theta_mu[e];
  for (int e = 0; e < m->ne; e++)
    for (int i = 0; i < 4; i++)
      for (int k = 0; k < 9 && (i == 0 || m->neighbor[3 * e + i - 1] >= 0); k++)
        s->block[e][i][k] = (float)s->op->block[e][i][k];
  PetscFunctionReturn(0);
}

/* Rows of element e, but for D. */
static void ApplyElement(const SingleOperator s, int e, double y[6])
{
  const Mesh *m = s->op->domain->mesh;
  const SingleGeometry *g = s->geometry + e;
  SinglePair scalar = {{{0}, {0}}}, coupled;
  float r[8] = {0}, f[4] = {0};
  SingleBlockAdd(s->block[e][0], s->x[e], &scalar);
  for (int i = 0; i < 3; i++) {
    const int nb = m->neighbor[3 * e + i];
    if (nb < 0) continue;
    SingleBlockAdd(s->block[e][1 + i], s->x[nb], &scalar);
    SingleForceFace(g, i, m->neighbor_face[3 * e + i], s->stress[e], s->stress[nb], s->x[e], s->x[nb], f, r);
  }
  SingleForceEnd(g, s->stress[e], f, r);
  SingleLoad(r, &coupled);
  for (int c = 0; c < 2; c++) scalar.c[c] += coupled.c[c];
  SingleStore(&scalar, r);
  SingleToDouble(r, y);
}

PetscErrorCode SingleOperatorApply(SingleOperator s, Vec x, Vec y)
{
  const Mesh *m = s->op->domain->mesh;
  const PetscScalar *u;
  PetscScalar *v;
  PetscFunctionBeginUser;
  PetscCall(MomentumOperatorGetGhosted(s->op, x, &u));
  PetscCall(VecGetArrayWrite(y, &v));
  for (int e = 0; e < m->ne + m->ng; e++) {
    SingleFromDouble(u + 6 * e, s->x[e]);
    SingleStress(s->geometry + e, s->x[e], s->stress[e]);
  }
  for (int e = 0; e < m->ne; e++) ApplyElement(s, e, v + 6 * e);
  MomentumOperatorApplyDense(s->op, u, v);
  PetscCall(VecRestoreArrayWrite(y, &v));
  PetscCall(MomentumOperatorRestoreGhosted(s->op, x, &u));
  PetscFunctionReturn(0);
}
