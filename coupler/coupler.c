#include "coupler/coupler_impl.h"

PetscErrorCode CouplerCreate(MPI_Comm comm, const CouplerOptions *options, Coupler *coupler)
{
  Coupler c;

  PetscFunctionBeginUser;
  PetscCall(PetscNew(&c));
  c->comm = comm;
  c->options = *options;
  c->mode = CouplerModeGet(options->mode);
  PetscCall(ShellCreate(comm, options->thickness, &c->shell));
  PetscCall(OverlapCreate(comm, &c->overlap));
  *coupler = c;
  PetscFunctionReturn(0);
}

/* The old element that holds point p, or -1. */
static int Locate(const Overlap o, const double p[2])
{
  const GeometryBox box = {{p[0], p[1]}, {p[0], p[1]}};
  const int *hit, n = o->search ? SearchQuery(o->search, &box, &hit) : 0;
  for (int h = 0; h < n; h++) {
    double lambda[3];
    GeometryBarycentric((const double(*)[2])o->x[hit[h]], p, lambda);
    if (fmin(lambda[0], fmin(lambda[1], lambda[2])) >= -1e-12) return hit[h];
  }
  return -1;
}

/* Mean of what all ranks know, for elements that are new to the region. */
static PetscErrorCode MeanViscosity(Coupler c, double *mean)
{
  double sum[2] = {0.0, c->overlap->nelements};

  PetscFunctionBeginUser;
  for (int k = 0; k < c->overlap->nelements; k++) sum[0] += c->mu[k];
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sum, 2, MPI_DOUBLE, MPI_SUM, c->comm));
  *mean = sum[1] > 0.0 ? sum[0] / sum[1] : c->options.viscosity;
  PetscFunctionReturn(0);
}

PetscErrorCode CouplerSetElements(Coupler c, const FluidElements *elements)
{
  double mean, *mu;

  PetscFunctionBeginUser;
  PetscCall(MeanViscosity(c, &mean));
  PetscCall(PetscMalloc1(elements->n, &mu));
  for (int k = 0; k < elements->n; k++) {
    const double *x = &elements->x[6 * k];
    const double centre[2] = {(x[0] + x[2] + x[4]) / 3.0, (x[1] + x[3] + x[5]) / 3.0};
    const int old = Locate(c->overlap, centre);
    mu[k] = old >= 0 ? c->mu[old] : mean;
  }
  PetscCall(PetscFree(c->mu));
  c->mu = mu;
  PetscCall(OverlapSetElements(c->overlap, elements));
  PetscFunctionReturn(0);
}

static PetscErrorCode FreeStep(Coupler c)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree2(c->coefficient, c->coupling));
  PetscCall(PetscFree5(c->vertex, c->start_velocity, c->implicit_factor, c->node, c->force));
  PetscFunctionReturn(0);
}

static PetscErrorCode NewStep(Coupler c, const SolidState *solid)
{
  const Overlap o = c->overlap;
  const size_t nsources = (size_t)o->nsources, nnodes = (size_t)solid->nnodes;

  PetscFunctionBeginUser;
  PetscCall(FreeStep(c));
  PetscCall(PetscMalloc2(o->pairs.n, &c->coefficient, o->ncoupled, &c->coupling));
  PetscCall(PetscMalloc5(3 * nsources, &c->vertex, nsources, &c->start_velocity, nsources,
                         &c->implicit_factor, nnodes, &c->node, 2 * nnodes, &c->force));
  for (size_t t = 0; t < nsources; t++) c->implicit_factor[t] = 1.0;
  for (size_t t = 0; t < nsources; t++)
    PetscCall(PetscArraycpy(&c->start_velocity[t][0][0], &o->source[t].u[0][0], 6));
  PetscFunctionReturn(0);
}

PetscErrorCode CouplerBuild(Coupler c, const SolidState *solid, double dt, int *n,
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
  PetscCall(c->mode->coefficients(c, solid));
  WallTermAssemble(c->overlap, c->coefficient, c->implicit_factor, c->coupling);
  *n = c->overlap->ncoupled;
  *coupling = c->coupling;
  PetscFunctionReturn(0);
}

PetscErrorCode CouplerSetInterfaceVelocity(Coupler c, const double mobility[], const double u[], int *n,
                                           const CoracleCoupling **coupling)
{
  const Overlap o = c->overlap;
  double(*velocity)[3][2], (*node_mobility)[3];

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(o->nsources, &velocity, o->nsources, &node_mobility));
  PetscCall(OverlapNodesToSources(o, 2, u, &velocity[0][0][0]));
  PetscCall(OverlapNodesToSources(o, 1, mobility, &node_mobility[0][0]));
  for (int t = 0; t < o->nsources; t++)
    for (int i = 0; i < 3; i++)
      if (node_mobility[t][i] == 0.0) PetscCall(PetscArraycpy(o->source[t].u[i], velocity[t][i], 2));
  PetscCall(PetscFree2(velocity, node_mobility));
  c->us = u;
  WallTermAssemble(o, c->coefficient, c->implicit_factor, c->coupling);
  *n = o->ncoupled;
  *coupling = c->coupling;
  PetscFunctionReturn(0);
}

PetscErrorCode CouplerComputeForce(Coupler c, const FluidFlow *flow, const double **force,
                                   ForceTotals *totals)
{
  PetscFunctionBeginUser;
  c->flow = *flow;
  PetscCall(PetscArraycpy(c->mu, flow->mu, c->overlap->nelements));
  PetscCall(PetscArrayzero(c->vertex, 3 * (size_t)c->overlap->nsources));
  PetscCall(c->mode->force(c));
  for (int i = 0; i < c->nnodes; i++) {
    for (int d = 0; d < 2; d++) c->force[2 * i + d] = c->node[i].reaction[d] + c->node[i].other[d];
  }
  PetscCall(ForceSum(c->overlap, c->coupling, flow, c->nnodes, c->node, totals));
  *force = c->force;
  PetscFunctionReturn(0);
}

PetscErrorCode CouplerNoCorrection(Coupler c, const SolidState *moved)
{
  PetscFunctionBeginUser;
  PetscFunctionReturn(0);
}

PetscErrorCode CouplerConservativeForce(Coupler c)
{
  PetscFunctionBeginUser;
  ForceReaction(c->overlap, c->coefficient, c->implicit_factor, &c->flow, c->vertex);
  ForceInertia(c->overlap, c->dt, c->options.gravity, c->flow.u_plus,
               (const double(*)[3][2])c->start_velocity, c->vertex);
  PetscCall(ForceAssembleToOwners(c->overlap, c->vertex, c->nnodes, c->node));
  PetscFunctionReturn(0);
}

PetscErrorCode CouplerSolidCorrection(Coupler c, const SolidState *moved)
{
  double(*u)[3][2];

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(c->overlap->nsources, &u));
  PetscCall(OverlapNodesToSources(c->overlap, 2, moved->u, &u[0][0][0]));
  ForceCorrection(c->overlap, (const double(*)[3][2])u, c->flow.u_plus, c->correction);
  PetscCall(PetscFree(u));
  PetscFunctionReturn(0);
}

PetscErrorCode CouplerCorrect(Coupler c, const SolidState *moved, int *n,
                              const CoracleCorrection **correction)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(c->correction));
  PetscCall(PetscCalloc1(c->overlap->ncoupled, &c->correction));
  for (int e = 0; e < c->overlap->ncoupled; e++) c->correction[e].element = c->overlap->coupled_element[e];
  PetscCall(moved->changed ? CouplerNoCorrection(c, moved) : c->mode->correct(c, moved));
  *n = c->overlap->ncoupled;
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
  PetscCall(PetscFree((*coupler)->mu));
  PetscCall(PetscFree(*coupler));
  PetscFunctionReturn(0);
}
