/* Mutants of case files, read as by --check: each is refused with lines that say why, or accepted with what a run would be made
 * of; in a process of its own, so that a crash, a hang (20 s) or a report of a sanitizer is found.
 * Usage: fuzz_case COUNT SEED FILE...; compiled for a room by ANSWER. */
#include "tests/check.h"
#include "tests/hardening/fuzz.h"
#include ANSWER_HEADER
#include <petscsys.h>
#include <sys/wait.h>
#include <unistd.h>

/* In the child. */
static void Read(const char *path, const char *log)
{
  char *argv[] = {(char *)(size_t) "coracle", (char *)(size_t)path, NULL};
  if (!freopen(log, "w", stdout) || dup2(fileno(stdout), STDERR_FILENO) < 0) _exit(2);
  alarm(20);
  const int status = ANSWER(COMMAND_CHECK, 2, argv);
  fflush(NULL);
  _exit(status);
}

static void Judge(int mutant, int status, const char *path, const char *log)
{
  const Text said = FuzzRead(log);
  const int exited = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  CHECK(!strstr(said.byte, "Sanitizer") && !strstr(said.byte, "runtime error"), "mutant %d (kept as %s): %s",
        mutant, path, said.byte);
  if (exited == 0)
    CHECK(said.n > 0 && !strstr(said.byte, "nan") && !strstr(said.byte, "inf "), "mutant %d is accepted: %s",
          mutant, said.byte);
  else
    CHECK(exited == 1 && strstr(said.byte, "coracle "), "mutant %d (kept as %s) ends with %s %d: %s", mutant,
          path, exited < 0 ? "signal" : "status", exited < 0 ? WTERMSIG(status) : exited, said.byte);
  free(said.byte);
}

int main(int argc, char **argv)
{
  char path[64], log[64];
  int accepted = 0;
  CHECK(argc > 3, "fuzz_case COUNT SEED FILE...");
  const int count = atoi(argv[1]);
  unsigned long long state = strtoull(argv[2], NULL, 10);
  MPI_Init(NULL, NULL); /* here, so that no child ends MPI */
  PetscCall(PetscInitializeNoArguments());
  snprintf(path, sizeof path, "/tmp/coracle-fuzz-%d.yaml", (int)getpid());
  snprintf(log, sizeof log, "/tmp/coracle-fuzz-%d.log", (int)getpid());
  for (int k = 0; k < count; k++) {
    int status;
    Text whole = FuzzRead(argv[3 + k % (argc - 3)]), mutant = FuzzMutate(&whole, &state);
    FuzzWrite(path, &mutant);
    const pid_t child = fork();
    if (child == 0) Read(path, log);
    CHECK(child > 0 && waitpid(child, &status, 0) == child, "no child for mutant %d", k);
    Judge(k, status, path, log);
    accepted += WIFEXITED(status) && WEXITSTATUS(status) == 0;
    free(whole.byte);
    free(mutant.byte);
  }
  unlink(path);
  unlink(log);
  printf("fuzz_case: %d mutants, %d of them cases\n", count, accepted);
  CHECK(accepted > 0 && accepted < count, "the mutations do not reach far enough");
  PetscCall(PetscFinalize());
  return MPI_Finalize();
}
