/* Ranks that wait leave the core to others: a library to preload (LD_PRELOAD) where ranks share cores and MPICH waits through UCX (ch4:ucx,
 * Debian's).  MPICH 4.0 polls there without ever yielding, and MPIR_CVAR_POLLS_BEFORE_YIELD has no effect.  scripts/mpich.sh builds it. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <sched.h>

unsigned ucp_worker_progress(void *worker);

/* In place of UCX's function: yields where there was no progress. */
unsigned ucp_worker_progress(void *worker)
{
  static unsigned (*original)(void *);
  if (!original) *(void **)&original = dlsym(RTLD_NEXT, "ucp_worker_progress");
  const unsigned events = original(worker);
  if (!events) sched_yield();
  return events;
}
