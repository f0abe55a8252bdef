#include "common/link/failure_board.h"
#include <dlfcn.h>
#include <errno.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

typedef struct {
  _Atomic int pid, step; /* pid 0: closed in good order */
  int rank;
  char role[16];
} FailureSlot;

typedef struct {
  _Atomic int claimed;
  FailureSlot slot[];
} FailureMemory;

struct FailureBoard_s {
  MPI_Comm node; /* the ranks of this computer */
  MPI_Win window;
  FailureMemory *memory;
  FailureSlot *mine;
  int n;
  char prefix[64]; /* "coracle solid[0]: " */
};

static FailureBoard WATCHED; /* what the signal handler looks at: a process has one board */

/* --- in the signal handler: nothing but async-signal-safe calls ----------------------------------------- */

static char *PutText(char *to, char *end, const char *text)
{
  while (*text && to < end) *to++ = *text++;
  return to;
}

static char *PutNumber(char *to, char *end, int value)
{
  char digits[12], *d = digits + sizeof digits;
  *--d = '\0';
  do *--d = (char)('0' + value % 10);
  while ((value /= 10) > 0);
  return PutText(to, end, d);
}

static const FailureSlot *FindDead(const FailureBoard b)
{
  for (int i = 0; i < b->n; i++) {
    const int pid = b->memory->slot[i].pid;
    if (pid > 0 && kill(pid, 0) && errno == ESRCH) return &b->memory->slot[i];
  }
  return NULL;
}

static void SayWhoDied(const FailureBoard b)
{
  char text[256], *end = text + sizeof text, *to = PutText(text, end, b->prefix);
  const FailureSlot *dead = FindDead(b);
  if (dead) {
    to = PutText(to, end, "error: ");
    to = PutText(to, end, dead->role);
    to = PutText(to, end, " rank ");
    to = PutNumber(to, end, dead->rank);
    to = PutText(to, end, " (process ");
    to = PutNumber(to, end, dead->pid);
    to = PutText(to, end, ") died in step ");
    to = PutNumber(to, end, dead->step);
    to = PutText(to, end, ", killed or crashed: the job ends\n");
  } else {
    to = PutText(to, end, "ended by the launcher in step ");
    to = PutNumber(to, end, b->mine->step);
    to = PutText(to, end, "\n");
  }
  if (write(STDERR_FILENO, text, (size_t)(to - text)) < 0) return; /* stderr is closed */
}

/* "<prefix>error: received <name> in step <n>: the job ends" */
static void ReportSignal(const FailureBoard b, const char *name)
{
  char text[256], *end = text + sizeof text, *to = PutText(text, end, b->prefix);
  to = PutText(to, end, "error: received ");
  to = PutText(to, end, name);
  to = PutText(to, end, " in step ");
  to = PutNumber(to, end, b->mine->step);
  to = PutText(to, end, ": the job ends\n");
  if (write(STDERR_FILENO, text, (size_t)(to - text)) < 0) return; /* stderr is closed */
}

/* As if there were no handler: the launcher then ends the other ranks. */
static void Die(int signal_number)
{
  signal(signal_number, SIG_DFL);
  raise(signal_number);
}

/* From the launcher, this process's parent, which ends all ranks; or from anybody to this rank alone. */
static void OnTerminate(int signal_number, siginfo_t *from, void *context)
{
  const int saved = errno;
  const FailureBoard b = WATCHED;
  if (b) {
    /* the others stay a moment, so that the rank that reports does not take them for dead ones */
    if (!FailureBoardClaim(b))
      nanosleep(&(struct timespec){.tv_nsec = 300000000}, NULL);
    else if (from->si_pid == getppid())
      SayWhoDied(b);
    else
      ReportSignal(b, "SIGTERM");
  }
  errno = saved;
  Die(signal_number);
}

static const struct {
  int number;
  const char *name;
} CRASHES[] = {{SIGSEGV, "SIGSEGV (invalid memory access)"},
               {SIGBUS, "SIGBUS (memory that cannot be accessed)"},
               {SIGFPE, "SIGFPE (invalid arithmetic)"},
               {SIGILL, "SIGILL (invalid instruction: built for another processor?)"}};
enum { NCRASHES = sizeof CRASHES / sizeof *CRASHES };

static void OnCrash(int signal_number, siginfo_t *from, void *context)
{
  const FailureBoard b = WATCHED;
  for (int k = 0; b && k < NCRASHES; k++)
    if (CRASHES[k].number == signal_number && FailureBoardClaim(b)) ReportSignal(b, CRASHES[k].name);
  Die(signal_number);
}

/* --- in ordinary code ----------------------------------------------------------------------------------- */

typedef void (*SignalHandler)(int signal_number, siginfo_t *from, void *context);

/* Whether nobody handles the signal but Open MPI, which prints the stack: a host program's handler stays. */
static bool IsFree(const struct sigaction *now)
{
  Dl_info info;
  if (!(now->sa_flags & SA_SIGINFO)) return now->sa_handler == SIG_DFL;
  return dladdr((void *)(size_t)now->sa_sigaction, &info) && info.dli_fname &&
         strstr(info.dli_fname, "libopen-pal");
}

static void Handle(int signal_number, SignalHandler handler)
{
  struct sigaction now, action = {.sa_sigaction = handler, .sa_flags = SA_SIGINFO | SA_ONSTACK};
  if (sigaction(signal_number, NULL, &now) == 0 && IsFree(&now)) sigaction(signal_number, &action, NULL);
}

static void Release(int signal_number, SignalHandler handler)
{
  struct sigaction now;
  if (sigaction(signal_number, NULL, &now) || !(now.sa_flags & SA_SIGINFO) || now.sa_sigaction != handler)
    return;
  signal(signal_number, SIG_DFL);
}

static void Watch(FailureBoard b)
{
  static char memory[65536]; /* a stack for the handler of a stack that has overflowed */
  const stack_t stack = {.ss_sp = memory, .ss_size = sizeof memory};
  stack_t old;
  WATCHED = b;
  if (sigaltstack(NULL, &old) == 0 && old.ss_flags & SS_DISABLE) sigaltstack(&stack, NULL);
  Handle(SIGTERM, OnTerminate);
  for (int k = 0; k < NCRASHES; k++) Handle(CRASHES[k].number, OnCrash);
}

static void Unwatch(void)
{
  WATCHED = NULL;
  Release(SIGTERM, OnTerminate);
  for (int k = 0; k < NCRASHES; k++) Release(CRASHES[k].number, OnCrash);
}

int FailureBoardOpen(MPI_Comm job, const char *role, int rank, FailureBoard *failures)
{
  FailureBoard b = calloc(1, sizeof *b);
  int me, unit;
  MPI_Aint bytes;
  MPI_Comm_split_type(job, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &b->node);
  MPI_Comm_rank(b->node, &me);
  MPI_Comm_size(b->node, &b->n);
  bytes = me ? 0 : (MPI_Aint)(sizeof(FailureMemory) + (size_t)b->n * sizeof(FailureSlot));
  MPI_Win_allocate_shared(bytes, 1, MPI_INFO_NULL, b->node, &b->memory, &b->window);
  MPI_Win_shared_query(b->window, 0, &bytes, &unit, &b->memory);
  if (me == 0) memset(b->memory, 0, (size_t)bytes);
  MPI_Barrier(b->node);
  b->mine = &b->memory->slot[me];
  b->mine->rank = rank;
  snprintf(b->mine->role, sizeof b->mine->role, "%s", role);
  snprintf(b->prefix, sizeof b->prefix, "coracle %s[%d]: ", role, rank);
  b->mine->pid = (int)getpid();
  MPI_Barrier(b->node);
  Watch(b);
  *failures = b;
  return 0;
}

int FailureBoardClose(FailureBoard *failures)
{
  if (!*failures) return 0;
  Unwatch();
  (*failures)->mine->pid = 0;
  MPI_Win_free(&(*failures)->window);
  MPI_Comm_free(&(*failures)->node);
  free(*failures);
  *failures = NULL;
  return 0;
}

bool FailureBoardClaim(FailureBoard failures)
{
  return atomic_exchange(&failures->memory->claimed, 1) == 0;
}
void FailureBoardStep(FailureBoard failures, int step)
{
  failures->mine->step = step;
}
