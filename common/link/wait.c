#include "common/link/wait.h"
#include <math.h>
#include <sched.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static const double SPIN = 20e-6, YIELD = 100e-6, SHORT = 200e-6, LONG = 1e-3; /* s */

/* Grows fast to 200 us, and after 20 ms to 1 ms: a wake-up is at most 1 % late, and costs next to nothing. */
static double Pause(double waited)
{
  return fmax(fmin(waited / 8, SHORT), fmin(waited / 100, LONG));
}

double WaitClock(void)
{
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

const char *WaiterInit(Waiter *w, bool shares_core)
{
  static const char *const WORDS[] = {"spin", "yield", "sleep"};
  const char *policy = getenv("CORACLE_WAIT"), *timeout = getenv("CORACLE_TIMEOUT");
  *w = (Waiter){.policy = shares_core ? WAIT_SLEEP : WAIT_SPIN, .timeout = 600.0};
  if (policy && *policy) {
    int k = 0;
    while (k < 3 && strcmp(policy, WORDS[k])) k++;
    if (k == 3) return "CORACLE_WAIT must be spin, yield or sleep";
    w->policy = (WaitPolicy)k;
  }
  if (timeout && *timeout) {
    char *end;
    const double seconds = strtod(timeout, &end);
    if (*end || !(seconds > 0.0)) return "CORACLE_TIMEOUT must be a number of seconds > 0";
    w->timeout = seconds;
  }
  return NULL;
}

Wait WaitStart(Waiter *w)
{
  return (Wait){.waiter = w, .start = WaitClock()};
}

bool WaitPause(Wait *wait)
{
  const WaitPolicy policy = wait->waiter->policy;
  if (policy == WAIT_SPIN && ++wait->looks % 1024) return true; /* the clock is dearer than a look */
  const double waited = WaitClock() - wait->start;
  if (waited > wait->waiter->timeout) return false;
  if (policy == WAIT_SPIN || waited < SPIN) return true;
  if (policy == WAIT_YIELD || waited < YIELD) {
    sched_yield();
  } else {
    nanosleep(&(struct timespec){.tv_nsec = (long)(1e9 * Pause(waited))}, NULL);
  }
  return true;
}

void WaitEnd(Wait *wait)
{
  wait->waiter->waited += WaitClock() - wait->start;
}

bool WaitRequest(Waiter *w, MPI_Request *request)
{
  Wait wait = WaitStart(w);
  int done = 0;
  for (;;) {
    MPI_Test(request, &done, MPI_STATUS_IGNORE);
    if (done || !WaitPause(&wait)) break;
  }
  WaitEnd(&wait);
  return done != 0;
}
