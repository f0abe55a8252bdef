#include "common/link/wait.h"
#include <math.h>
#include <sched.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static const double SPIN = 20e-6, YIELD = 100e-6, SHORT = 200e-6, LONG = 1e-3; /* s */
static const double RUNG = 50e-3; /* s: the longest sleep of one that will be woken */
static const double STOPPED =
    1.0; /* s: more between two looks than any pause; a signal has stopped the process */

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

Wait WaitStart(Waiter *w, WaitFor what, bool rings)
{
  const double now = WaitClock();
  Wait wait = {.waiter = w, .start = now, .looked = now, .what = what, .rings = w->doorbell && rings};
  if (wait.rings) wait.rung = DoorbellRings(w->doorbell);
  return wait;
}

static void Sleep(double seconds)
{
  nanosleep(&(struct timespec){.tv_sec = (time_t)seconds, .tv_nsec = (long)(1e9 * fmod(seconds, 1.0))}, NULL);
}

/* A sender looks often in any case: MPI may need it for the message to move. */
static void SleepUntilRung(Wait *wait, double waited)
{
  const Doorbell doorbell = wait->waiter->doorbell;
  DoorbellSleep(doorbell, wait->rung, wait->what == WAIT_FOR_ARRIVAL ? RUNG : Pause(waited));
  wait->rung = DoorbellRings(doorbell);
}

bool WaitPause(Wait *wait)
{
  const WaitPolicy policy = wait->waiter->policy;
  if (policy == WAIT_SPIN && ++wait->looks % 1024) return true; /* the clock is dearer than a look */
  const double now = WaitClock(), waited = now - wait->start;
  if (now - wait->looked > STOPPED) wait->stopped += now - wait->looked;
  wait->looked = now;
  if (waited - wait->stopped > wait->waiter->timeout) return false;
  if (policy == WAIT_SPIN || waited < SPIN) return true;
  if (policy == WAIT_SLEEP && wait->rings)
    SleepUntilRung(wait, waited);
  else if (policy == WAIT_YIELD || waited < YIELD)
    sched_yield();
  else
    Sleep(Pause(waited));
  return true;
}

void WaitEnd(Wait *wait)
{
  wait->waiter->waited += WaitClock() - wait->start;
}

bool WaitRequest(Waiter *w, MPI_Request *request, bool rings)
{
  Wait wait = WaitStart(w, WAIT_FOR_REQUEST, rings);
  int done = 0;
  for (;;) {
    MPI_Test(request, &done, MPI_STATUS_IGNORE);
    if (done || !WaitPause(&wait)) break;
  }
  WaitEnd(&wait);
  return done != 0;
}
