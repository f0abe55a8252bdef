// ranks: 2
/* A rank that sleeps is woken: by a ring in every order of ringing and falling asleep, and by each message, of any size. */
#include "common/link/message.h"
#include "tests/check.h"

enum { TURNS = 2000, MESSAGES = 400, LARGE = 100000 };
static const double NEVER = 30.0; /* s: a sleep that has been this long has missed its ring */

/* The ranks ring in turns, each when it has been rung. */
static void RingInTurns(Doorbell d, int rank)
{
  for (int turn = 0; turn < TURNS; turn++) {
    const double start = WaitClock();
    if (turn % 2 == rank) {
      DoorbellRing(d, 1 - rank);
      continue;
    }
    const uint32_t before = (uint32_t)(turn / 2);
    while (DoorbellRings(d) == before) DoorbellSleep(d, before, NEVER);
    CHECK(WaitClock() - start < NEVER, "ring %d has been missed", turn);
  }
}

/* Messages from both sides to and fro: 400 sleeps that end by themselves, after 50 ms each, would take 20 s. */
static void SendInTurns(Participant *p)
{
  static double block[LARGE];
  Message in, out;
  const double start = WaitClock();
  MessageInit(&in, p->role == ROLE_FLUID ? ROLE_COUPLER : ROLE_FLUID, 0);
  MessageInit(&out, in.role, 0);
  for (int i = 0; i < MESSAGES; i++) {
    const size_t bytes = (i % 2 ? LARGE : 1) * sizeof *block;
    for (int k = 0; k < 2; k++) {
      block[0] = i;
      if (k == (p->role == ROLE_FLUID)) {
        MessageStart(&out, KIND_FLOW, i);
        MessageAdd(&out, block, bytes);
        MessageSend(p, &out);
        MessageFinish(p, &out);
      } else {
        MessageReceive(p, &in, KIND_FLOW, KIND_FLOW, i);
        CHECK(*(const double *)MessageTake(p, &in, bytes) == i, "another message than number %d", i);
      }
    }
  }
  CHECK(WaitClock() - start < 10.0, "%d messages took %g s", 2 * MESSAGES, WaitClock() - start);
  MessageFree(&in);
  MessageFree(&out);
}

int main(int argc, char **argv)
{
  static char host[2][64];
  int rank, fluid = 0, coupler = 1;
  MPI_Init(&argc, &argv);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  Participant p = {
      .role = rank ? ROLE_COUPLER : ROLE_FLUID, .job = MPI_COMM_WORLD, .link = MPI_COMM_WORLD, .host = host};
  p.world[ROLE_FLUID] = &fluid;
  p.world[ROLE_COUPLER] = &coupler;
  p.waiter = (Waiter){.policy = WAIT_SLEEP, .timeout = NEVER};
  DoorbellOpen(MPI_COMM_WORLD, &p.waiter.doorbell);
  CHECK(DoorbellReaches(p.waiter.doorbell, 1 - rank), "the ranks are on one computer");
  RingInTurns(p.waiter.doorbell, rank);
  MPI_Barrier(MPI_COMM_WORLD);
  SendInTurns(&p);
  DoorbellClose(&p.waiter.doorbell);
  MPI_Finalize();
  return 0;
}
