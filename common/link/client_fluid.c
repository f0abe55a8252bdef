/* The fluid's end: its elements near the solid, the flow on them, and what the solid does to them. */
#include "common/link/client_impl.h"
#include <math.h>
#include <string.h>

enum { NV = DIM + 1, NP2 = 6 };

int CoracleSetRegion(CoracleClient c, int dim, const double lower[], const double upper[],
                     CoracleRegionFunction region, void *context)
{
  ClientFluid *f = &c->fluid;
  ClientExpect(c, "CoracleSetRegion", ROLE_FLUID, STAGE_SETUP, STAGE_SETUP);
  if (dim != DIM) ParticipantFail(c->p, "CoracleSetRegion: dim is %d, only %d is there yet", dim, DIM);
  if (!region) ClientMisuse(c, "CoracleSetRegion", "there must be a region function");
  MessageCheckFinite(c->p, "lower corner of the domain", "corner", 1, DIM, lower);
  MessageCheckFinite(c->p, "upper corner of the domain", "corner", 1, DIM, upper);
  memcpy(f->lower, lower, sizeof f->lower);
  memcpy(f->upper, upper, sizeof f->upper);
  f->region = region;
  f->context = context;
  return 0;
}

int CoracleElementsChanged(CoracleClient c)
{
  ClientExpect(c, "CoracleElementsChanged", ROLE_FLUID, STAGE_STEP, STAGE_BETWEEN);
  c->fluid.changed = true;
  return 0;
}

int CoracleProposeStep(CoracleClient c, double dt)
{
  ClientExpect(c, "CoracleProposeStep", ROLE_FLUID, c->stage, c->stage);
  if (!(dt > 0.0)) ParticipantFail(c->p, "proposes a time step of %g s after step %d", dt, c->p->step);
  c->fluid.proposed = dt;
  return 0;
}

/* --- elements ------------------------------------------------------------------------------------------- */

static void CheckDensity(CoracleClient c, int n, const double rho[])
{
  for (int e = 0; e < n; e++)
    if (!(rho[e] > 0.0))
      ParticipantFail(c->p, "density is %g at element %d in step %d", rho[e], e, c->p->step);
}

static void AnswerElements(CoracleClient c, int nbox)
{
  ClientFluid *f = &c->fluid;
  const double *box = MessageTake(c->p, &c->in, (size_t)nbox * 2 * DIM * sizeof(double)), *x = NULL,
               *rho = NULL;
  if (f->region(f->context, nbox, box, &f->n, &x, &rho) || f->n < 0)
    ParticipantFail(c->p, "the region function failed in step %d", c->p->step);
  MessageCheckFinite(c->p, "vertices", "element", (size_t)f->n, NV * DIM, x);
  MessageCheckFinite(c->p, "density", "element", (size_t)f->n, 1, rho);
  CheckDensity(c, f->n, rho);
  MessageHeader *h = MessageStart(&c->out, KIND_ELEMENTS, c->p->step);
  h->count[0] = f->n;
  h->dt = f->proposed;
  h->flag = ClientFlags(c);
  MessageAdd(&c->out, f->lower, sizeof f->lower);
  MessageAdd(&c->out, f->upper, sizeof f->upper);
  MessageAdd(&c->out, x, (size_t)f->n * NV * DIM * sizeof *x);
  MessageAdd(&c->out, rho, (size_t)f->n * sizeof *rho);
  ClientSend(c);
  f->changed = false;
}

/* --- coupling ------------------------------------------------------------------------------------------- */

static void TakeCoupling(CoracleClient c, const MessageHeader *h)
{
  ClientFluid *f = &c->fluid;
  size_t bytes = (size_t)h->count[0] * sizeof(CoracleCorrection);
  f->ncorrection = (int)h->count[0];
  memcpy(BufferResize(&f->correction, bytes), MessageTake(c->p, &c->in, bytes), bytes);
  bytes = (size_t)h->count[1] * sizeof(CoracleCoupling);
  f->ncoupling = (int)h->count[1];
  memcpy(BufferResize(&f->coupling, bytes), MessageTake(c->p, &c->in, bytes), bytes);
  ClientTakePath(c, h);
  ClientTakeStep(c, h);
}

/* The coupler may ask for elements any number of times before it sends the coupling. */
static void WaitForCoupling(CoracleClient c)
{
  for (;;) {
    const MessageHeader *h = MessageReceive(c->p, &c->in, KIND_COUPLING, KIND_ASK, c->p->step);
    if (h->kind == KIND_COUPLING) {
      TakeCoupling(c, h);
      return;
    }
    AnswerElements(c, (int)h->count[0]);
  }
}

void FluidReady(CoracleClient c)
{
  if (!c->fluid.region) ClientMisuse(c, "CoracleReady", "CoracleSetRegion comes first");
  WaitForCoupling(c);
}

int CoracleGetCoupling(CoracleClient c, int *n, const CoracleCoupling **coupling)
{
  ClientExpect(c, "CoracleGetCoupling", ROLE_FLUID, STAGE_BETWEEN, STAGE_STEP);
  *n = c->fluid.ncoupling;
  *coupling = (const CoracleCoupling *)(const void *)c->fluid.coupling.data;
  return 0;
}

int CoracleStepAccepted(CoracleClient c)
{
  ClientExpect(c, "CoracleStands", ROLE_FLUID, STAGE_BETWEEN, STAGE_BETWEEN);
  return c->action != CORACLE_REDO;
}

int CoracleGetCorrection(CoracleClient c, int *n, const CoracleCorrection **correction)
{
  ClientExpect(c, "CoracleGetCorrection", ROLE_FLUID, STAGE_BETWEEN, STAGE_BETWEEN);
  *n = c->fluid.ncorrection;
  *correction = (const CoracleCorrection *)(const void *)c->fluid.correction.data;
  return 0;
}

/* --- flow ----------------------------------------------------------------------------------------------- */

static void AddField(CoracleClient c, const char *field, int per, const double array[])
{
  MessageCheckFinite(c->p, field, "element", (size_t)c->fluid.n, per, array);
  MessageAdd(&c->out, array, (size_t)c->fluid.n * (size_t)per * sizeof *array);
}

int CoracleSetFlow(CoracleClient c, const double u_star[], const double u_plus[], const double p[],
                   const double mu[])
{
  ClientExpect(c, "CoracleSetFlow", ROLE_FLUID, STAGE_STEP, STAGE_STEP);
  MessageStart(&c->out, KIND_FLOW, c->p->step)->count[0] = c->fluid.n;
  AddField(c, "velocity before the pressure correction", DIM * NV, u_star);
  AddField(c, "velocity", DIM * NV, u_plus);
  AddField(c, "pressure", NP2, p);
  AddField(c, "viscosity", 1, mu);
  c->fluid.flow_set = true;
  return 0;
}

void FluidEnd(CoracleClient c)
{
  MessageHeader *h = (MessageHeader *)(void *)c->out.buffer.data;
  if (!c->fluid.flow_set) ClientMisuse(c, "CoracleEnd", "CoracleSetFlow comes first, in every step");
  h->flag = ClientFlags(c) | (c->fluid.changed ? FLAG_CHANGED : 0);
  h->dt = c->fluid.proposed;
  c->fluid.flow_set = false;
  ClientSend(c);
  WaitForCoupling(c);
  if (c->action == CORACLE_REDO) c->fluid.changed = false;
}

void FluidFree(CoracleClient c)
{
  BufferFree(&c->fluid.coupling);
  BufferFree(&c->fluid.correction);
}
