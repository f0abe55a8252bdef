/* The fluid's end: its elements near the solid, the flow on them, and what the solid does to them. */
#include "common/link/client_impl.h"
#include <math.h>
#include <string.h>

int CoracleSetRegion(CoracleClient c, int dim, const double lower[], const double upper[],
                     CoracleRegionFunction region, void *context)
{
  ClientFluid *f = &c->fluid;
  ClientExpect(c, "CoracleSetRegion", ROLE_FLUID, STAGE_SETUP, STAGE_SETUP);
  if (dim != DIM) ParticipantFail(c->p, "CoracleSetRegion: dim is %d, only %d is there yet", dim, DIM);
  if (!region) ClientMisuse(c, "CoracleSetRegion", "there must be a region function");
  memcpy(f->domain.lower, lower, sizeof f->domain.lower);
  memcpy(f->domain.upper, upper, sizeof f->domain.upper);
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
  ClientMustBe(c, "CoracleProposeStep");
  ClientExpect(c, "CoracleProposeStep", ROLE_FLUID, c->stage, c->stage);
  if (!(dt > 0.0)) ParticipantFail(c->p, "proposes a time step of %g s after step %d", dt, c->p->step);
  c->fluid.proposed = dt;
  return 0;
}

/* --- elements ------------------------------------------------------------------------------------------- */

/* Takes the boxes of an ASK. */
static void TakeBoxes(CoracleClient c, const MessageHeader *h)
{
  c->fluid.nbox = (int)h->count[0];
  c->fluid.needs_pressure = h->flag & FLAG_PRESSURE;
  c->fluid.asked = true;
  c->fluid.box = MessageTake(c->p, &c->in, (size_t)c->fluid.nbox * 2 * DIM * sizeof(double));
}

int CoracleGetRegion(CoracleClient c, int *nbox, const double **box)
{
  ClientFluid *f = &c->fluid;
  ClientExpect(c, "CoracleGetRegion", ROLE_FLUID, STAGE_SETUP, STAGE_SETUP);
  if (!f->asked) TakeBoxes(c, MessageReceive(c->p, &c->in, KIND_ASK, KIND_ASK, c->p->step));
  *nbox = f->nbox;
  *box = f->box;
  return 0;
}

static void AnswerElements(CoracleClient c)
{
  ClientFluid *f = &c->fluid;
  CoracleElements elements = {0};
  if (f->region(f->context, f->nbox, f->box, &elements) || elements.n < 0)
    ParticipantFail(c->p, "the region function failed in step %d", c->p->step);
  if (!elements.rho_inside) elements.rho_inside = elements.rho;
  if (!elements.rho_beside) elements.rho_beside = elements.rho;
  MessageHeader *h = MessageStart(&c->out, KIND_ELEMENTS, c->p->step);
  h->count[0] = f->n = elements.n;
  h->dt = f->proposed;
  h->flag = ClientFlags(c);
  FieldsPack(c->p, &c->out, &FIELDS_DOMAIN, 1, &f->domain);
  FieldsPack(c->p, &c->out, &FIELDS_ELEMENTS, (size_t)f->n, &elements);
  ClientSend(c);
  f->changed = f->asked = false;
}

/* --- coupling ------------------------------------------------------------------------------------------- */

static void TakeStep(CoracleClient c, const MessageHeader *h)
{
  ClientFluid *f = &c->fluid;
  f->ncorrection = (int)h->count[0];
  FieldsTake(c->p, &c->in, &FIELDS_CORRECTION, (size_t)f->ncorrection, &f->correction);
  f->ngauges = (int)h->count[3];
  FieldsTake(c->p, &c->in, &FIELDS_GAUGES, (size_t)f->ngauges, &f->gauge);
  ClientTakePath(c, h);
  ClientTakeStep(c, h);
  f->awaits_coupling = c->action != CORACLE_STOP;
}

/* The coupler may ask for elements any number of times before it announces the step. */
static void WaitForStep(CoracleClient c)
{
  for (;;) {
    if (c->fluid.asked) AnswerElements(c);
    const MessageHeader *h = MessageReceive(c->p, &c->in, KIND_STEP, KIND_ASK, c->p->step);
    if (h->kind == KIND_STEP) {
      TakeStep(c, h);
      return;
    }
    TakeBoxes(c, h);
  }
}

/* The coupler computes the coupling while the fluid ends its step, and sends it by itself. */
static void WaitForCoupling(CoracleClient c)
{
  ClientFluid *f = &c->fluid;
  if (!f->awaits_coupling) return;
  f->ncoupling = (int)MessageReceive(c->p, &c->in, KIND_COUPLING, KIND_COUPLING, c->p->step)->count[0];
  FieldsTake(c->p, &c->in, &FIELDS_COUPLING, (size_t)f->ncoupling, &f->coupling);
  f->awaits_coupling = false;
}

void FluidReady(CoracleClient c)
{
  if (!c->fluid.region) ClientMisuse(c, "CoracleReady", "CoracleSetRegion comes first");
  WaitForStep(c);
}

int CoracleNeedsPressure(CoracleClient c)
{
  ClientMustBe(c, "CoracleNeedsPressure");
  const Stage stage = c->stage == STAGE_SETUP ? STAGE_BETWEEN : c->stage;
  ClientExpect(c, "CoracleNeedsPressure", ROLE_FLUID, stage, STAGE_STEP);
  return c->fluid.needs_pressure;
}

int CoracleGetCoupling(CoracleClient c, int *n, const CoracleCoupling **coupling)
{
  ClientExpect(c, "CoracleGetCoupling", ROLE_FLUID, STAGE_STEP, STAGE_STEP);
  WaitForCoupling(c);
  *n = c->fluid.ncoupling;
  *coupling = (const CoracleCoupling *)(const void *)c->fluid.coupling.data;
  return 0;
}

int CoracleStepAccepted(CoracleClient c)
{
  ClientExpect(c, "CoracleStepAccepted", ROLE_FLUID, STAGE_BETWEEN, STAGE_BETWEEN);
  return c->action != CORACLE_REDO;
}

int CoracleGetCorrection(CoracleClient c, int *n, const CoracleCorrection **correction)
{
  ClientExpect(c, "CoracleGetCorrection", ROLE_FLUID, STAGE_BETWEEN, STAGE_BETWEEN);
  *n = c->fluid.ncorrection;
  *correction = (const CoracleCorrection *)(const void *)c->fluid.correction.data;
  return 0;
}

int CoracleGetGauges(CoracleClient c, int *n, const CoracleGauge **gauge)
{
  ClientExpect(c, "CoracleGetGauges", ROLE_FLUID, STAGE_BETWEEN, STAGE_STEP);
  *n = c->fluid.ngauges;
  *gauge = (const CoracleGauge *)(const void *)c->fluid.gauge.data;
  return 0;
}

/* --- flow ----------------------------------------------------------------------------------------------- */

static const double *Zeros(ClientFluid *f, size_t n)
{
  BufferResize(&f->zeros, n * sizeof(double));
  memset(f->zeros.data, 0, n * sizeof(double));
  return (const double *)(void *)f->zeros.data;
}

int CoracleSetFlow(CoracleClient c, const CoracleFlow *flow)
{
  ClientFluid *f = &c->fluid;
  ClientExpect(c, "CoracleSetFlow", ROLE_FLUID, STAGE_STEP, STAGE_STEP);
  if (!flow) ClientMisuse(c, "CoracleSetFlow", "the flow is NULL");
  CoracleFlow all = *flow;
  MessageHeader *h = MessageStart(&c->out, KIND_FLOW, c->p->step);
  h->count[0] = f->n;
  h->flag = f->needs_pressure ? FLAG_PRESSURE : 0;
  if (f->needs_pressure && f->n && !all.p)
    ParticipantFail(
        c->p,
        "the pressure of %d elements is missing in step %d: the coupling mode, the solid's load or "
        "solids that may touch each other or walls need it "
        "(CoracleNeedsPressure)",
        f->n, c->p->step);
  if (!all.rho_inside) all.rho_inside = all.rho;
  if (!all.rho_beside) all.rho_beside = all.rho;
  if (!all.remainder) all.remainder = Zeros(f, (size_t)f->n * DIM);
  FieldsPack(c->p, &c->out, &FIELDS_FLOW, (size_t)f->n, &all);
  f->flow_set = true;
  return 0;
}

void FluidEnd(CoracleClient c)
{
  const bool rejects = c->rejection.size > 0;
  if (!rejects && !c->fluid.flow_set)
    ClientMisuse(c, "CoracleEnd", "CoracleSetFlow comes first, in every step");
  MessageHeader *h = rejects ? ClientReject(c, KIND_FLOW) : MessageHeaderOf(&c->out);
  h->flag |= ClientFlags(c) | (c->fluid.changed ? FLAG_CHANGED : 0);
  h->dt = c->fluid.proposed;
  c->fluid.flow_set = false;
  WaitForCoupling(c);
  ClientSend(c);
  WaitForStep(c);
  if (c->action == CORACLE_REDO) c->fluid.changed = false;
}

void FluidFree(CoracleClient c)
{
  BufferFree(&c->fluid.coupling);
  BufferFree(&c->fluid.correction);
  BufferFree(&c->fluid.gauge);
  BufferFree(&c->fluid.zeros);
}
