/* How a rank waits for a message: a blocking receive burns the core that its partner needs when ranks share
 * cores. */
#ifndef CORACLE_WAIT_H
#define CORACLE_WAIT_H
#include <mpi.h>
#include <stdbool.h>

typedef enum {
  WAIT_SPIN,  /* ask again at once: the lowest latency, for ranks with a core of their own */
  WAIT_YIELD, /* give the core away between two looks */
  WAIT_SLEEP /* sleep, first for most of what such a wait has taken, then up to 1 ms: for ranks that share cores */
} WaitPolicy;

enum { WAIT_KINDS = 16 }; /* of waits that are alike, 0: of no kind */

typedef struct {
  WaitPolicy policy;
  double timeout;             /* s */
  double waited;              /* s, all waits of this rank so far */
  double last[WAIT_KINDS][2]; /* s, the last two of each kind */
} Waiter;

/* One wait in progress. */
typedef struct {
  Waiter *waiter;
  double start;
  long looks;
  int kind;
  double nap; /* s from the start on; 0: none, or it is over */
} Wait;

/* Seconds on a clock that never jumps. */
double WaitClock(void);
/* CORACLE_WAIT=spin|yield|sleep, else sleep when the ranks share cores and spin when not; CORACLE_TIMEOUT
 * seconds (default 600).  Returns NULL, or what is wrong with the environment. */
const char *WaiterInit(Waiter *w, bool shares_core);
Wait WaitStart(Waiter *w, int kind);
/* Called between two looks; false when the time-out has passed. */
bool WaitPause(Wait *wait);
void WaitEnd(Wait *wait);
/* Waits for a request; false when the time-out has passed. */
bool WaitRequest(Waiter *w, MPI_Request *request);
#endif
