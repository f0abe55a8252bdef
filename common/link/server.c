#include "common/link/server_impl.h"
#include <errno.h>
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static void ClientListInit(ClientList *clients, const Participant *p, Role role)
{
  clients->client = calloc((size_t)p->count[role] + 1, sizeof *clients->client);
  for (int rank = p->rank; rank < p->count[role]; rank += p->size) {
    MessageInit(&clients->client[clients->n].in, role, rank);
    MessageInit(&clients->client[clients->n++].out, role, rank);
  }
}

static void ClientListFree(ClientList *clients)
{
  for (int i = 0; i < clients->n; i++) {
    MessageFree(&clients->client[i].in);
    MessageFree(&clients->client[i].out);
    FieldListsFree(&clients->client[i].nodes);
    FieldListsFree(&clients->client[i].facets);
    FieldListsFree(&clients->client[i].elements);
    BufferFree(&clients->client[i].coupled);
  }
  free(clients->client);
}

int ClientListFind(const ClientList *clients, int i)
{
  int lower = 0, upper = clients->n - 1; /* the last client whose first <= i */
  while (lower < upper) {
    const int middle = (lower + upper + 1) / 2;
    if (clients->client[middle].first <= i)
      lower = middle;
    else
      upper = middle - 1;
  }
  return lower;
}

void ClientListSend(Server s, ClientList *clients)
{
  for (int i = 0; i < clients->n; i++) MessageSend(s->p, &clients->client[i].out);
  for (int i = 0; i < clients->n; i++) MessageFinish(s->p, &clients->client[i].out);
}

void ClientListStep(Server s, ClientList *clients, CoracleAction action)
{
  if (clients->stopped) ServerFail(s, "the run goes on after CORACLE_STOP");
  if (action == CORACLE_RUN) clients->step++;
  if (action == CORACLE_REDO && clients->step == 0) ServerFail(s, "CORACLE_REDO before the first step");
  clients->stopped = action == CORACLE_STOP;
  ParticipantStep(s->p, clients->step);
}

/* --- checkpoints ---------------------------------------------------------------------------------------- */

const char *ServerResumePath(Server s)
{
  return s->p->resume;
}

int ServerSave(Server s, const char *folder)
{
  const size_t bytes = strlen(folder) + 1;
  memcpy(BufferResize(&s->save, bytes), folder, bytes);
  ParticipantSaveUsed(s->p, folder);
  for (int i = 0; i < s->fluid.n; i++) s->fluid.client[i].saved = false;
  for (int i = 0; i < s->solid.n; i++) s->solid.client[i].saved = false;
  return 0;
}

void ClientListAskSave(Server s, ClientRank *client, CoracleAction action)
{
  const size_t bytes = action == CORACLE_REDO ? 0 : s->save.size;
  MessageHeaderOf(&client->out)->count[2] = (int64_t)bytes;
  MessageAdd(&client->out, s->save.data, bytes);
}

void ClientListFlags(Server s, Role role, ClientRank *client, const MessageHeader *h)
{
  if (h->flag & FLAG_SAVED) client->saved = true;
  const bool resumes = h->flag & FLAG_RESUMES;
  if (h->step > 0 || resumes == (s->p->resume != NULL)) return;
  if (resumes)
    ServerFail(s, "the %s resumes from a checkpoint that is not to be found here", ROLE_NAMES[role]);
  ServerFail(
      s, "the run resumes from %s, but the %s begins at the start: it does not find that, or cannot resume",
      s->p->resume, ROLE_NAMES[role]);
}

bool ClientListRejects(Server s, Role role, ClientRank *client)
{
  const size_t bytes = (size_t)MessageHeaderOf(&client->in)->count[3];
  if (!bytes) return false;
  const char *why = MessageTake(s->p, &client->in, bytes);
  const size_t length = bytes + strlen(ROLE_NAMES[role]) + 2;
  snprintf(BufferResize(&s->rejection, length), length, "%s: %s", ROLE_NAMES[role], why);
  return true;
}

void ServerAgree(Server s, int *changed)
{
  int largest[2] = {*changed, s->rejection.size ? s->p->rank + 1 : 0};
  int bytes = (int)s->rejection.size;
  MPI_Allreduce(MPI_IN_PLACE, largest, 2, MPI_INT, MPI_MAX, s->p->app);
  *changed = largest[0];
  if (!largest[1]) return;
  MPI_Bcast(&bytes, 1, MPI_INT, largest[1] - 1, s->p->app);
  MPI_Bcast(BufferResize(&s->rejection, (size_t)bytes), bytes, MPI_CHAR, largest[1] - 1, s->p->app);
}

const char *ServerRejection(Server s)
{
  return s->rejection.size ? s->rejection.data : NULL;
}

const char *ServerUnsaved(Server s)
{
  int missing[NROLES] = {0};
  for (int i = 0; i < s->fluid.n; i++) missing[ROLE_FLUID] |= !s->fluid.client[i].saved;
  for (int i = 0; i < s->solid.n; i++) missing[ROLE_SOLID] |= !s->solid.client[i].saved;
  MPI_Allreduce(MPI_IN_PLACE, missing, NROLES, MPI_INT, MPI_LOR, s->p->app);
  BufferResize(&s->save, 0);
  for (int role = 0; role < NROLES; role++)
    if (missing[role]) return ROLE_NAMES[role];
  return NULL;
}

/* --- joining -------------------------------------------------------------------------------------------- */

int ServerOpen(int argc, char **argv, MPI_Comm *app_comm, Server *server)
{
  return ServerOpenComm(MPI_COMM_NULL, argc, argv, app_comm, server);
}

int ServerOpenComm(MPI_Comm job, int argc, char **argv, MPI_Comm *app_comm, Server *server)
{
  Server s = calloc(1, sizeof *s);
  ParticipantOpen(job, "coupler", false, argc, argv, &s->p);
  ClientListInit(&s->fluid, s->p, ROLE_FLUID);
  ClientListInit(&s->solid, s->p, ROLE_SOLID);
  s->proposed = HUGE_VAL;
  *app_comm = s->p->app;
  *server = s;
  return 0;
}

void ServerFail(Server s, const char *format, ...)
{
  va_list list;
  va_start(list, format);
  ParticipantFailList(s->p, format, list);
}

int ServerRanks(Server s, const char *role)
{
  const int k = HandshakeRole(role);
  return k < 0 ? 0 : s->p->count[k];
}

double ServerWaited(Server s)
{
  return s->p->waiter.waited;
}

/* --- the end -------------------------------------------------------------------------------------------- */

static void ReceiveClose(Server s, ClientList *clients, Role role)
{
  for (int i = 0; i < clients->n; i++) {
    Message *m = &clients->client[i].in;
    const MessageHeader *h = MessageReceive(s->p, m, KIND_CLOSE, KIND_CLOSE, clients->step);
    ClientListFlags(s, role, &clients->client[i], h);
    const size_t n = (size_t)h->count[0];
    const size_t spans = (size_t)h->count[1] * sizeof(TraceSpan);
    ReportMerge(&s->reports[role], n, MessageTake(s->p, m, n * sizeof(Report)));
    if (spans) memcpy(BufferExtend(&s->spans, spans), MessageTake(s->p, m, spans), spans);
  }
}

/* On rank 0 the lists of the other coupler ranks behind its own, in the order of the ranks; of items of `size` bytes, at most INT_MAX in all. */
static void GatherBuffer(Server s, size_t size, Buffer *mine)
{
  const int n = (int)(mine->size / size);
  MPI_Datatype item;
  int *count = calloc((size_t)s->p->size, sizeof *count),
      *start = calloc((size_t)s->p->size + 1, sizeof *start);
  MPI_Type_contiguous((int)size, MPI_BYTE, &item);
  MPI_Type_commit(&item);
  MPI_Gather(&n, 1, MPI_INT, count, 1, MPI_INT, 0, s->p->app);
  for (int i = 0; i < s->p->size; i++) start[i + 1] = start[i] + count[i];
  const size_t bytes = size * (size_t)start[s->p->size];
  char *all = malloc(bytes + 1);
  MPI_Gatherv(mine->data, n, item, all, count, start, item, 0, s->p->app);
  if (s->p->rank == 0) memcpy(BufferResize(mine, bytes), all, bytes);
  MPI_Type_free(&item);
  free(all);
  free(start);
  free(count);
}

/* Rank 0 takes in what the other coupler ranks have of a role. */
static void GatherReports(Server s, Role role)
{
  Buffer all = s->reports[role];
  s->reports[role] = (Buffer){0};
  GatherBuffer(s, sizeof(Report), &all);
  ReportMerge(&s->reports[role], ReportCount(&all), (const Report *)(const void *)all.data);
  BufferFree(&all);
}

int ServerFinish(Server s)
{
  if (!s->fluid.stopped || !s->solid.stopped)
    ServerFail(s, "ServerFinish comes after CORACLE_STOP to both clients");
  ReceiveClose(s, &s->fluid, ROLE_FLUID);
  ReceiveClose(s, &s->solid, ROLE_SOLID);
  ReportResources(&s->reports[ROLE_COUPLER], s->p);
  for (int role = 0; role < NROLES; role++) GatherReports(s, (Role)role);
  TraceEnd(&s->p->trace);
  const size_t own = s->p->trace.spans.size;
  if (own) memcpy(BufferExtend(&s->spans, own), s->p->trace.spans.data, own);
  GatherBuffer(s, sizeof(TraceSpan), &s->spans);
  return 0;
}

int ServerWriteTrace(Server s, const char *path)
{
  if (s->p->rank || !s->p->trace.on) return 0;
  if (!TraceWrite(path, s->spans.size / sizeof(TraceSpan), (const TraceSpan *)(const void *)s->spans.data))
    ServerFail(s, "%s: %s", path, strerror(errno));
  return 0;
}

double ServerWaitedFor(Server s, const char *role)
{
  return s->p->waited_for[HandshakeRole(role)];
}

double ServerWall(Server s)
{
  return WaitClock() - s->p->start;
}

int ServerSharesProcessors(Server s)
{
  return s->p->shared;
}

int ServerPhase(Server s, const char *name)
{
  TracePhase(&s->p->trace, name);
  return 0;
}

int ServerReports(Server s, void (*f)(void *context, const char *role, const char *key, double value),
                  void *context)
{
  if (s->p->rank) return 0;
  for (int role = 0; role < NROLES; role++) {
    const Report *report = (const Report *)(const void *)s->reports[role].data;
    for (size_t i = 0; i < ReportCount(&s->reports[role]); i++)
      f(context, ROLE_NAMES[role], report[i].key, report[i].value);
  }
  return 0;
}

int ServerClose(Server *server)
{
  Server s = *server;
  if (!s) return 0;
  if (!s->fluid.stopped || !s->solid.stopped)
    ServerFail(s, "closed in step %d, before CORACLE_STOP to both clients", s->p->step);
  Buffer *all[] = {&s->save,      &s->rejection,   &s->gid,           &s->facet, &s->element,
                   &s->start_gid, &s->start_facet, &s->start_element, &s->owner};
  for (size_t k = 0; k < sizeof all / sizeof *all; k++) BufferFree(all[k]);
  FieldListsFree(&s->motion);
  FieldListsFree(&s->elements);
  FieldListsFree(&s->flow);
  BufferFree(&s->gauge);
  BufferFree(&s->spans);
  for (int role = 0; role < NROLES; role++) BufferFree(&s->reports[role]);
  ClientListFree(&s->fluid);
  ClientListFree(&s->solid);
  ParticipantClose(&s->p);
  free(s);
  *server = NULL;
  return 0;
}
