#include "solid/exchange.h"
#include "solid/ranks/node_directory.h"

static int SaveOrRestore(void *solid, int save)
{
  return SolidState(solid, save);
}

/* --- the mesh
 * ----------------------------------------------------------------------------------------------- */

static PetscErrorCode GiveMesh(Exchange *x, const SolidView *v, const double u[])
{
  PetscFunctionBeginUser;
  PetscCall(CoracleSetNodes(x->client, 2, v->nnodes, v->gid, v->x, u));
  PetscCall(CoracleSetSurface(x->client, v->nfacets, v->facet));
  PetscCall(CoracleSetVolume(x->client, v->nelements, v->element));
  x->before = x->told;
  x->told = (Told){.n = v->nnodes, .share = v->share, .revision = v->revision};
  PetscCall(PetscMalloc1((size_t)v->nnodes + 1, &x->told.gid));
  PetscCall(PetscArraycpy(x->told.gid, v->gid, (size_t)v->nnodes));
  PetscFunctionReturn(0);
}

/* Cracks have changed the mesh in this step.  The substeps have told the velocities of the nodes that were
 * there when it began; others get the mean over the step from here. */
static PetscErrorCode GiveCrackedMesh(Exchange *x, const SolidView *v)
{
  double *mean;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(2 * (size_t)v->nnodes, &mean));
  for (int k = 0; k < 2 * v->nnodes; k++) mean[k] = (v->x[k] - v->start[k]) / x->dt;
  PetscCall(GiveMesh(x, v, mean));
  if (x->away) PetscCall(CoracleSubstep(x->client, x->dt, mean));
  PetscCall(PetscFree(mean));
  PetscFunctionReturn(0);
}

PetscErrorCode ExchangeCreate(CoracleClient client, Solid solid, Exchange *x)
{
  SolidView v;
  InterfaceMotion seen;
  PetscFunctionBeginUser;
  *x = (Exchange){.client = client, .solid = solid};
  SolidGetView(solid, &v);
  SolidGetInterfaceMotion(solid, &seen);
  PetscCall(GiveMesh(x, &v, seen.u));
  PetscCall(CoracleSetInertia(client, seen.mobility, seen.acceleration));
  PetscCall(CoracleBindStateFunction(client, SaveOrRestore, solid));
  PetscCall(CoracleReady(client));
  PetscFunctionReturn(0);
}

/* --- the step
 * ----------------------------------------------------------------------------------------------- */

/* The mesh that both sides begin the step with: of a redone one that which the first try began with. */
static PetscErrorCode BeginTold(Exchange *x, CoracleAction action)
{
  PetscFunctionBeginUser;
  if (action == CORACLE_REDO && x->before.gid) {
    const Told failed = x->told;
    x->told = x->before;
    x->before = failed;
  }
  PetscCall(PetscFree(x->before.gid));
  PetscFunctionReturn(0);
}

PetscErrorCode ExchangeBegin(Exchange *x, double *dt, CoracleAction *action, const double **load)
{
  const double start = MPI_Wtime();
  SolidView v;
  double t;
  PetscFunctionBeginUser;
  PetscCall(CoracleBegin(x->client, &t, dt, action));
  PetscCall(BeginTold(x, *action));
  SolidGetView(x->solid, &v);
  x->dt = *dt;
  x->away = (PetscBool)(v.share != x->told.share);
  if (*action != CORACLE_STOP) PetscCall(CoracleGetForce(x->client, load));
  if (*action != CORACLE_STOP && x->away) {
    PetscCall(PetscRealloc(2 * (size_t)v.nnodes * sizeof *x->load + 1, &x->load));
    PetscCall(NodeDirectoryLoad(x->solid, x->told.n, x->told.gid, *load, x->load));
    *load = x->load;
  }
  x->waited += MPI_Wtime() - start;
  PetscFunctionReturn(0);
}

/* A step away from the share that was told is one substep to the coupler: it makes nothing of them but the
 * mean when it is given what is to be seen. */
PetscErrorCode ExchangeSubstep(Exchange *x, double h)
{
  SolidView v;
  PetscFunctionBeginUser;
  if (x->away) PetscFunctionReturn(0);
  SolidGetView(x->solid, &v);
  PetscCall(CoracleSubstep(x->client, h, v.v));
  PetscFunctionReturn(0);
}

/* The end of a step where the coupler knows the nodes. */
static PetscErrorCode SendAbroad(Exchange *x)
{
  const size_t n = (size_t)x->told.n;
  NodeMotion *motion;
  double *at, *mean, *seen, *mobility, *acceleration;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc6(n, &motion, 2 * n + 1, &at, 2 * n + 1, &mean, 2 * n + 1, &seen, n + 1, &mobility,
                         2 * n + 1, &acceleration));
  PetscCall(NodeDirectoryMotion(x->solid, x->told.n, x->told.gid, motion));
  for (size_t k = 0; k < 2 * n; k++) {
    at[k] = motion[k / 2].x[k % 2];
    seen[k] = motion[k / 2].seen[k % 2];
    mean[k] = motion[k / 2].mean[k % 2];
    acceleration[k] = motion[k / 2].acceleration[k % 2];
    mobility[k / 2] = motion[k / 2].mobility;
  }
  if (x->away) PetscCall(CoracleSubstep(x->client, x->dt, mean));
  PetscCall(CoracleSetVelocity(x->client, seen));
  PetscCall(CoracleSetInertia(x->client, mobility, acceleration));
  PetscCall(CoracleEnd(x->client, at));
  PetscCall(PetscFree6(motion, at, mean, seen, mobility, acceleration));
  PetscFunctionReturn(0);
}

PetscErrorCode ExchangeMotion(Exchange *x)
{
  const double start = MPI_Wtime();
  SolidView v;
  InterfaceMotion seen;
  PetscFunctionBeginUser;
  SolidGetView(x->solid, &v);
  PetscCall(SolidUpdateInterfaceMotion(x->solid, &seen));
  if (v.revision != x->told.revision) PetscCall(GiveCrackedMesh(x, &v));
  if (v.share == x->told.share) {
    PetscCall(CoracleSetVelocity(x->client, seen.u));
    PetscCall(CoracleSetInertia(x->client, seen.mobility, seen.acceleration));
    PetscCall(CoracleEnd(x->client, v.x));
  } else {
    PetscCall(SendAbroad(x));
  }
  x->waited += MPI_Wtime() - start;
  PetscFunctionReturn(0);
}

PetscErrorCode ExchangeDestroy(Exchange *x)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(x->told.gid));
  PetscCall(PetscFree(x->before.gid));
  PetscCall(PetscFree(x->load));
  PetscFunctionReturn(0);
}
