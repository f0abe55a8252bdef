/* The correction, which all modes have, and the force of those that conserve momentum. */
#include "coupler/step/coupler_impl.h"
#include "coupler/terms/slip.h"

PetscErrorCode CouplerConservativeForce(Coupler c)
{
  PetscFunctionBeginUser;
  PetscCall(ForceOfPairs(c->overlap, c->term, c->element, c->source, c->options.gravity, c->dt, &c->flow,
                         c->vertex));
  PetscCall(OverlapSourcesToNodes(c->overlap, 4, (const double *)c->vertex, c->nnodes, (double *)c->node));
  for (int i = 0; i < c->history.n; i++)
    for (int d = 0; d < 2; d++) c->node[i].other[d] -= c->history.retained[i][d] / c->dt;
  PetscFunctionReturn(0);
}

/* Momentum that the fluid inside keeps of its slip, to the history's nodes; u[nsources]: the solid's velocity at the
 * step's end. */
static PetscErrorCode StoreRetained(Coupler c, const SolidState *moved, const LinearField u[])
{
  const Overlap o = c->overlap;
  double(*source)[3][2], (*owned)[3][2];

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc2(o->nsources, &source, o->nowned, &owned));
  SlipRetained(o, c->element, u, c->flow.u_projected, source);
  PetscCall(OverlapReverseAdd(o, 6, (const double *)source, (double *)owned));
  for (int k = 0; k < 3 * o->nvolume; k++)
    for (int d = 0; d < 2; d++) c->history.retained[moved->element[k]][d] += owned[k / 3][k % 3][d];
  PetscCall(PetscFree2(source, owned));
  PetscFunctionReturn(0);
}

/* Corner by corner, so that it serves steps in which cracks have split nodes, too. */
PetscErrorCode CouplerSolidCorrection(Coupler c, const SolidState *moved)
{
  const Overlap o = c->overlap;
  double(*owned)[3][2], (*vertex)[3][2];
  LinearField *u;

  PetscFunctionBeginUser;
  PetscCheck(moved->nelements == o->nvolume, PETSC_COMM_SELF, PETSC_ERR_PLIB,
             "%d elements of the solid have become %d within a step", o->nvolume, moved->nelements);
  PetscCall(PetscCalloc1(o->nowned, &owned));
  PetscCall(PetscMalloc2(o->nsources, &vertex, o->nsources, &u));
  for (int k = 0; k < 3 * o->nvolume; k++)
    PetscCall(PetscArraycpy(owned[k / 3][k % 3], moved->u + 2 * moved->element[k], 2));
  PetscCall(OverlapForward(o, 6, (const double *)owned, (double *)vertex));
  for (int t = 0; t < o->nsources; t++)
    u[t] = LinearFieldOnSource(&o->source_basis[t], (const double(*)[2])vertex[t]);
  ForceCorrection(o, u, c->flow.u_projected, c->correction);
  SlipCorrection(o, c->element, c->correction);
  PetscCall(StoreRetained(c, moved, u));
  PetscCall(PetscFree2(vertex, u));
  PetscCall(PetscFree(owned));
  PetscFunctionReturn(0);
}
