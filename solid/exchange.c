#include "solid/exchange.h"

static int SaveOrRestore(void *solid, int save)
{
  return SolidState(solid, save);
}

/* --- the mesh ----------------------------------------------------------------------------------------- */

/* The directory's mesh with nodes at `at`, which have moved with u so far; it is registered then. */
static PetscErrorCode GiveMesh(Exchange *x, NodeDirectory directory, const double at[], const double u[])
{
  const RegisteredMesh m = NodeDirectoryMesh(directory);
  PetscFunctionBeginUser;
  PetscCall(CoracleSetNodes(x->client, 2, m.nnodes, m.gid, at, u));
  PetscCall(CoracleSetSurface(x->client, m.nfacets, m.facet));
  PetscCall(CoracleSetVolume(x->client, m.nelements, m.element));
  x->before = x->registered;
  x->registered = directory;
  PetscFunctionReturn(0);
}

PetscErrorCode ExchangeCreate(CoracleClient client, Solid solid, Exchange *x)
{
  SolidView v;
  InterfaceMotion interface;
  NodeDirectory directory;
  PetscFunctionBeginUser;
  *x = (Exchange){.client = client, .solid = solid};
  SolidGetView(solid, &v);
  if (SolidGetStats(solid)->total == 0)
    PetscCall(SolidUpdateInterfaceMotion(solid, &interface));
  else
    SolidGetInterfaceMotion(solid, &interface);
  PetscCall(NodeDirectoryCreate(solid, &directory));
  PetscCall(GiveMesh(x, directory, v.x, interface.u));
  PetscCall(CoracleSetInertia(client, interface.mobility, interface.acceleration));
  PetscCall(CoracleBindStateFunction(client, SaveOrRestore, solid));
  PetscCall(CoracleReady(client));
  PetscFunctionReturn(0);
}

/* --- the step ----------------------------------------------------------------------------------------- */

/* The mesh that both sides begin the step with: of a redone one that which the first try began with. */
static PetscErrorCode BeginRegistered(Exchange *x, CoracleAction action)
{
  PetscFunctionBeginUser;
  if (action == CORACLE_REDO && x->before) {
    const NodeDirectory failed = x->registered;
    x->registered = x->before;
    x->before = failed;
  }
  PetscCall(NodeDirectoryDestroy(&x->before));
  PetscFunctionReturn(0);
}

/* *value[nnodes][ncomp], unless it is NULL: of the registered nodes, then of those present, which own keeps. */
static PetscErrorCode OnPresentNodes(Exchange *x, int nnodes, int ncomp, double **own, const double **value)
{
  PetscFunctionBeginUser;
  if (!*value || NodeDirectoryIsPresent(x->registered)) PetscFunctionReturn(0);
  PetscCall(PetscRealloc((size_t)ncomp * (size_t)nnodes * sizeof **own + 1, own));
  PetscCall(NodeDirectoryLoad(x->registered, ncomp, *value, *own));
  *value = *own;
  PetscFunctionReturn(0);
}

PetscErrorCode ExchangeBegin(Exchange *x, double *dt, CoracleAction *action, const double **load)
{
  const double start = MPI_Wtime();
  SolidView v;
  double t;
  PetscFunctionBeginUser;
  PetscCall(CoracleBegin(x->client, &t, dt, action));
  PetscCall(BeginRegistered(x, *action));
  SolidGetView(x->solid, &v);
  x->dt = *dt;
  if (*action != CORACLE_STOP) {
    const double *film, *resistance;
    PetscCall(CoracleGetForce(x->client, load));
    PetscCall(CoracleGetFilm(x->client, &film, &resistance));
    PetscCall(OnPresentNodes(x, v.nnodes, 2, &x->load, load));
    PetscCall(OnPresentNodes(x, v.nnodes, 2, &x->film_load, &film));
    PetscCall(OnPresentNodes(x, v.nnodes, 4, &x->film_resistance, &resistance));
    SolidSetFilm(x->solid, film, resistance);
  }
  x->waited += MPI_Wtime() - start;
  PetscFunctionReturn(0);
}

/* What the coupler receives of the nodes that it knows, [n][2], mobility [n]. */
typedef struct {
  const double *start, *mean, *x, *u, *mobility, *acceleration;
} Motion;

/* The end of a step: the coupler takes the mean of the substeps' velocities alone where the interface velocity is set, so
 * that to the link the step is one substep.  Where cracks have changed the mesh it is that of `directory`, and nodes that
 * they have made begin the step, too, at its start. */
static PetscErrorCode Send(Exchange *x, NodeDirectory directory, const Motion *m)
{
  PetscFunctionBeginUser;
  if (directory) PetscCall(GiveMesh(x, directory, m->start, m->mean));
  PetscCall(CoracleSubstep(x->client, x->dt, m->mean));
  PetscCall(CoracleSetVelocity(x->client, m->u));
  PetscCall(CoracleSetInertia(x->client, m->mobility, m->acceleration));
  PetscCall(CoracleEnd(x->client, m->x));
  PetscFunctionReturn(0);
}

static PetscErrorCode SendPresent(Exchange *x)
{
  NodeDirectory directory = NULL;
  InterfaceMotion interface;
  SolidView v;
  double *mean;
  PetscFunctionBeginUser;
  SolidGetView(x->solid, &v);
  SolidGetInterfaceMotion(x->solid, &interface);
  PetscCall(PetscMalloc1(2 * (size_t)v.nnodes + 1, &mean));
  for (int k = 0; k < 2 * v.nnodes; k++) mean[k] = (v.x[k] - v.start[k]) / x->dt;
  if (!NodeDirectoryIsComplete(x->registered)) PetscCall(NodeDirectoryCreate(x->solid, &directory));
  PetscCall(Send(x, directory,
                 &(Motion){v.start, mean, v.x, interface.u, interface.mobility, interface.acceleration}));
  PetscCall(PetscFree(mean));
  PetscFunctionReturn(0);
}

/* The same where the coupler knows the nodes of another partition. */
static PetscErrorCode SendRemote(Exchange *x)
{
  const PetscBool cracked = (PetscBool)!NodeDirectoryIsComplete(x->registered);
  NodeDirectory directory = x->registered;
  NodeMotion *motion;
  double *at, *start, *mean, *interface, *mobility, *acceleration;
  PetscFunctionBeginUser;
  if (cracked) PetscCall(NodeDirectoryRenew(x->registered, &directory));
  const size_t n = (size_t)NodeDirectoryMesh(directory).nnodes;
  PetscCall(PetscMalloc7(n, &motion, 2 * n + 1, &at, 2 * n + 1, &start, 2 * n + 1, &mean, 2 * n + 1,
                         &interface, n + 1, &mobility, 2 * n + 1, &acceleration));
  PetscCall(NodeDirectoryMotion(directory, motion));
  for (size_t k = 0; k < 2 * n; k++) {
    at[k] = motion[k / 2].x[k % 2];
    interface[k] = motion[k / 2].interface_velocity[k % 2];
    mean[k] = motion[k / 2].mean[k % 2];
    acceleration[k] = motion[k / 2].acceleration[k % 2];
    mobility[k / 2] = motion[k / 2].mobility;
    start[k] = at[k] - x->dt * mean[k];
  }
  PetscCall(
      Send(x, cracked ? directory : NULL, &(Motion){start, mean, at, interface, mobility, acceleration}));
  PetscCall(PetscFree7(motion, at, start, mean, interface, mobility, acceleration));
  PetscFunctionReturn(0);
}

PetscErrorCode ExchangeMotion(Exchange *x)
{
  const double start = MPI_Wtime();
  PetscFunctionBeginUser;
  PetscCall(NodeDirectoryIsPresent(x->registered) ? SendPresent(x) : SendRemote(x));
  x->waited += MPI_Wtime() - start;
  PetscFunctionReturn(0);
}

PetscErrorCode ExchangeReject(Exchange *x, const char *why)
{
  PetscFunctionBeginUser;
  PetscCall(CoracleRejectStep(x->client, why));
  PetscCall(CoracleEnd(x->client, NULL));
  PetscFunctionReturn(0);
}

PetscErrorCode ExchangeDestroy(Exchange *x)
{
  PetscFunctionBeginUser;
  PetscCall(NodeDirectoryDestroy(&x->registered));
  PetscCall(NodeDirectoryDestroy(&x->before));
  PetscCall(PetscFree(x->load));
  PetscCall(PetscFree(x->film_load));
  PetscCall(PetscFree(x->film_resistance));
  PetscFunctionReturn(0);
}
