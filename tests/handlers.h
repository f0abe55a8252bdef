/* Handlers of SIGTERM and SIGABRT that a test sets, and that METIS, which has handlers of its own while it works, must leave as they are. */
#ifndef TESTS_HANDLERS_H
#define TESTS_HANDLERS_H
#include "tests/check.h"
#include <signal.h>

static inline void OnSignal(int number, siginfo_t *info, void *context) {}

static inline void HandlersSet(void)
{
  const struct sigaction action = {.sa_sigaction = OnSignal, .sa_flags = SA_SIGINFO | SA_ONSTACK};
  CHECK(!sigaction(SIGTERM, &action, NULL) && !sigaction(SIGABRT, &action, NULL), "no handlers");
}

static inline void HandlersCheck(void)
{
  static const int NUMBER[] = {SIGTERM, SIGABRT};
  struct sigaction now;
  for (int k = 0; k < 2; k++) {
    CHECK(!sigaction(NUMBER[k], NULL, &now) && now.sa_sigaction == OnSignal, "another handler of signal %d",
          NUMBER[k]);
    CHECK((now.sa_flags & (SA_SIGINFO | SA_ONSTACK)) == (SA_SIGINFO | SA_ONSTACK), "flags %d of signal %d",
          now.sa_flags, NUMBER[k]);
  }
}
#endif
