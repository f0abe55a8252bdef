/* A wait ends after its time-out; what a process does not run in between (a job that is stopped and continued) is not waited. */
#include "common/link/wait.h"
#include "tests/check.h"
#include <time.h>

int main(void)
{
  Waiter w;
  setenv("CORACLE_TIMEOUT", "0.2", 1);
  CHECK(!WaiterInit(&w, true), "not made");
  Wait wait = WaitStart(&w, WAIT_FOR_REQUEST, false);
  for (int k = 0; k < 2; k++) {
    const double before = WaitClock();
    while (WaitClock() - before < 1.1) nanosleep(&(struct timespec){.tv_sec = 1, .tv_nsec = 100000000}, NULL);
    CHECK(WaitPause(&wait), "gave up when it was stopped");
  }
  const double start = WaitClock();
  while (WaitPause(&wait)) continue;
  CHECK(WaitClock() - start > 0.15, "gave up after %g s", WaitClock() - start);
  WaitEnd(&wait);
  CHECK(w.waited > 2.4, "%g s on the clock", w.waited);
  return 0;
}
