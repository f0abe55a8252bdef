#include "common/link/launcher_watch.h"
#include <fcntl.h>
#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <time.h>
#include <unistd.h>

enum { POLLS_PER_SECOND = 20, PATIENCE = 5 * POLLS_PER_SECOND, WATCH = 60 * POLLS_PER_SECOND, FILES = 65536 };

/* The text of a file of /proc, cut at its size; false: there is none. */
static bool ReadText(const char *path, size_t size, char *text)
{
  const int file = open(path, O_RDONLY | O_CLOEXEC);
  if (file < 0) return false;
  const ssize_t n = read(file, text, size - 1);
  close(file);
  text[n > 0 ? n : 0] = '\0';
  return n >= 0;
}

/* Name and state of a process, from /proc/PID/stat: "PID (NAME) STATE ..." */
static bool Look(long pid, char name[16], char *state)
{
  char path[64], text[256];
  snprintf(path, sizeof path, "/proc/%ld/stat", pid);
  return ReadText(path, sizeof text, text) && sscanf(text, "%*d (%15[^)]) %c", name, state) == 2;
}

/* Whether a process lives and is a launcher of Open MPI. */
static bool IsLauncher(pid_t pid)
{
  char name[16], state;
  return Look(pid, name, &state) && state != 'Z' &&
         (!strcmp(name, "mpirun") || !strcmp(name, "mpiexec") || !strcmp(name, "orterun") ||
          !strcmp(name, "orted"));
}

/* Whether none of the processes that it started lives; false where the kernel does not list them. */
static bool IsChildless(pid_t launcher)
{
  char path[64], text[16384], name[16], state;
  snprintf(path, sizeof path, "/proc/%d/task/%d/children", (int)launcher, (int)launcher);
  if (!ReadText(path, sizeof text, text)) return false;
  for (char *at = text, *end;; at = end) {
    const long pid = strtol(at, &end, 10);
    if (end == at) return true;
    if (Look(pid, name, &state) && state != 'Z' && state != 'X') return false;
  }
}

static void Leave(void)
{
  struct rlimit limit;
  setsid();
  const int n = getrlimit(RLIMIT_NOFILE, &limit) || limit.rlim_cur > FILES ? FILES : (int)limit.rlim_cur;
  for (int file = 0; file < n; file++)
    close(file); /* the launcher sees a rank's end at its pipes and sockets */
}

void LauncherWatch(void)
{
  const pid_t launcher = getppid();
  if (!IsLauncher(launcher) || fork()) return;
  Leave();
  for (int poll = 0, still = 0; poll < WATCH && IsLauncher(launcher); poll++) {
    still = IsChildless(launcher) ? still + 1 : 0;
    if (still > PATIENCE) kill(launcher, SIGKILL);
    nanosleep(&(struct timespec){.tv_nsec = 1000000000 / POLLS_PER_SECOND}, NULL);
  }
  _exit(0);
}
