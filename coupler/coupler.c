#include "coupler/coupler_impl.h"

const char *const COUPLER_MODES[] = {"reaction", "stress_shell", "penalty_shell", NULL};
static const CouplerActions *const ACTIONS[] = {&COUPLER_ACTIONS_REACTION, &COUPLER_ACTIONS_STRESS_SHELL,
                                                &COUPLER_ACTIONS_PENALTY_SHELL};

PetscErrorCode CouplerCreate(MPI_Comm comm, const CouplerOptions *options, Coupler *coupler)
{
  Coupler c;

  PetscFunctionBeginUser;
  PetscCall(PetscNew(&c));
  c->comm = comm;
  c->options = *options;
  c->actions = ACTIONS[options->mode];
  PetscCall(ShellCreate(comm, options->thickness, &c->shell));
  PetscCall(OverlapCreate(comm, &c->overlap));
  *coupler = c;
  PetscFunctionReturn(0);
}

PetscBool CouplerNeedsPressure(Coupler c)
{
  return c->actions->needs_pressure;
}

PetscErrorCode CouplerSetElements(Coupler c, const ServerElements *elements)
{
  PetscFunctionBeginUser;
  PetscCall(OverlapSetElements(c->overlap, elements));
  PetscFunctionReturn(0);
}

static PetscErrorCode FreeStep(Coupler c)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree2(c->weight, c->coupling));
  PetscCall(PetscFree5(c->vertex, c->now, c->firmness, c->node, c->force));
  PetscFunctionReturn(0);
}

static PetscErrorCode NewStep(Coupler c, const ServerSolid *solid)
{
  const Overlap o = c->overlap;
  const size_t npieces = (size_t)o->npieces, nnodes = (size_t)solid->nnodes;

  PetscFunctionBeginUser;
  PetscCall(FreeStep(c));
  PetscCall(PetscMalloc2(o->pairs.n, &c->weight, o->nentries, &c->coupling));
  PetscCall(PetscMalloc5(3 * npieces, &c->vertex, npieces, &c->now, npieces, &c->firmness, nnodes, &c->node,
                         2 * nnodes, &c->force));
  for (size_t t = 0; t < npieces; t++) c->firmness[t] = 1.0;
  for (size_t t = 0; t < npieces; t++) PetscCall(PetscArraycpy(&c->now[t][0][0], &o->piece[t].u[0][0], 6));
  PetscFunctionReturn(0);
}

PetscErrorCode CouplerBuild(Coupler c, const ServerSolid *solid, double dt, int *n,
                            const CoracleCoupling **coupling)
{
  PetscFunctionBeginUser;
  c->dt = dt;
  PetscCall(ShellExtrude(c->shell, solid, solid->changed || !c->built ? PETSC_TRUE : PETSC_FALSE));
  PetscCall(OverlapBuild(c->overlap, solid, c->shell));
  PetscCall(NewStep(c, solid));
  c->built = 1;
  c->nnodes = solid->nnodes;
  c->us = solid->u;
  PetscCall(c->actions->weigh(c, solid));
  WallTermAssemble(c->overlap, c->weight, c->firmness, c->coupling);
  *n = c->overlap->nentries;
  *coupling = c->coupling;
  PetscFunctionReturn(0);
}

PetscErrorCode CouplerSetInterfaceVelocity(Coupler c, const double mobility[], const double u[], int *n,
                                           const CoracleCoupling **coupling)
{
  const Overlap o = c->overlap;
  double(*aim)[3][2], (*gives)[3];

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(o->npieces, &aim, o->npieces, &gives));
  PetscCall(OverlapNodesToPieces(o, 2, u, &aim[0][0][0]));
  PetscCall(OverlapNodesToPieces(o, 1, mobility, &gives[0][0]));
  for (int t = 0; t < o->npieces; t++)
    for (int i = 0; i < 3; i++)
      if (gives[t][i] == 0.0) PetscCall(PetscArraycpy(o->piece[t].u[i], aim[t][i], 2));
  PetscCall(PetscFree2(aim, gives));
  c->us = u;
  WallTermAssemble(o, c->weight, c->firmness, c->coupling);
  *n = o->nentries;
  *coupling = c->coupling;
  PetscFunctionReturn(0);
}

PetscErrorCode CouplerReact(Coupler c, const CoracleFlow *flow, const double **force, ForceTotals *totals)
{
  PetscFunctionBeginUser;
  c->flow = *flow;
  PetscCall(OverlapSetProperties(c->overlap, flow->rho, flow->mu));
  PetscCall(PetscArrayzero(c->vertex, 3 * (size_t)c->overlap->npieces));
  PetscCall(c->actions->react(c));
  for (int i = 0; i < c->nnodes; i++) {
    for (int d = 0; d < 2; d++) c->force[2 * i + d] = c->node[i].reaction[d] + c->node[i].rest[d];
  }
  PetscCall(ForceSum(c->overlap, c->coupling, flow, c->nnodes, c->node, totals));
  *force = c->force;
  PetscFunctionReturn(0);
}

PetscErrorCode CouplerNoCorrection(Coupler c, const ServerSolid *moved)
{
  PetscFunctionBeginUser;
  PetscFunctionReturn(0);
}

PetscErrorCode CouplerReactConserving(Coupler c)
{
  PetscFunctionBeginUser;
  ForceReaction(c->overlap, c->weight, c->firmness, &c->flow, c->vertex);
  ForceInertia(c->overlap, c->dt, c->options.gravity, c->flow.u_projected, (const double(*)[3][2])c->now,
               c->vertex);
  PetscCall(ForceAssembleToOwners(c->overlap, c->vertex, c->nnodes, c->node));
  PetscFunctionReturn(0);
}

PetscErrorCode CouplerFillSolid(Coupler c, const ServerSolid *moved)
{
  double(*u)[3][2];

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(c->overlap->npieces, &u));
  PetscCall(OverlapNodesToPieces(c->overlap, 2, moved->u, &u[0][0][0]));
  ForceCorrection(c->overlap, (const double(*)[3][2])u, c->flow.u_projected, c->correction);
  PetscCall(PetscFree(u));
  PetscFunctionReturn(0);
}

PetscErrorCode CouplerCorrect(Coupler c, const ServerSolid *moved, int *n,
                              const CoracleCorrection **correction)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(c->correction));
  PetscCall(PetscCalloc1(c->overlap->nentries, &c->correction));
  for (int e = 0; e < c->overlap->nentries; e++) c->correction[e].element = c->overlap->element[e];
  PetscCall(moved->changed ? CouplerNoCorrection(c, moved) : c->actions->correct(c, moved));
  *n = c->overlap->nentries;
  *correction = c->correction;
  PetscFunctionReturn(0);
}

Shell CouplerShell(Coupler c)
{
  return c->shell;
}
Overlap CouplerOverlap(Coupler c)
{
  return c->overlap;
}

PetscErrorCode CouplerDestroy(Coupler *coupler)
{
  PetscFunctionBeginUser;
  if (!*coupler) PetscFunctionReturn(0);
  PetscCall(FreeStep(*coupler));
  PetscCall(PetscFree((*coupler)->correction));
  PetscCall(ShellDestroy(&(*coupler)->shell));
  PetscCall(OverlapDestroy(&(*coupler)->overlap));
  PetscCall(PetscFree(*coupler));
  PetscFunctionReturn(0);
}
