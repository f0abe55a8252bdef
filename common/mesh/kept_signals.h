/* METIS sets handlers of SIGTERM and SIGABRT while it works and restores those that were there with signal(), by which one with
 * SA_SIGINFO is then called without its information, and not on its own stack. */
#ifndef CORACLE_KEPT_SIGNALS_H
#define CORACLE_KEPT_SIGNALS_H
#include <signal.h>

typedef struct {
  struct sigaction term, abort;
} KeptSignals;

/* Before a call of METIS. */
static inline void SignalsKeep(KeptSignals *k)
{
  sigaction(SIGTERM, NULL, &k->term);
  sigaction(SIGABRT, NULL, &k->abort);
}

/* After it. */
static inline void SignalsRestore(const KeptSignals *k)
{
  sigaction(SIGTERM, &k->term, NULL);
  sigaction(SIGABRT, &k->abort, NULL);
}
#endif
