/* How a rank waits for a message: a blocking receive burns the core that its partner needs when ranks share
 * cores. */
#ifndef CORACLE_WAIT_H
#define CORACLE_WAIT_H
#include "common/link/doorbell.h"

typedef enum {
  WAIT_SPIN,  /* ask again at once: the lowest latency, for ranks with a core of their own */
  WAIT_YIELD, /* give the core away between two looks */
  WAIT_SLEEP  /* sleep until the doorbell rings, or up to 1 ms where it cannot: for ranks that share cores */
} WaitPolicy;

/* What is waited for: a partner's message, or that MPI is done with a request. */
typedef enum { WAIT_FOR_ARRIVAL, WAIT_FOR_REQUEST } WaitFor;

typedef struct {
  WaitPolicy policy;
  double timeout;    /* s */
  double waited;     /* s, all waits of this rank so far */
  Doorbell doorbell; /* borrowed; NULL: there is none */
} Waiter;

/* One wait in progress. */
typedef struct {
  Waiter *waiter;
  double start, looked,
      stopped; /* s, by the clock; of the last look; between looks while this process did not run */
  long looks;
  WaitFor what;
  bool rings;    /* the partner rings the doorbell */
  uint32_t rung; /* how often it had been rung before the last look */
} Wait;

/* Seconds on a clock that never jumps. */
double WaitClock(void);
/* CORACLE_WAIT=spin|yield|sleep, else sleep when the ranks share cores and spin when not; CORACLE_TIMEOUT
 * seconds (default 600).  Returns NULL, or what is wrong with the environment. */
const char *WaiterInit(Waiter *w, bool shares_core);
/* rings: who ends the wait rings the doorbell then. */
Wait WaitStart(Waiter *w, WaitFor what, bool rings);
/* Called between two looks; false when the time-out has passed, without what the process was stopped for (SIGSTOP; SIGCONT). */
bool WaitPause(Wait *wait);
void WaitEnd(Wait *wait);
/* Waits for a request; false when the time-out has passed. */
bool WaitRequest(Waiter *w, MPI_Request *request, bool rings);
#endif
