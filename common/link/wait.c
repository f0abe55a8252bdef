#include "common/link/wait.h"
#include <math.h>
#include <sched.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static const double SPIN = 20e-6, YIELD = 100e-6, SHORT = 200e-6, LONG = 1e-3; /* s */
static const double NAP =
    0.7; /* of the shorter of the last two waits of a kind: each look costs some microseconds */

/* Grows fast to 200 us, and after 20 ms to 1 ms: a wake-up is at most 1 % late. */
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

Wait WaitStart(Waiter *w, int kind)
{
  const double nap = NAP * fmin(w->last[kind][0], w->last[kind][1]);
  return (Wait){.waiter = w, .start = WaitClock(), .kind = kind, .nap = kind && nap > LONG ? nap : 0.0};
}

static void Sleep(double seconds)
{
  nanosleep(&(struct timespec){.tv_sec = (time_t)seconds, .tv_nsec = (long)(1e9 * fmod(seconds, 1.0))}, NULL);
}

bool WaitPause(Wait *wait)
{
  const WaitPolicy policy = wait->waiter->policy;
  if (policy == WAIT_SPIN && ++wait->looks % 1024) return true; /* the clock is dearer than a look */
  const double waited = WaitClock() - wait->start;
  if (waited > wait->waiter->timeout) return false;
  if (policy == WAIT_SPIN || (waited < SPIN && wait->nap == 0.0)) return true;
  if (policy == WAIT_YIELD || (waited < YIELD && wait->nap == 0.0)) {
    sched_yield();
  } else {
    Sleep(wait->nap > waited ? wait->nap - waited
                             : fmax(Pause(waited - wait->nap), fmin(waited / 100, LONG)));
  }
  return true;
}

void WaitEnd(Wait *wait)
{
  Waiter *w = wait->waiter;
  const double waited = WaitClock() - wait->start;
  w->waited += waited;
  w->last[wait->kind][1] = w->last[wait->kind][0];
  w->last[wait->kind][0] = waited;
}

bool WaitRequest(Waiter *w, MPI_Request *request)
{
  Wait wait = WaitStart(w, 0);
  int done = 0;
  for (;;) {
    MPI_Test(request, &done, MPI_STATUS_IGNORE);
    if (done || !WaitPause(&wait)) break;
  }
  WaitEnd(&wait);
  return done != 0;
}
