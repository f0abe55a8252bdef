#include "common/link/message.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { TAG = 1, UNIT = 8 }; /* messages are counted in units of 8 bytes: 16 GiB is their limit */
static const uint32_t MAGIC = 0xC07AC1E1;

#define NAME(kind) #kind,
static const char *const KIND_NAMES[KIND_END] = {"?", MESSAGE_KINDS(NAME)};

/* --- writing and sending -------------------------------------------------------------------------------- */

void MessageInit(Message *m, Role role, int rank)
{
  *m = (Message){.request = MPI_REQUEST_NULL, .role = role, .rank = rank};
}

void MessageFree(Message *m)
{
  BufferFree(&m->buffer);
}

MessageHeader *MessageStart(Message *m, MessageKind kind, int step)
{
  MessageHeader *header = BufferResize(&m->buffer, sizeof *header);
  memset(header, 0, sizeof *header);
  header->magic = MAGIC;
  header->kind = kind;
  header->step = step;
  return header;
}

static size_t Padded(size_t bytes)
{
  return (bytes + UNIT - 1) / UNIT * UNIT;
}

void MessageAdd(Message *m, const void *block, size_t bytes)
{
  m->last = m->buffer.size;
  char *to = BufferExtend(&m->buffer, Padded(bytes));
  if (block && bytes) memcpy(to, block, bytes);
  memset(to + bytes, 0, Padded(bytes) - bytes);
}

MessageHeader *MessageHeaderOf(const Message *m)
{
  return (MessageHeader *)(void *)m->buffer.data;
}

static const char *KindName(int kind)
{
  return kind > 0 && kind < KIND_END ? KIND_NAMES[kind] : "?";
}

/* The partner may sleep until this message has come, or until that of its own has been taken. */
static void Wake(Participant *p, const Message *m)
{
  DoorbellRing(p->waiter.doorbell, p->world[m->role][m->rank]);
}

static bool PartnerRings(const Participant *p, const Message *m)
{
  return DoorbellReaches(p->waiter.doorbell, p->world[m->role][m->rank]);
}

void MessageSend(Participant *p, Message *m)
{
  const size_t units = m->buffer.size / UNIT;
  if (units > INT32_MAX)
    ParticipantFail(p, "%s of %zu bytes for %s rank %d is too long for one message: use more ranks",
                    KindName(MessageHeaderOf(m)->kind), m->buffer.size, ROLE_NAMES[m->role], m->rank);
  MPI_Isend(m->buffer.data, (int)units, MPI_UINT64_T, p->world[m->role][m->rank], TAG, p->link, &m->request);
  Wake(p, m);
}

static const char *Host(const Participant *p, const Message *m)
{
  return p->host[p->world[m->role][m->rank]];
}

void MessageFinish(Participant *p, Message *m)
{
  const double start = WaitClock();
  if (!WaitRequest(&p->waiter, &m->request, PartnerRings(p, m)))
    ParticipantFail(
        p, "%s rank %d on %s has not taken %s of step %d within %g s: does it hang? (CORACLE_TIMEOUT)",
        ROLE_NAMES[m->role], m->rank, Host(p, m), KindName(MessageHeaderOf(m)->kind),
        MessageHeaderOf(m)->step, p->waiter.timeout);
  ParticipantWaited(p, m->role, m->rank, "to take it", start);
}

/* --- receiving ------------------------------------------------------------------------------------------ */

/* Twice: a probe of Open MPI looks first and fetches what has come after that. */
static bool HasArrived(Participant *p, const Message *m, MPI_Message *arrived, MPI_Status *status)
{
  int here = 0;
  for (int i = 0; i < 2 && !here; i++)
    MPI_Improbe(p->world[m->role][m->rank], TAG, p->link, &here, arrived, status);
  return here;
}

static void WaitForIt(Participant *p, const Message *m, MessageKind kind, int step, MPI_Message *arrived,
                      int *units)
{
  Wait wait = WaitStart(&p->waiter, WAIT_FOR_ARRIVAL, PartnerRings(p, m));
  MPI_Status status;
  while (!HasArrived(p, m, arrived, &status)) {
    if (!WaitPause(&wait))
      ParticipantFail(p,
                      "waited %g s for %s of step %d from %s rank %d on %s: does it hang? (CORACLE_TIMEOUT)",
                      p->waiter.timeout, KindName(kind), step, ROLE_NAMES[m->role], m->rank, Host(p, m));
  }
  WaitEnd(&wait);
  ParticipantWaited(p, m->role, m->rank, KindName(kind), wait.start);
  MPI_Get_count(&status, MPI_UINT64_T, units);
}

const MessageHeader *MessageReceive(Participant *p, Message *m, MessageKind kind, MessageKind other, int step)
{
  MPI_Message arrived;
  int units;
  WaitForIt(p, m, kind, step, &arrived, &units);
  BufferResize(&m->buffer, (size_t)units * UNIT);
  MPI_Mrecv(m->buffer.data, units, MPI_UINT64_T, &arrived, MPI_STATUS_IGNORE);
  Wake(p, m);
  const MessageHeader *h = MessageHeaderOf(m);
  if (m->buffer.size < sizeof *h || h->magic != MAGIC)
    ParticipantFail(p, "what came from %s rank %d is no message of Coracle's", ROLE_NAMES[m->role], m->rank);
  if ((h->kind != (int)kind && h->kind != (int)other) || h->step != step)
    ParticipantFail(p, "expected %s of step %d from %s rank %d, got %s of step %d", KindName(kind), step,
                    ROLE_NAMES[m->role], m->rank, KindName(h->kind), h->step);
  m->at = sizeof *h;
  return h;
}

const void *MessageTake(Participant *p, Message *m, size_t bytes)
{
  const char *block = m->buffer.data + m->at;
  if (m->at + Padded(bytes) > m->buffer.size)
    ParticipantFail(p, "%s of step %d from %s rank %d is shorter than its counts say",
                    KindName(MessageHeaderOf(m)->kind), MessageHeaderOf(m)->step, ROLE_NAMES[m->role],
                    m->rank);
  m->at += Padded(bytes);
  return block;
}

/* Eight sums side by side, each 0 unless a value is not finite. */
static bool AllFinite(size_t n, const double array[])
{
  enum { WIDTH = 8 };
  double sum[WIDTH] = {0.0}, rest = 0.0;
  const size_t whole = n / WIDTH * WIDTH;
  for (size_t i = 0; i < whole; i += WIDTH)
    for (size_t k = 0; k < WIDTH; k++) sum[k] += 0.0 * array[i + k];
  for (size_t i = whole; i < n; i++) rest += 0.0 * array[i];
  for (size_t k = 0; k < WIDTH; k++) rest += sum[k];
  return rest == 0.0;
}

/* The entry that has a row. */
static size_t EntryOf(size_t row, const char carries[])
{
  size_t entry = 0;
  if (!carries) return row;
  for (row++;; entry++)
    if (carries[entry] && --row == 0) return entry;
}

void MessageCheckFinite(Participant *p, const char *field, const char *entry, const char carries[], size_t n,
                        int per, const double array[])
{
  if (AllFinite(n * (size_t)per, array)) return;
  for (size_t i = 0; i < n * (size_t)per; i++)
    if (!isfinite(array[i]))
      ParticipantFail(p, "%s is %g at %s %zu, component %zu, in step %d", field, array[i], entry,
                      EntryOf(i / (size_t)per, carries), i % (size_t)per, p->step);
}
