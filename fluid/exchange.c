#include "fluid/exchange.h"

struct Exchange_s {
  CoracleClient client; /* borrowed */
  Fluid fluid;          /* borrowed: that of the step in hand, and the one whose elements are given */
  Fluid exchanged;
  ExchangeFirst first; /* until it has been called */
  void *context;
  int n, capacity;
  int *element;    /* [n] the fluid's local elements near the solid */
  double *x, *rho; /* [n][3][2], [n] */
  double *u_star, *u_plus, *p, *mu;
  CoracleCoupling *coupling;
  int coupling_capacity;
};

static PetscErrorCode Reserve(Exchange x, int n)
{
  PetscFunctionBeginUser;
  if (n <= x->capacity) PetscFunctionReturn(0);
  x->capacity = n + n / 4;
  PetscCall(PetscFree(x->element));
  PetscCall(PetscFree6(x->x, x->rho, x->u_star, x->u_plus, x->p, x->mu));
  PetscCall(PetscMalloc1(x->capacity, &x->element));
  PetscCall(PetscMalloc6(6 * x->capacity, &x->x, x->capacity, &x->rho, 6 * x->capacity, &x->u_star,
                         6 * x->capacity, &x->u_plus, 6 * x->capacity, &x->p, x->capacity, &x->mu));
  PetscFunctionReturn(0);
}

static PetscBool InAnyBox(const Mesh *m, int e, int nbox, const double box[])
{
  double lower[2] = {HUGE_VAL, HUGE_VAL}, upper[2] = {-HUGE_VAL, -HUGE_VAL};
  for (int i = 0; i < 3; i++)
    for (int c = 0; c < 2; c++) {
      const double v = m->x[2 * m->vertex[3 * e + i] + c];
      lower[c] = fmin(lower[c], v);
      upper[c] = fmax(upper[c], v);
    }
  for (int b = 0; b < nbox; b++) {
    const double *k = box + 4 * b;
    if (lower[0] <= k[2] && upper[0] >= k[0] && lower[1] <= k[3] && upper[1] >= k[1]) return PETSC_TRUE;
  }
  return PETSC_FALSE;
}

/* CoracleRegionFunction */
static int ElementsInRegion(void *context, int nbox, const double box[], int *n, const double **x,
                            const double **rho)
{
  Exchange s = context;
  const ExchangeFirst first = s->first;
  int count = 0;
  s->first = NULL;
  if (first && first(s->context, nbox, box, &s->exchanged)) return 1;
  const Mesh *m = FluidMesh(s->exchanged);
  for (int e = 0; e < m->ne; e++) count += InAnyBox(m, e, nbox, box);
  if (Reserve(s, count)) return 1;
  s->n = 0;
  for (int e = 0; e < m->ne; e++) {
    if (!InAnyBox(m, e, nbox, box)) continue;
    for (int i = 0; i < 3; i++)
      for (int c = 0; c < 2; c++) s->x[6 * s->n + 2 * i + c] = m->x[2 * m->vertex[3 * e + i] + c];
    s->rho[s->n] = FluidDensity(s->exchanged)[e];
    s->element[s->n++] = e;
  }
  *n = s->n;
  *x = s->x;
  *rho = s->rho;
  return 0;
}

static int SaveOrRestore(void *context, int save)
{
  Exchange s = context;
  return save ? FluidSaveState(s->fluid) : FluidRestoreState(s->fluid);
}

PetscErrorCode ExchangeCreate(CoracleClient client, Fluid fluid, ExchangeFirst first, void *context,
                              Exchange *exchange)
{
  const Mesh *m = FluidMesh(fluid);
  Exchange x;
  PetscFunctionBeginUser;
  PetscCall(PetscNew(&x));
  x->client = client;
  x->fluid = x->exchanged = fluid;
  x->first = first;
  x->context = context;
  PetscCall(CoracleSetRegion(client, m->dim, m->lower, m->upper, ElementsInRegion, x));
  PetscCall(CoracleBindStateFunction(client, SaveOrRestore, x));
  PetscCall(CoracleProposeStep(client, FluidTimeStep(fluid)));
  PetscCall(CoracleReady(client));
  x->fluid = x->exchanged;
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

PetscErrorCode ExchangeFlow(Exchange x, Fluid next, PetscBool *accepted, const CoracleCorrection **correction)
{
  const Mesh *m = FluidMesh(x->fluid);
  const double *u_star = FluidVelocityStar(x->fluid), *u_plus = FluidVelocityProjected(x->fluid);
  const double *p = FluidPressure(x->fluid), *mu = FluidViscosity(x->fluid);
  int n;
  PetscFunctionBeginUser;
  for (int k = 0; k < x->n; k++) {
    const int e = x->element[k];
    PetscCall(PetscArraycpy(x->u_star + 6 * k, u_star + 6 * e, 6));
    PetscCall(PetscArraycpy(x->u_plus + 6 * k, u_plus + 6 * e, 6));
    for (int i = 0; i < 6; i++) x->p[6 * k + i] = p[m->p2[6 * e + i]];
    x->mu[k] = mu[e];
  }
  PetscCall(CoracleSetFlow(x->client, x->u_star, x->u_plus, x->p, x->mu));
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
  PetscCall(PetscFree((*x)->element));
  PetscCall(PetscFree6((*x)->x, (*x)->rho, (*x)->u_star, (*x)->u_plus, (*x)->p, (*x)->mu));
  PetscCall(PetscFree((*x)->coupling));
  PetscCall(PetscFree(*x));
  PetscFunctionReturn(0);
}
