#include "exchange.h"

static int SaveOrRestore(void *solid, int save)
{
  return SolidState(solid, save);
}

static PetscErrorCode GiveMesh(Exchange *x, const SolidView *v, const double u[])
{
  PetscFunctionBeginUser;
  PetscCall(CoracleSetNodes(x->client, 2, v->nnodes, v->gid, v->x, u));
  PetscCall(CoracleSetSurface(x->client, v->nfacets, v->facet));
  PetscCall(CoracleSetVolume(x->client, v->nelements, v->element));
  x->revision = v->revision;
  PetscFunctionReturn(0);
}

/* Cracks have changed the mesh in this step, or elements their ranks.  The substeps have told the velocities
 * of the nodes that were there when it began, which come first; new ones get the mean over the step from
 * here. */
static PetscErrorCode GiveCrackedMesh(Exchange *x, const SolidView *v)
{
  double *mean;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(2 * (size_t)v->nnodes, &mean));
  for (int k = 0; k < 2 * v->nnodes; k++) mean[k] = (v->x[k] - v->start[k]) / x->dt;
  PetscCall(GiveMesh(x, v, mean));
  PetscCall(PetscFree(mean));
  PetscFunctionReturn(0);
}

PetscErrorCode ExchangeCreate(CoracleClient client, Solid solid, Exchange *x)
{
  SolidView v;
  PetscFunctionBeginUser;
  *x = (Exchange){.client = client, .solid = solid};
  SolidGetView(solid, &v);
  PetscCall(GiveMesh(x, &v, v.v));
  PetscCall(CoracleBindStateFunction(client, SaveOrRestore, solid));
  PetscCall(CoracleReady(client));
  PetscFunctionReturn(0);
}

PetscErrorCode ExchangeBegin(Exchange *x, double *dt, CoracleAction *action, const double **load)
{
  const double start = MPI_Wtime();
  SolidView v;
  double t;
  PetscFunctionBeginUser;
  PetscCall(CoracleBegin(x->client, &t, dt, action));
  SolidGetView(x->solid, &v);
  x->revision = v.revision; /* a redone step: of the mesh that both have put back */
  x->dt = *dt;
  if (*action != CORACLE_STOP) PetscCall(CoracleGetForce(x->client, load));
  x->waited += MPI_Wtime() - start;
  PetscFunctionReturn(0);
}

PetscErrorCode ExchangeSubstep(Exchange *x, double h)
{
  SolidView v;
  PetscFunctionBeginUser;
  SolidGetView(x->solid, &v);
  PetscCall(CoracleSubstep(x->client, h, v.v));
  PetscFunctionReturn(0);
}

PetscErrorCode ExchangeMotion(Exchange *x)
{
  const double start = MPI_Wtime();
  SolidView v;
  const double *seen;
  PetscFunctionBeginUser;
  SolidGetView(x->solid, &v);
  PetscCall(SolidSeenVelocity(x->solid, &seen));
  if (v.revision != x->revision) PetscCall(GiveCrackedMesh(x, &v));
  PetscCall(CoracleSetVelocity(x->client, seen));
  PetscCall(CoracleEnd(x->client, v.x));
  x->waited += MPI_Wtime() - start;
  PetscFunctionReturn(0);
}
