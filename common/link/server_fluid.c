/* The coupler's end towards the fluid. */
#include "common/link/server_impl.h"
#include <math.h>
#include <string.h>

enum { DIM = CORACLE_DIM };

/* The smallest proposal of all fluid ranks. */
static void ReduceProposed(Server s, double mine)
{
  MPI_Allreduce(&mine, &s->proposed, 1, MPI_DOUBLE, MPI_MIN, s->p->app);
}

/* --- elements ------------------------------------------------------------------------------------------- */

int ServerNeedPressure(Server s)
{
  if (s->asked) ServerFail(s, "ServerNeedPressure comes before the first ServerAskElements");
  s->needs_pressure = true;
  return 0;
}

static void SendAsk(Server s, int nbox, const double box[])
{
  const FieldsBoxes boxes = {box};
  for (int i = 0; i < s->fluid.n; i++) {
    Message *m = &s->fluid.client[i].out;
    MessageHeader *h = MessageStart(m, KIND_ASK, s->fluid.step);
    h->count[0] = nbox;
    h->flag = s->needs_pressure ? FLAG_PRESSURE : 0;
    FieldsPack(s->p, m, &FIELDS_BOXES, (size_t)nbox, &boxes);
  }
  ClientListSend(s, &s->fluid);
}

/* One client's elements, at the end of the lists; returns the step that it proposes. */
static double ReceiveElements(Server s, ClientRank *client, FieldsDomain *domain)
{
  const MessageHeader *h = MessageReceive(s->p, &client->in, KIND_ELEMENTS, KIND_ELEMENTS, s->fluid.step);
  Buffer own = {0};
  ClientListFlags(s, ROLE_FLUID, client, h);
  FieldsTake(s->p, &client->in, &FIELDS_DOMAIN, 1, &own);
  const FieldsDomain *its = (const FieldsDomain *)(const void *)own.data;
  for (int d = 0; d < DIM; d++) {
    domain->lower[d] = fmin(domain->lower[d], its->lower[d]);
    domain->upper[d] = fmax(domain->upper[d], its->upper[d]);
  }
  BufferFree(&own);
  client->first = s->nelements;
  client->n = (int)h->count[0];
  s->nelements += client->n;
  FieldsAppend(s->p, &client->in, &FIELDS_ELEMENTS, (size_t)client->n, &s->elements);
  return h->dt;
}

static void ReduceDomain(Server s, const FieldsDomain *mine)
{
  MPI_Allreduce(mine->lower, s->domain.lower, DIM, MPI_DOUBLE, MPI_MIN, s->p->app);
  MPI_Allreduce(mine->upper, s->domain.upper, DIM, MPI_DOUBLE, MPI_MAX, s->p->app);
}

int ServerAskElements(Server s, int nbox, const double box[], ServerElements *elements)
{
  FieldsDomain domain;
  CoracleElements all;
  double proposed = HUGE_VAL;
  if (s->fluid.step > 0 && !s->owes_step)
    ServerFail(s, "ServerAskElements: the fluid answers only between its flow and its next step");
  SendAsk(s, nbox, box);
  s->nelements = 0;
  FieldListsClear(&s->elements);
  for (int d = 0; d < DIM; d++) domain.lower[d] = -(domain.upper[d] = -HUGE_VAL);
  for (int i = 0; i < s->fluid.n; i++)
    proposed = fmin(proposed, ReceiveElements(s, &s->fluid.client[i], &domain));
  ReduceProposed(s, proposed);
  ReduceDomain(s, &domain);
  s->asked = true;
  s->elements_changed = false;
  FieldsView(&FIELDS_ELEMENTS, &s->elements, 0, &all);
  *elements = (ServerElements){.n = s->nelements,
                               .x = all.x,
                               .rho = all.rho,
                               .mu = all.mu,
                               .rho_inside = all.rho_inside,
                               .rho_beside = all.rho_beside};
  memcpy(elements->lower, s->domain.lower, sizeof elements->lower);
  memcpy(elements->upper, s->domain.upper, sizeof elements->upper);
  return 0;
}

int ServerElementsChanged(Server s)
{
  return s->elements_changed;
}
double ServerProposedStep(Server s)
{
  return s->proposed;
}

/* --- flow ----------------------------------------------------------------------------------------------- */

static double ReceiveFlow(Server s, ClientRank *client, int *changed)
{
  const MessageHeader *h = MessageReceive(s->p, &client->in, KIND_FLOW, KIND_FLOW, s->fluid.step);
  ClientListFlags(s, ROLE_FLUID, client, h);
  if (ClientListRejects(s, ROLE_FLUID, client)) return HUGE_VAL;
  if (h->count[0] != client->n)
    ServerFail(s, "fluid rank %d has sent the flow on %lld elements instead of %d", client->in.rank,
               (long long)h->count[0], client->n);
  FieldsAppend(s->p, &client->in, &FIELDS_FLOW, (size_t)client->n, &s->flow);
  *changed |= h->flag & FLAG_CHANGED;
  return h->dt;
}

int ServerReceiveFlow(Server s, CoracleFlow *flow)
{
  double proposed = HUGE_VAL;
  int changed = 0;
  if (s->owes_step || s->owes_coupling)
    ServerFail(s, "ServerReceiveFlow: the fluid waits for ServerSendStep and ServerSendCoupling");
  FieldListsClear(&s->flow);
  BufferResize(&s->rejection, 0);
  for (int i = 0; i < s->fluid.n; i++)
    proposed = fmin(proposed, ReceiveFlow(s, &s->fluid.client[i], &changed));
  ServerAgree(s, &changed);
  s->owes_step = true;
  *flow = (CoracleFlow){0};
  if (s->rejection.size) return 0;
  ReduceProposed(s, proposed);
  s->elements_changed = changed;
  FieldsView(&FIELDS_FLOW, &s->flow, s->needs_pressure ? FLAG_PRESSURE : 0, flow);
  return 0;
}

/* --- coupling ------------------------------------------------------------------------------------------- */

static int *Ints(const Buffer *b)
{
  return (int *)(void *)b->data;
}

/* The corrections of one client, in the order of its coupling entries, with its own indices of that time. */
static void AddCorrections(Server s, int k, int n, const CoracleCorrection correction[], Buffer *scratch)
{
  ClientRank *client = &s->fluid.client[k];
  size_t mine = 0;
  BufferResize(scratch, 0);
  for (int i = 0; i < n; i++) {
    if (Ints(&s->owner)[i] != k) continue;
    CoracleCorrection *c = BufferExtend(scratch, sizeof *c);
    *c = correction[i];
    c->element = Ints(&client->coupled)[mine++];
  }
  FieldsPack(s->p, &client->out, &FIELDS_CORRECTION, mine, scratch->data);
}

static void AddCouplings(Server s, int k, int n, const CoracleCoupling coupling[], const int owner[],
                         Buffer *scratch)
{
  ClientRank *client = &s->fluid.client[k];
  size_t mine = 0;
  const bool all = s->fluid.n == 1; /* then they have the client's indices already */
  BufferResize(scratch, 0);
  BufferResize(&client->coupled, 0);
  for (int i = 0; i < n; i++) {
    if (owner[i] != k) continue;
    const int element = coupling[i].element - client->first;
    *(int *)BufferExtend(&client->coupled, sizeof element) = element;
    mine++;
    if (all) continue;
    CoracleCoupling *c = BufferExtend(scratch, sizeof *c);
    *c = coupling[i];
    c->element = element;
  }
  FieldsPack(s->p, &client->out, &FIELDS_COUPLING, mine, all ? (const void *)coupling : scratch->data);
}

int ServerSetGauges(Server s, int n, const CoracleGauge gauge[])
{
  const size_t bytes = (size_t)n * sizeof *gauge;
  BufferResize(&s->gauge, bytes);
  if (bytes) memcpy(s->gauge.data, gauge, bytes);
  return 0;
}

static void AddGauges(Server s, Message *m)
{
  const size_t n = s->gauge.size / sizeof(CoracleGauge);
  MessageHeaderOf(m)->count[3] = (int64_t)n;
  FieldsPack(s->p, m, &FIELDS_GAUGES, n, s->gauge.data);
}

static void CheckCouplings(Server s, int n, const CoracleCoupling coupling[])
{
  for (int i = 0; i < n; i++)
    if (coupling[i].element < 0 || coupling[i].element >= s->nelements)
      ServerFail(s, "coupling entry %d is of element %d of %d", i, coupling[i].element, s->nelements);
}

static void CheckCorrections(Server s, CoracleAction action, int n)
{
  if (action == CORACLE_REDO && n == 0) return;
  const int expected = s->owes_step ? (int)(s->owner.size / sizeof(int)) : 0;
  if (n != expected)
    ServerFail(s, "%d corrections after step %d, which had %d coupling entries", n, s->fluid.step, expected);
}

static int CountOwned(const int owner[], int n, int k)
{
  int count = 0;
  for (int i = 0; i < n; i++) count += owner[i] == k;
  return count;
}

int ServerSendStep(Server s, double t, double dt, CoracleAction action, int ncorrection,
                   const CoracleCorrection correction[])
{
  const int step = s->fluid.step; /* which the clients are in until they get this */
  Buffer scratch = {0};
  if (!s->asked) ServerFail(s, "ServerSendStep comes after the first ServerAskElements");
  CheckCorrections(s, action, ncorrection);
  ClientListStep(s, &s->fluid, action);
  for (int k = 0; k < s->fluid.n; k++) {
    MessageHeader *h = MessageStart(&s->fluid.client[k].out, KIND_STEP, step);
    h->action = action;
    h->t = t;
    h->dt = dt;
    h->count[0] = CountOwned(Ints(&s->owner), ncorrection, k);
    AddCorrections(s, k, ncorrection, correction, &scratch);
    AddGauges(s, &s->fluid.client[k].out);
    ClientListAskSave(s, &s->fluid.client[k], action);
  }
  ClientListSend(s, &s->fluid);
  BufferFree(&scratch);
  if (action == CORACLE_REDO) s->elements_changed = false;
  s->owes_step = false;
  s->owes_coupling = action != CORACLE_STOP;
  return 0;
}

int ServerSendCoupling(Server s, int n, const CoracleCoupling coupling[])
{
  Buffer scratch = {0};
  if (!s->owes_coupling) ServerFail(s, "ServerSendCoupling comes after ServerSendStep");
  if (s->elements_changed && n)
    ServerFail(s, "the fluid's elements have changed: ServerAskElements comes first");
  CheckCouplings(s, n, coupling);
  int *owner = BufferResize(&s->owner, (size_t)n * sizeof *owner);
  for (int i = 0; i < n; i++) owner[i] = ClientListFind(&s->fluid, coupling[i].element);
  for (int k = 0; k < s->fluid.n; k++) {
    MessageHeader *h = MessageStart(&s->fluid.client[k].out, KIND_COUPLING, s->fluid.step);
    h->count[0] = CountOwned(owner, n, k);
    AddCouplings(s, k, n, coupling, owner, &scratch);
  }
  ClientListSend(s, &s->fluid);
  BufferFree(&scratch);
  s->owes_coupling = s->elements_changed = false;
  return 0;
}
