#include "common/link/server_impl.h"
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static void ClientListInit(ClientList *side, const Participant *p, Role role)
{
  side->peer = calloc((size_t)p->count[role] + 1, sizeof *side->peer);
  for (int rank = p->rank; rank < p->count[role]; rank += p->size) {
    MessageInit(&side->peer[side->n].in, role, rank);
    MessageInit(&side->peer[side->n++].out, role, rank);
  }
}

static void ClientListFree(ClientList *side)
{
  for (int i = 0; i < side->n; i++) {
    MessageFree(&side->peer[i].in);
    MessageFree(&side->peer[i].out);
    FieldListsFree(&side->peer[i].nodes);
    FieldListsFree(&side->peer[i].facets);
    FieldListsFree(&side->peer[i].elements);
    BufferFree(&side->peer[i].coupled);
  }
  free(side->peer);
}

int ClientListFind(const ClientList *side, int i)
{
  int lower = 0, upper = side->n - 1; /* the last peer whose first <= i */
  while (lower < upper) {
    const int middle = (lower + upper + 1) / 2;
    if (side->peer[middle].first <= i)
      lower = middle;
    else
      upper = middle - 1;
  }
  return lower;
}

void ClientListSend(Server s, ClientList *side)
{
  for (int i = 0; i < side->n; i++) MessageSend(s->p, &side->peer[i].out);
  for (int i = 0; i < side->n; i++) MessageFinish(s->p, &side->peer[i].out);
}

void ClientListStep(Server s, ClientList *side, CoracleAction action)
{
  if (side->stopped) ServerFail(s, "the run goes on after CORACLE_STOP");
  if (action == CORACLE_RUN) side->step++;
  if (action == CORACLE_REDO && side->step == 0) ServerFail(s, "CORACLE_REDO before the first step");
  side->stopped = action == CORACLE_STOP;
  ParticipantStep(s->p, side->step);
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
  for (int i = 0; i < s->fluid.n; i++) s->fluid.peer[i].saved = false;
  for (int i = 0; i < s->solid.n; i++) s->solid.peer[i].saved = false;
  return 0;
}

void ClientListAskSave(Server s, ClientRank *peer, CoracleAction action)
{
  const size_t bytes = action == CORACLE_REDO ? 0 : s->save.size;
  MessageHeaderOf(&peer->out)->count[2] = (int64_t)bytes;
  MessageAdd(&peer->out, s->save.data, bytes);
}

void ClientListFlags(Server s, Role role, ClientRank *peer, const MessageHeader *h)
{
  if (h->flag & FLAG_SAVED) peer->saved = true;
  const bool resumes = h->flag & FLAG_RESUMES;
  if (h->step > 0 || resumes == (s->p->resume != NULL)) return;
  if (resumes)
    ServerFail(s, "the %s goes on from a checkpoint that is not to be found here", ROLE_NAMES[role]);
  ServerFail(
      s, "the run goes on from %s, but the %s begins at the start: it does not find that, or cannot resume",
      s->p->resume, ROLE_NAMES[role]);
}

const char *ServerUnsaved(Server s)
{
  int missing[NROLES] = {0};
  for (int i = 0; i < s->fluid.n; i++) missing[ROLE_FLUID] |= !s->fluid.peer[i].saved;
  for (int i = 0; i < s->solid.n; i++) missing[ROLE_SOLID] |= !s->solid.peer[i].saved;
  MPI_Allreduce(MPI_IN_PLACE, missing, NROLES, MPI_INT, MPI_LOR, s->p->app);
  BufferResize(&s->save, 0);
  for (int role = 0; role < NROLES; role++)
    if (missing[role]) return ROLE_NAMES[role];
  return NULL;
}

/* --- joining -------------------------------------------------------------------------------------------- */

int ServerOpen(int argc, char **argv, MPI_Comm *app_comm, Server *server)
{
  Server s = calloc(1, sizeof *s);
  ParticipantOpen("coupler", false, argc, argv, &s->p);
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

static void ReceiveClose(Server s, ClientList *side, Role role)
{
  for (int i = 0; i < side->n; i++) {
    Message *m = &side->peer[i].in;
    const MessageHeader *h = MessageReceive(s->p, m, KIND_CLOSE, KIND_CLOSE, side->step);
    ClientListFlags(s, role, &side->peer[i], h);
    const size_t n = (size_t)h->count[0];
    ReportMerge(&s->reports[role], n, MessageTake(s->p, m, n * sizeof(Report)));
  }
}

/* Rank 0 takes in what the other coupler ranks have of a role. */
static void GatherReports(Server s, Role role)
{
  Buffer *mine = &s->reports[role];
  const int bytes = (int)mine->size;
  int *count = calloc((size_t)s->p->size, sizeof *count),
      *start = calloc((size_t)s->p->size + 1, sizeof *start);
  MPI_Gather(&bytes, 1, MPI_INT, count, 1, MPI_INT, 0, s->p->app);
  for (int i = 0; i < s->p->size; i++) start[i + 1] = start[i] + count[i];
  Report *all = malloc((size_t)start[s->p->size] + 1);
  MPI_Gatherv(mine->data, bytes, MPI_BYTE, all, count, start, MPI_BYTE, 0, s->p->app);
  if (s->p->rank == 0)
    ReportMerge(mine, (size_t)(start[s->p->size] - bytes) / sizeof *all, all + (size_t)bytes / sizeof *all);
  free(all);
  free(start);
  free(count);
}

int ServerFinish(Server s)
{
  if (!s->fluid.stopped || !s->solid.stopped)
    ServerFail(s, "ServerFinish comes after CORACLE_STOP to both clients");
  ReceiveClose(s, &s->fluid, ROLE_FLUID);
  ReceiveClose(s, &s->solid, ROLE_SOLID);
  ReportResources(&s->reports[ROLE_COUPLER], s->p);
  for (int role = 0; role < NROLES; role++) GatherReports(s, (Role)role);
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
  Buffer *all[] = {&s->save, &s->gid, &s->facet, &s->element, &s->start_gid, &s->start_element, &s->owner};
  for (size_t k = 0; k < sizeof all / sizeof *all; k++) BufferFree(all[k]);
  FieldListsFree(&s->motion);
  FieldListsFree(&s->elements);
  FieldListsFree(&s->flow);
  for (int role = 0; role < NROLES; role++) BufferFree(&s->reports[role]);
  ClientListFree(&s->fluid);
  ClientListFree(&s->solid);
  ParticipantClose(&s->p);
  free(s);
  *server = NULL;
  return 0;
}
