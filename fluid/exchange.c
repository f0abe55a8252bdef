#include "fluid/exchange.h"
#include "common/supermesh/search.h"

struct Exchange_s {
  CoracleClient client; /* borrowed */
  Fluid fluid;          /* borrowed: that of the current step */
  Fluid exchanged;      /* borrowed: the one whose elements the coupler asks for */
  int n, capacity;
  int *element;                                          /* [n] the fluid's local elements near the solid */
  double *x;                                             /* [n][3][2] m */
  double *u_start, *u_star, *u_projected, *p, *rho, *mu; /* as in CoracleFlow */
  double *inside, *beside, *remainder; /* rho_inside, rho_beside, remainder; NULL: one fluid */
  CoracleCoupling *coupling;
  int coupling_capacity;
};

static PetscErrorCode FreeArrays(Exchange x)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree2(x->element, x->x));
  PetscCall(PetscFree3(x->inside, x->beside, x->remainder));
  PetscCall(PetscFree6(x->u_start, x->u_star, x->u_projected, x->p, x->rho, x->mu));
  PetscFunctionReturn(0);
}

static PetscErrorCode Reserve(Exchange x, int n)
{
  PetscFunctionBeginUser;
  if (n <= x->capacity) PetscFunctionReturn(0);
  const int c = x->capacity = n + n / 4;
  PetscCall(FreeArrays(x));
  PetscCall(PetscMalloc2(c, &x->element, 6 * c, &x->x));
  if (FluidPhases(x->fluid)) PetscCall(PetscMalloc3(c, &x->inside, c, &x->beside, 2 * c, &x->remainder));
  PetscCall(PetscMalloc6(6 * c, &x->u_start, 6 * c, &x->u_star, 6 * c, &x->u_projected, 6 * c, &x->p, c,
                         &x->rho, c, &x->mu));
  PetscFunctionReturn(0);
}

/* Density and viscosity of the fluid on the elements near the solid; of phases, the lightest fills the solid. */
static void CopyProperties(Exchange x, Fluid fluid)
{
  const double *rho = FluidDensity(fluid), *mu = FluidViscosity(fluid);
  for (int k = 0; k < x->n; k++) {
    x->rho[k] = rho[x->element[k]];
    x->mu[k] = mu[x->element[k]];
    if (FluidPhases(fluid))
      PhaseTransportBesideSolid(FluidPhases(fluid), x->element[k], &x->inside[k], &x->beside[k]);
  }
}

/* list[*n] of the elements that overlap one of the boxes. */
static PetscErrorCode ListElements(const Mesh *m, int nbox, const double box[], int *n, int list[])
{
  Search search;
  PetscFunctionBeginUser;
  PetscCheck(!SearchCreate(nbox, GeometryBoxes(box), &search), PETSC_COMM_SELF, PETSC_ERR_MEM,
             "no memory for %d boxes", nbox);
  *n = 0;
  for (int e = 0; e < m->ne; e++) {
    const int *hit;
    double x[3][2];
    MeshCorners(m, e, x);
    const GeometryBox around = GeometryBoxOf((const double(*)[2])x);
    if (SearchQuery(search, &around, &hit)) list[(*n)++] = e;
  }
  SearchDestroy(&search);
  PetscFunctionReturn(0);
}

/* CoracleRegionFunction */
static int ElementsInRegion(void *context, int nbox, const double box[], CoracleElements *elements)
{
  Exchange s = context;
  const Mesh *m = FluidMesh(s->exchanged);
  int n, *list;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(m->ne, &list));
  PetscCall(ListElements(m, nbox, box, &n, list));
  PetscCall(Reserve(s, n));
  s->n = n;
  PetscCall(PetscArraycpy(s->element, list, n));
  PetscCall(PetscFree(list));
  for (int k = 0; k < n; k++) MeshCorners(m, s->element[k], (double(*)[2])(s->x + 6 * k));
  CopyProperties(s, s->exchanged);
  *elements = (CoracleElements){n, s->x, s->rho, s->mu, s->inside, s->beside};
  PetscFunctionReturn(0);
}

static int SaveOrRestore(void *context, int save)
{
  Exchange s = context;
  return save ? FluidSaveState(s->fluid) : FluidRestoreState(s->fluid);
}

PetscErrorCode ExchangeCreate(CoracleClient client, Fluid fluid, Exchange *exchange)
{
  const Mesh *m = FluidMesh(fluid);
  Exchange x;
  PetscFunctionBeginUser;
  PetscCall(PetscNew(&x));
  x->client = client;
  x->fluid = x->exchanged = fluid;
  PetscCall(CoracleSetRegion(client, m->dim, m->lower, m->upper, ElementsInRegion, x));
  PetscCall(CoracleBindStateFunction(client, SaveOrRestore, x));
  PetscCall(CoracleProposeStep(client, FluidTimeStep(fluid)));
  PetscCall(CoracleReady(client));
  *exchange = x;
  PetscFunctionReturn(0);
}

PetscErrorCode ExchangeReceiveCoupling(Exchange x)
{
  const CoracleCoupling *coupling;
  int n;
  PetscFunctionBeginUser;
  PetscCall(CoracleGetCoupling(x->client, &n, &coupling));
  if (n > x->coupling_capacity) {
    x->coupling_capacity = n + n / 4;
    PetscCall(PetscFree(x->coupling));
    PetscCall(PetscMalloc1(x->coupling_capacity, &x->coupling));
  }
  for (int k = 0; k < n; k++) {
    x->coupling[k] = coupling[k];
    x->coupling[k].element = x->element[coupling[k].element];
  }
  PetscCall(FluidSetCoupling(x->fluid, n, x->coupling));
  PetscFunctionReturn(0);
}

/* The flow of the current step on the elements near the solid. */
static PetscErrorCode SetFlow(Exchange x)
{
  const int *node = FluidPressureSpace(x->fluid)->node;
  const double *u_star = FluidVelocityStar(x->fluid), *u_projected = FluidVelocityProjected(x->fluid);
  const PetscBool needs_pressure = CoracleNeedsPressure(x->client) ? PETSC_TRUE : PETSC_FALSE;
  const CoracleFlow flow = {x->u_start,  x->u_star, x->u_projected, needs_pressure ? x->p : NULL,
                            x->rho,      x->mu,     x->inside,      x->beside,
                            x->remainder};
  PetscFunctionBeginUser;
  for (int k = 0; k < x->n; k++) {
    if (x->remainder)
      PetscCall(PetscArraycpy(x->remainder + 2 * k, FluidRemainder(x->fluid) + 2 * x->element[k], 2));
    FluidStartVelocity(x->fluid, x->element[k], x->u_start + 6 * k);
    PetscCall(PetscArraycpy(x->u_star + 6 * k, u_star + 6 * x->element[k], 6));
    PetscCall(PetscArraycpy(x->u_projected + 6 * k, u_projected + 6 * x->element[k], 6));
  }
  if (needs_pressure) {
    const double *p = FluidPressure(x->fluid);
    for (int k = 0; k < x->n; k++)
      for (int i = 0; i < 6; i++) x->p[6 * k + i] = p[node[6 * x->element[k] + i]];
  }
  CopyProperties(x, x->fluid);
  PetscCall(CoracleSetFlow(x->client, &flow));
  PetscFunctionReturn(0);
}

PetscErrorCode ExchangeReject(Exchange x, const char *why)
{
  PetscFunctionBeginUser;
  PetscCall(CoracleRejectStep(x->client, why));
  PetscCall(CoracleEnd(x->client, NULL));
  PetscFunctionReturn(0);
}

PetscErrorCode ExchangeFlow(Exchange x, Fluid next, PetscBool *accepted, const CoracleCorrection **correction)
{
  int n;
  PetscFunctionBeginUser;
  PetscCall(SetFlow(x));
  PetscCall(CoracleProposeStep(x->client, FluidTimeStep(x->fluid)));
  if (next) PetscCall(CoracleElementsChanged(x->client));
  if (next) x->exchanged = next;
  PetscCall(CoracleEnd(x->client, NULL));
  *accepted = CoracleStepAccepted(x->client) ? PETSC_TRUE : PETSC_FALSE;
  if (*accepted)
    x->fluid = x->exchanged;
  else
    x->exchanged = x->fluid;
  PetscCall(CoracleGetCorrection(x->client, &n, correction));
  PetscFunctionReturn(0);
}

PetscErrorCode ExchangeDestroy(Exchange *x)
{
  PetscFunctionBeginUser;
  if (!*x) PetscFunctionReturn(0);
  PetscCall(FreeArrays(*x));
  PetscCall(PetscFree((*x)->coupling));
  PetscCall(PetscFree(*x));
  PetscFunctionReturn(0);
}
