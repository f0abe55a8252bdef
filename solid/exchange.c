#include "exchange.h"

static int SaveOrRestore(void *solid, int save)
{
  return SolidState(solid, save);
}

PetscErrorCode ExchangeCreate(CoracleClient client, Solid solid, Exchange *x)
{
  SolidView v;
  PetscFunctionBeginUser;
  *x = (Exchange){client, solid, 0.0};
  SolidGetView(solid, &v);
  PetscCall(CoracleSetNodes(client, 2, v.nnodes, v.gid, v.x, v.v));
  PetscCall(CoracleSetSurface(client, v.nfacets, v.facet));
  PetscCall(CoracleSetVolume(client, v.nelements, v.element));
  PetscCall(CoracleBindStateFunction(client, SaveOrRestore, solid));
  PetscCall(CoracleReady(client));
  PetscFunctionReturn(0);
}

PetscErrorCode ExchangeBegin(Exchange *x, double *dt, CoracleAction *action, const double **load)
{
  const double start = MPI_Wtime();
  double t;
  PetscFunctionBeginUser;
  PetscCall(CoracleBegin(x->client, &t, dt, action));
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
  PetscCall(CoracleSetVelocity(x->client, seen));
  PetscCall(CoracleEnd(x->client, v.x));
  x->waited += MPI_Wtime() - start;
  PetscFunctionReturn(0);
}
