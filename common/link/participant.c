#include "common/link/participant.h"
#include "common/link/affinity.h"
#include "common/link/exit_guard.h"
#include "common/link/fields.h"
#include "common/link/launcher_watch.h"
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

/* --- failing -------------------------------------------------------------------------------------------- */

/* What a host has set to be called with the message of an error. */
static struct {
  void (*f)(void *context, const char *message);
  void *context;
} HANDLER;

void ParticipantSetErrorHandler(void (*f)(void *context, const char *message), void *context)
{
  HANDLER.f = f;
  HANDLER.context = context;
}

static void Report(const char *role, int rank, const char *message)
{
  fflush(stdout);
  fprintf(stderr, "coracle %s[%d]: error: %s\n", role, rank, message);
}

/* Until the reader of a pipe has taken all, a second at most: MPICH's launcher drops at MPI_Abort what it has not read. */
static void AwaitReader(int file)
{
  struct stat s;
  int left = 0;
  if (fstat(file, &s) || !S_ISFIFO(s.st_mode)) return;
  for (int k = 0; k < 1000 && !ioctl(file, FIONREAD, &left) && left > 0; k++)
    nanosleep(&(struct timespec){.tv_nsec = 1000000}, NULL);
}

void ParticipantAbort(void)
{
  fflush(NULL);
  AwaitReader(STDOUT_FILENO);
  AwaitReader(STDERR_FILENO);
  LauncherWatch();
  MPI_Abort(MPI_COMM_WORLD, 1);
  for (;;) pause(); /* until the launcher has ended this process */
}

static _Noreturn void Abort(const char *message)
{
  int started;
  fflush(NULL);
  ExitGuardExpected();
  if (HANDLER.f) HANDLER.f(HANDLER.context, message);
  MPI_Initialized(&started);
  if (!started) _exit(1);
  ParticipantAbort();
}

void ParticipantFailList(Participant *p, const char *format, va_list list)
{
  static bool reporting; /* a host whose handler goes on may cause more than one error */
  char text[HANDSHAKE_MESSAGE];
  vsnprintf(text, sizeof text, format, list);
  ExitGuardExpected();
  reporting = reporting || !p || FailureBoardClaim(p->failures);
  if (reporting)
    Report(p ? ROLE_NAMES[p->role] : "client", p ? p->rank : 0, text);
  else
    sleep(5); /* another rank reports and ends the job */
  Abort(text);
}

void ParticipantFail(Participant *p, const char *format, ...)
{
  va_list list;
  va_start(list, format);
  ParticipantFailList(p, format, list);
}

/* Before there is a board: the first rank of the job that is there reports for all and ends it, the others wait for that. */
static _Noreturn void RefuseToStart(int rank, const char *role, const char *message)
{
  if (rank) sleep(4 + (unsigned)rank);
  Report(role, 0, message);
  Abort(message);
}

/* --- joining -------------------------------------------------------------------------------------------- */

/* The launcher takes its time to start all programs. */
static const double STARTING = 10.0; /* s */

static char UNSTARTED[256];

static void OnUnstarted(int signal_number)
{
  const ssize_t written = write(STDERR_FILENO, UNSTARTED, strlen(UNSTARTED));
  _exit(written < 0 ? 2 : 1);
}

/* The rank as launchers tell it before MPI_Init. */
static int LaunchedRank(void)
{
  static const char *const NAMES[] = {"OMPI_COMM_WORLD_RANK", "PMIX_RANK", "PMI_RANK", "SLURM_PROCID"};
  for (size_t k = 0; k < sizeof NAMES / sizeof *NAMES; k++) {
    const char *value = getenv(NAMES[k]);
    if (value) return atoi(value);
  }
  return 0;
}

/* MPI_Init waits for all ranks of the job, also for a program that never calls it: an alarm ends the wait, on the first rank first. */
static void InitWithin(const char *role, double seconds)
{
  const struct sigaction action = {.sa_handler = OnUnstarted};
  struct sigaction before;
  snprintf(UNSTARTED, sizeof UNSTARTED,
           "coracle %s[0]: error: not all programs of this job have called MPI_Init within %g s "
           "(CORACLE_TIMEOUT, and %g s "
           "to start)\n",
           role, seconds, STARTING);
  const int later = LaunchedRank() < 10 ? LaunchedRank() : 10;
  sigaction(SIGALRM, &action, &before);
  const unsigned left = alarm((unsigned)ceil(seconds) + 2 * (unsigned)later);
  MPI_Init(NULL, NULL);
  alarm(left);
  sigaction(SIGALRM, &before, NULL);
}

static bool StartMpi(const char *role)
{
  int initialized;
  Waiter w;
  MPI_Initialized(&initialized);
  if (initialized) return false;
  AffinityEnvironment();
  if (!WaiterInit(&w, true) && w.timeout < 1e6)
    InitWithin(role, w.timeout + STARTING);
  else
    MPI_Init(NULL, NULL);
  return true;
}

static unsigned long long HashArguments(int argc, char **argv)
{
  unsigned long long hash = 14695981039346656037ULL;
  for (int i = 1; i < argc; i++)
    for (const char *c = argv[i];; c++) {
      hash = (hash ^ (unsigned char)*c) * 1099511628211ULL;
      if (!*c) break;
    }
  return hash;
}

static void Describe(const char *role, bool client, int argc, char **argv, HandshakeEntry *e)
{
  int *context, known;
  CoracleCase c;
  memset(e, 0, sizeof *e);
  snprintf(e->role, sizeof e->role, "%s", role);
  snprintf(e->version, sizeof e->version, "%s, protocol %08x", CORACLE_VERSION, FieldsProtocol());
  gethostname(e->host, sizeof e->host - 1);
  if (readlink("/proc/self/exe", e->program, sizeof e->program - 1) < 0)
    snprintf(e->program, sizeof e->program, "%s", argc > 0 ? argv[0] : "?");
  MPI_Comm_get_attr(MPI_COMM_WORLD, MPI_APPNUM, &context, &known);
  e->context = known ? *context : -1;
  e->argument_hash = HashArguments(argc, argv);
  if (client && !strcmp(role, "coupler"))
    snprintf(e->problem, sizeof e->problem, "CoracleOpen joins a fluid or a solid, not a coupler");
  else if (CaseLoad(argc, argv, e->problem, &c) == 0) {
    snprintf(e->case_path, sizeof e->case_path, "%s", CoracleCasePath(c));
    e->file_hash = c->file_hash;
    e->set_hash = c->set_hash;
    CoracleCaseClose(&c);
  }
}

/* Every rank sends its entry to rank 0, which ends the job if they cannot run together. */
static void Handshake(MPI_Comm job, const HandshakeEntry *mine, Waiter *waiter)
{
  char absent[128], message[HANDSHAKE_MESSAGE];
  int rank, size;
  MPI_Request request;
  MPI_Comm_rank(job, &rank);
  MPI_Comm_size(job, &size);
  HandshakeEntry *entry = rank ? NULL : calloc((size_t)size, sizeof *entry);
  snprintf(absent, sizeof absent,
           "not all %d ranks of this job have called CoracleOpen within %g s (CORACLE_TIMEOUT)", size,
           waiter->timeout);
  MPI_Igather(mine, sizeof *mine, MPI_BYTE, entry, sizeof *entry, MPI_BYTE, 0, job, &request);
  if (!WaitRequest(waiter, &request, false)) RefuseToStart(rank, mine->role, absent);
  if (rank == 0 && !HandshakeCheck(size, entry, message)) RefuseToStart(0, mine->role, message);
  if (rank == 0 && HandshakeNote(size, entry, message)) fprintf(stderr, "coracle: note: %s\n", message);
  free(entry);
  MPI_Ibarrier(job, &request); /* no rank continues before rank 0 has agreed */
  if (!WaitRequest(waiter, &request, false)) RefuseToStart(rank, mine->role, absent);
}

static void MapRoles(Participant *p, const HandshakeEntry *mine)
{
  int rank, size, role = HandshakeRole(mine->role);
  MPI_Comm_rank(p->job, &rank);
  MPI_Comm_size(p->job, &size);
  int *roles = malloc((size_t)size * sizeof *roles);
  p->host = malloc((size_t)size * sizeof *p->host);
  MPI_Allgather(&role, 1, MPI_INT, roles, 1, MPI_INT, p->job);
  MPI_Allgather(mine->host, sizeof mine->host, MPI_BYTE, p->host, sizeof mine->host, MPI_BYTE, p->job);
  for (int k = 0; k < NROLES; k++) p->world[k] = malloc((size_t)size * sizeof(int));
  for (int i = 0; i < size; i++) p->world[roles[i]][p->count[roles[i]]++] = i;
  free(roles);
  p->role = (Role)role;
  MPI_Comm_split(p->job, role, rank, &p->app);
  MPI_Comm_rank(p->app, &p->rank);
  MPI_Comm_size(p->app, &p->size);
  MPI_Comm_dup(p->job, &p->link);
  TraceOpen(&p->trace, p->job, p->role, p->rank, !strcmp(mine->host, p->host[0]));
}

static void Refuse(void *p, const char *message)
{
  ParticipantFail(p, "%s", message);
}

bool ParticipantFindResume(CoracleCase c, size_t size, char folder[])
{
  struct stat link;
  folder[0] = 0;
  const char *resume = CoracleCaseStringOr(c, "resume", "");
  const bool last = !strcmp(resume, "last");
  if (last)
    snprintf(folder, size, "%s/" CORACLE_CHECKPOINT, CoracleCaseString(c, "output.folder"));
  else
    snprintf(folder, size, "%s", resume);
  if (!folder[0] || !access(folder, F_OK)) return false;
  if (!last || !lstat(folder, &link)) CoracleCaseRefuse(c, "resume", "there is no checkpoint '%s'", folder);
  folder[0] = 0;
  return true;
}

/* What the library itself has from the case: rank 0 looks for all. */
static void ReadCase(Participant *p, int argc, char **argv)
{
  struct {
    char folder[4096];
    bool trace;
  } read;
  CoracleCase c;
  if (p->rank == 0) {
    CoracleCaseOpen(argc, argv, Refuse, p, &c);
    if (ParticipantFindResume(c, sizeof read.folder, read.folder) && p->role == ROLE_COUPLER)
      printf("coracle: there is no %s/" CORACLE_CHECKPOINT ": begins at the start\n",
             CoracleCaseString(c, "output.folder"));
    if (read.folder[0]) ParticipantLoadUsed(p, read.folder);
    read.trace = CoracleCaseBoolOr(c, "output.trace", false);
    CoracleCaseClose(&c);
  }
  MPI_Bcast(&read, sizeof read, MPI_BYTE, 0, p->app);
  if (read.folder[0]) p->resume = strdup(read.folder);
  p->trace.on = read.trace;
}

int ParticipantOpen(MPI_Comm job, const char *role, bool client, int argc, char **argv,
                    Participant **participant)
{
  Participant *p = calloc(1, sizeof *p);
  p->dim = CORACLE_DIM;
  HandshakeEntry mine;
  Affinity share;
  p->started_mpi = StartMpi(role);
  p->job = job == MPI_COMM_NULL ? MPI_COMM_WORLD : job;
  p->start = WaitClock();
  /* until all have come nothing else may wait for them, and so nobody knows whether they share cores */
  const char *wrong = WaiterInit(&p->waiter, true);
  Describe(role, client, argc, argv, &mine);
  if (ExitGuardWatched()) wrong = "this process has joined already";
  if (wrong) snprintf(mine.problem, sizeof mine.problem, "%s", wrong);
  Handshake(p->job, &mine, &p->waiter);
  AffinityGet(p->job, &share);
  p->shared = share.shared;
  WaiterInit(&p->waiter, share.shared);
  MapRoles(p, &mine);
  /* when one hangs all wait: the coupler, whose partners they all are, gives up first and so names the one */
  if (client) p->waiter.timeout = 1.1 * p->waiter.timeout + 1.0;
  FailureBoardOpen(p->job, role, p->rank, &p->failures);
  DoorbellOpen(p->job, &p->waiter.doorbell);
  ExitGuardWatch(p);
  if (share.pinned) AffinityNotePinned(role, p->rank);
  ReadCase(p, argc, argv);
  *participant = p;
  return 0;
}

void ParticipantStep(Participant *p, int step)
{
  p->step = step;
  FailureBoardStep(p->failures, step);
  TraceStep(&p->trace, step);
}

void ParticipantWaited(Participant *p, Role role, int rank, const char *what, double start)
{
  const double now = WaitClock();
  char text[64];
  p->waited_for[role] += now - start;
  if (!p->trace.on) return;
  snprintf(text, sizeof text, "%s %d: %s", ROLE_NAMES[role], rank, what);
  TraceWait(&p->trace, text, start, now);
}

int ParticipantClose(Participant **participant)
{
  Participant *p = *participant;
  const bool finalize = p->started_mpi;
  ExitGuardExpected();
  ExitGuardUnwatch();
  FailureBoardClose(&p->failures);
  DoorbellClose(&p->waiter.doorbell);
  MPI_Comm_free(&p->link);
  MPI_Comm_free(&p->app);
  for (int k = 0; k < NROLES; k++) free(p->world[k]);
  free(p->host);
  free(p->resume);
  BufferFree(&p->trace.spans);
  free(p);
  *participant = NULL;
  if (finalize) MPI_Finalize();
  return 0;
}
