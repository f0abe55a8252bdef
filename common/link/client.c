#include "common/link/client_impl.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

int CoracleOpen(const char *role, int argc, char **argv, MPI_Comm *app_comm, CoracleClient *client)
{
  return CoracleOpenComm(MPI_COMM_NULL, role, argc, argv, app_comm, client);
}

int CoracleOpenFortran(const MPI_Fint *job, const char *role, int argc, char **argv, MPI_Fint *app_comm,
                       CoracleClient *client)
{
  MPI_Comm comm;
  CoracleOpenComm(job ? MPI_Comm_f2c(*job) : MPI_COMM_NULL, role, argc, argv, &comm, client);
  *app_comm = MPI_Comm_c2f(comm);
  return 0;
}

const char *CoracleVersion(void)
{
  return CORACLE_VERSION;
}

int CoracleSetErrorHandler(void (*f)(void *context, const char *message), void *context)
{
  ParticipantSetErrorHandler(f, context);
  return 0;
}

int CoracleOpenComm(MPI_Comm job, const char *role, int argc, char **argv, MPI_Comm *app_comm,
                    CoracleClient *client)
{
  if (!role) ParticipantFail(NULL, "CoracleOpen: role is NULL, expected \"fluid\" or \"solid\"");
  CoracleClient c = calloc(1, sizeof *c);
  ParticipantOpen(job, role, true, argc, argv, &c->p);
  const int owner = c->p->rank % c->p->count[ROLE_COUPLER];
  MessageInit(&c->in, ROLE_COUPLER, owner);
  MessageInit(&c->out, ROLE_COUPLER, owner);
  c->fluid.proposed = HUGE_VAL;
  *app_comm = c->p->app;
  *client = c;
  return 0;
}

void CoracleFail(CoracleClient c, const char *format, ...)
{
  va_list list;
  va_start(list, format);
  ParticipantFailList(c ? c->p : NULL, format, list);
}

void CoracleFailMessage(void *client, const char *message)
{
  CoracleFail(client, "%s", message);
}

void ClientMisuse(CoracleClient c, const char *function, const char *why)
{
  ParticipantFail(c->p, "%s: %s", function, why);
}

void ClientMustBe(CoracleClient c, const char *function)
{
  if (!c)
    ParticipantFail(NULL, "%s: the client is NULL: CoracleOpen comes first, and CoracleClose nulls it",
                    function);
}

void ClientExpect(CoracleClient c, const char *function, Role role, Stage stage, Stage other)
{
  static const char *const WHEN[] = {"before CoracleReady", "between CoracleEnd and CoracleBegin",
                                     "between CoracleBegin and CoracleEnd", "after CORACLE_STOP"};
  ClientMustBe(c, function);
  if (role != ROLE_ANY && c->p->role != role)
    ParticipantFail(c->p, "%s is for a %s", function, ROLE_NAMES[role]);
  if (c->stage == stage || c->stage == other) return;
  if (stage == other)
    ParticipantFail(c->p, "%s was called %s: its place is %s", function, WHEN[c->stage], WHEN[stage]);
  ParticipantFail(c->p, "%s was called %s: its place is %s or %s", function, WHEN[c->stage], WHEN[stage],
                  WHEN[other]);
}

void ClientGiven(CoracleClient c, const char *function, const char *name, const void *array, int n)
{
  if (n > 0 && !array) ParticipantFail(c->p, "%s: %s is NULL, expected an array for %d", function, name, n);
}

void ClientSend(CoracleClient c)
{
  MessageSend(c->p, &c->out);
  MessageFinish(c->p, &c->out);
}

MessageHeader *ClientReject(CoracleClient c, MessageKind kind)
{
  MessageHeader *h = MessageStart(&c->out, kind, c->p->step);
  h->count[3] = (int64_t)c->rejection.size;
  h->flag = ClientFlags(c);
  MessageAdd(&c->out, c->rejection.data, c->rejection.size);
  BufferResize(&c->rejection, 0);
  return MessageHeaderOf(&c->out);
}

void ClientTakeStep(CoracleClient c, const MessageHeader *h)
{
  c->action = (CoracleAction)h->action;
  c->t = h->t;
  c->dt = h->dt;
  if (c->action != CORACLE_STOP && !(isfinite(c->t) && isfinite(c->dt) && c->dt > 0.0))
    ParticipantFail(c->p, "the coupler wants a step from t = %g over dt = %g s", c->t, c->dt);
}

/* --- checkpoints ---------------------------------------------------------------------------------------- */

void ClientTakePath(CoracleClient c, const MessageHeader *h)
{
  const size_t bytes = (size_t)h->count[2];
  BufferResize(&c->save, bytes);
  if (bytes) memcpy(c->save.data, MessageTake(c->p, &c->in, bytes), bytes);
  c->asked_save = false;
}

const char *CoracleCheckpointPath(CoracleClient c)
{
  ClientExpect(c, "CoracleCheckpointPath", ROLE_ANY, STAGE_STEP, STAGE_STOPPED);
  if (c->action == CORACLE_REDO || !c->save.size) return NULL;
  c->asked_save = true;
  return c->save.data;
}

const char *CoracleResumePath(CoracleClient c)
{
  ClientExpect(c, "CoracleResumePath", ROLE_ANY, STAGE_SETUP, STAGE_SETUP);
  c->asked_resume = true;
  return c->p->resume;
}

int ClientFlags(CoracleClient c)
{
  const bool itself = StateIsBuffers(c), saved = c->asked_save || (itself && c->save.size > 0);
  return (saved ? FLAG_SAVED : 0) | (c->p->resume && (itself || c->asked_resume) ? FLAG_RESUMES : 0);
}

/* --- the run -------------------------------------------------------------------------------------------- */

int CoracleReady(CoracleClient c)
{
  ClientExpect(c, "CoracleReady", ROLE_ANY, STAGE_SETUP, STAGE_SETUP);
  if (c->p->role == ROLE_SOLID)
    SolidReady(c);
  else
    FluidReady(c);
  c->stage = STAGE_BETWEEN;
  return 0;
}

int CoracleBegin(CoracleClient c, double *t, double *dt, CoracleAction *action)
{
  ClientExpect(c, "CoracleBegin", ROLE_ANY, STAGE_BETWEEN, STAGE_BETWEEN);
  if (c->p->role == ROLE_SOLID) SolidBegin(c);
  c->stage = c->action == CORACLE_STOP ? STAGE_STOPPED : STAGE_STEP;
  if (c->action == CORACLE_RUN) {
    ParticipantStep(c->p, c->p->step + 1);
    StateSave(c);
  } else if (c->action == CORACLE_REDO) {
    StateRestore(c);
  } else if (c->save.size) {
    StateSave(c);
  }
  if (c->action != CORACLE_REDO && c->save.size) ParticipantSaveUsed(c->p, c->save.data);
  *t = c->t;
  *dt = c->dt;
  *action = c->action;
  return 0;
}

int CoracleEnd(CoracleClient c, const double x[])
{
  ClientExpect(c, "CoracleEnd", ROLE_ANY, STAGE_STEP, STAGE_STEP);
  if (c->p->role == ROLE_SOLID)
    SolidEnd(c, x);
  else
    FluidEnd(c);
  c->stage = STAGE_BETWEEN;
  return 0;
}

int CoracleRejectStep(CoracleClient c, const char *why)
{
  ClientExpect(c, "CoracleRejectStep", ROLE_ANY, STAGE_STEP, STAGE_STEP);
  if (!why) ClientMisuse(c, "CoracleRejectStep", "it must say why");
  const size_t bytes = strlen(why) + 1;
  memcpy(BufferResize(&c->rejection, bytes), why, bytes);
  return 0;
}

int CoracleReport(CoracleClient c, const char *key, double value, int sum)
{
  ClientMustBe(c, "CoracleReport");
  if (!ReportSet(&c->reports, key, value, sum != 0)) ClientMisuse(c, "CoracleReport", "the key is too long");
  return 0;
}

int CoraclePhase(CoracleClient c, const char *name)
{
  ClientMustBe(c, "CoraclePhase");
  TracePhase(&c->p->trace, name);
  return 0;
}

int CoracleClose(CoracleClient *client)
{
  CoracleClient c = *client;
  if (!c) return 0;
  if (c->stage != STAGE_STOPPED)
    ParticipantFail(c->p, "closed in step %d, before the end of the run (CORACLE_STOP)", c->p->step);
  ReportResources(&c->reports, c->p);
  MessageHeader *h = MessageStart(&c->out, KIND_CLOSE, c->p->step);
  h->count[0] = (int64_t)ReportCount(&c->reports);
  h->flag = ClientFlags(c);
  MessageAdd(&c->out, c->reports.data, c->reports.size);
  TraceEnd(&c->p->trace);
  h = MessageHeaderOf(&c->out);
  h->count[1] = (int64_t)(c->p->trace.spans.size / sizeof(TraceSpan));
  MessageAdd(&c->out, c->p->trace.spans.data, c->p->trace.spans.size);
  ClientSend(c);
  ParticipantClose(&c->p);
  MessageFree(&c->in);
  MessageFree(&c->out);
  SolidFree(c);
  FluidFree(c);
  StateFree(c);
  BufferFree(&c->reports);
  BufferFree(&c->save);
  BufferFree(&c->rejection);
  free(c);
  *client = NULL;
  return 0;
}
