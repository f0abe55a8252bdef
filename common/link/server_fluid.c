/* The coupler's end towards the fluid. */
#include "common/link/server_impl.h"
#include <math.h>
#include <string.h>

enum { DIM = 2, NV = DIM + 1, NP2 = 6 };

static void Append(Server s, Message *m, Buffer *list, size_t bytes)
{
  const void *block = MessageTake(s->p, m, bytes);
  memcpy(BufferExtend(list, bytes), block, bytes);
}

static const double *Doubles(const Buffer *b)
{
  return (const double *)(const void *)b->data;
}

/* The smallest proposal of all fluid ranks. */
static void ReduceProposed(Server s, double mine)
{
  MPI_Allreduce(&mine, &s->proposed, 1, MPI_DOUBLE, MPI_MIN, s->p->app);
}

/* --- elements ------------------------------------------------------------------------------------------- */

static void SendAsk(Server s, int nbox, const double box[])
{
  for (int i = 0; i < s->fluid.n; i++) {
    Message *m = &s->fluid.peer[i].out;
    MessageStart(m, KIND_ASK, s->fluid.step)->count[0] = nbox;
    MessageAdd(m, box, (size_t)nbox * 2 * DIM * sizeof *box);
  }
  ClientListSend(s, &s->fluid);
}

/* bounds[2][DIM]: lower, and upper with its sign turned, so that both are minima. */
static double ReceiveElements(Server s, ClientRank *peer, double bounds[2 * DIM])
{
  Message *m = &peer->in;
  const MessageHeader *h = MessageReceive(s->p, m, KIND_ELEMENTS, KIND_ELEMENTS, s->fluid.step);
  ClientListFlags(s, ROLE_FLUID, peer, h);
  const double *lower = MessageTake(s->p, m, DIM * sizeof *lower),
               *upper = MessageTake(s->p, m, DIM * sizeof *upper);
  for (int d = 0; d < DIM; d++) {
    bounds[d] = fmin(bounds[d], lower[d]);
    bounds[DIM + d] = fmin(bounds[DIM + d], -upper[d]);
  }
  peer->first = s->nelements;
  peer->n = (int)h->count[0];
  s->nelements += peer->n;
  Append(s, m, &s->vertices, (size_t)peer->n * NV * DIM * sizeof(double));
  Append(s, m, &s->rho, (size_t)peer->n * sizeof(double));
  return h->dt;
}

int ServerAskElements(Server s, int nbox, const double box[], ServerElements *elements)
{
  double proposed = HUGE_VAL, bounds[2 * DIM] = {HUGE_VAL, HUGE_VAL, HUGE_VAL, HUGE_VAL};
  if (s->fluid.step > 0 && !s->owes_correction)
    ServerFail(s, "ServerAskElements: the fluid answers only between its flow and its coupling");
  MessageCheckFinite(s->p, "box", "box", (size_t)nbox, 2 * DIM, box);
  SendAsk(s, nbox, box);
  s->nelements = 0;
  BufferResize(&s->vertices, 0);
  BufferResize(&s->rho, 0);
  for (int i = 0; i < s->fluid.n; i++)
    proposed = fmin(proposed, ReceiveElements(s, &s->fluid.peer[i], bounds));
  ReduceProposed(s, proposed);
  MPI_Allreduce(MPI_IN_PLACE, bounds, 2 * DIM, MPI_DOUBLE, MPI_MIN, s->p->app);
  for (int d = 0; d < DIM; d++) {
    s->lower[d] = bounds[d];
    s->upper[d] = -bounds[DIM + d];
  }
  s->asked = true;
  s->elements_changed = false;
  *elements = (ServerElements){.n = s->nelements, .x = Doubles(&s->vertices), .rho = Doubles(&s->rho)};
  memcpy(elements->lower, s->lower, sizeof s->lower);
  memcpy(elements->upper, s->upper, sizeof s->upper);
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

static double ReceiveFlow(Server s, ClientRank *peer, Message *m, int *changed)
{
  const MessageHeader *h = MessageReceive(s->p, m, KIND_FLOW, KIND_FLOW, s->fluid.step);
  const size_t n = (size_t)h->count[0];
  if (h->count[0] != peer->n)
    ServerFail(s, "fluid rank %d has sent the flow on %zu elements instead of %d", m->rank, n, peer->n);
  Append(s, m, &s->u_star, n * DIM * NV * sizeof(double));
  Append(s, m, &s->u_plus, n * DIM * NV * sizeof(double));
  Append(s, m, &s->pressure, n * NP2 * sizeof(double));
  Append(s, m, &s->mu, n * sizeof(double));
  ClientListFlags(s, ROLE_FLUID, peer, h);
  *changed |= h->flag & FLAG_CHANGED;
  return h->dt;
}

int ServerReceiveFlow(Server s, ServerFlow *flow)
{
  Buffer *lists[] = {&s->u_star, &s->u_plus, &s->pressure, &s->mu};
  double proposed = HUGE_VAL;
  int changed = 0;
  if (s->owes_correction) ServerFail(s, "ServerReceiveFlow: the fluid waits for ServerSendCoupling");
  for (int k = 0; k < 4; k++) BufferResize(lists[k], 0);
  for (int i = 0; i < s->fluid.n; i++)
    proposed = fmin(proposed, ReceiveFlow(s, &s->fluid.peer[i], &s->fluid.peer[i].in, &changed));
  ReduceProposed(s, proposed);
  MPI_Allreduce(MPI_IN_PLACE, &changed, 1, MPI_INT, MPI_LOR, s->p->app);
  s->elements_changed = changed;
  s->owes_correction = true;
  *flow = (ServerFlow){.u_star = Doubles(&s->u_star),
                       .u_plus = Doubles(&s->u_plus),
                       .p = Doubles(&s->pressure),
                       .mu = Doubles(&s->mu)};
  return 0;
}

/* --- coupling ------------------------------------------------------------------------------------------- */

static int *Ints(const Buffer *b)
{
  return (int *)(void *)b->data;
}

/* The corrections of one peer, in the order of its coupling entries, with its own indices of that time. */
static void AddCorrections(Server s, int k, int n, const CoracleCorrection correction[], Buffer *scratch)
{
  ClientRank *peer = &s->fluid.peer[k];
  int mine = 0;
  BufferResize(scratch, 0);
  for (int i = 0; i < n; i++) {
    if (Ints(&s->owner)[i] != k) continue;
    CoracleCorrection *c = BufferExtend(scratch, sizeof *c);
    memset(c, 0, sizeof *c); /* the padding, too: what travels is defined */
    c->element = Ints(&peer->coupled)[mine++];
    memcpy(c->r, correction[i].r, sizeof c->r);
  }
  MessageAdd(&peer->out, scratch->data, scratch->size);
}

static void AddCouplings(Server s, int k, int n, const CoracleCoupling coupling[], const int owner[],
                         Buffer *scratch)
{
  ClientRank *peer = &s->fluid.peer[k];
  BufferResize(scratch, 0);
  BufferResize(&peer->coupled, 0);
  for (int i = 0; i < n; i++) {
    if (owner[i] != k) continue;
    CoracleCoupling *c = BufferExtend(scratch, sizeof *c);
    *c = coupling[i];
    c->element -= peer->first;
    *(int *)BufferExtend(&peer->coupled, sizeof(int)) = c->element;
  }
  MessageAdd(&peer->out, scratch->data, scratch->size);
}

/* As MessageCheckFinite, for one entry of a list of structs. */
static void CheckEntry(Server s, const char *field, int entry, int n, const double value[])
{
  for (int i = 0; i < n; i++)
    if (!isfinite(value[i]))
      ServerFail(s, "%s is %g at entry %d, component %d, after step %d", field, value[i], entry, i,
                 s->fluid.step);
}

static void CheckCouplings(Server s, int n, const CoracleCoupling coupling[])
{
  for (int i = 0; i < n; i++) {
    const CoracleCoupling *c = &coupling[i];
    if (c->element < 0 || c->element >= s->nelements)
      ServerFail(s, "coupling entry %d is of element %d of %d", i, c->element, s->nelements);
    CheckEntry(s, "coupling coefficient a", i, 36, &c->a[0][0][0][0]);
    CheckEntry(s, "coupling source s", i, 6, &c->s[0][0]);
    CheckEntry(s, "solid mass", i, 9, &c->ms[0][0]);
    CheckEntry(s, "solid velocity", i, 6, &c->us[0][0]);
    CheckEntry(s, "solid fraction", i, 1, &c->alpha);
    CheckEntry(s, "shell fraction", i, 1, &c->shell);
  }
}

static void CheckCorrections(Server s, CoracleAction action, int n, const CoracleCorrection correction[])
{
  if (action == CORACLE_REDO && n == 0) return;
  const int expected = s->owes_correction ? (int)(s->owner.size / sizeof(int)) : 0;
  if (n != expected)
    ServerFail(s, "%d corrections after step %d, which had %d coupling entries", n, s->fluid.step, expected);
  for (int i = 0; i < n; i++) CheckEntry(s, "correction", i, 6, &correction[i].r[0][0]);
}

static int CountOwned(const int owner[], int n, int k)
{
  int count = 0;
  for (int i = 0; i < n; i++) count += owner[i] == k;
  return count;
}

int ServerSendCoupling(Server s, double t, double dt, CoracleAction action, int ncorrection,
                       const CoracleCorrection correction[], int ncoupling, const CoracleCoupling coupling[])
{
  const int step = s->fluid.step; /* which the clients are in until they get this */
  Buffer owner = {0}, scratch = {0};
  if (!s->asked) ServerFail(s, "ServerSendCoupling comes after the first ServerAskElements");
  if (s->elements_changed && ncoupling && action != CORACLE_REDO)
    ServerFail(s, "the fluid's elements have changed: ServerAskElements comes first");
  CheckCorrections(s, action, ncorrection, correction);
  CheckCouplings(s, ncoupling, coupling);
  int *own = BufferResize(&owner, (size_t)ncoupling * sizeof *own);
  for (int i = 0; i < ncoupling; i++) own[i] = ClientListFind(&s->fluid, coupling[i].element);
  ClientListStep(s, &s->fluid, action);
  for (int k = 0; k < s->fluid.n; k++) {
    MessageHeader *h = MessageStart(&s->fluid.peer[k].out, KIND_COUPLING, step);
    h->action = action;
    h->t = t;
    h->dt = dt;
    h->count[0] = CountOwned(Ints(&s->owner), ncorrection, k);
    h->count[1] = CountOwned(own, ncoupling, k);
    AddCorrections(s, k, ncorrection, correction, &scratch);
    AddCouplings(s, k, ncoupling, coupling, own, &scratch);
    ClientListAskSave(s, &s->fluid.peer[k], action);
  }
  ClientListSend(s, &s->fluid);
  BufferFree(&s->owner);
  s->owner = owner;
  BufferFree(&scratch);
  s->owes_correction = s->elements_changed = false;
  return 0;
}
