#include "common/link/command_line.h"
#include "common/link/coracle.h"
#include <stdlib.h>
#include <string.h>

static const char *const WORDS[] = {"", "--help", "--version", "--check", "--draw", "--keys"};

Command CommandTake(int *argc, char **argv)
{
  Command found = COMMAND_RUN;
  int kept = 1;
  for (int i = 1; i < *argc; i++) {
    Command is = COMMAND_RUN;
    for (int k = COMMAND_HELP; k <= COMMAND_KEYS; k++)
      if (!strcmp(argv[i], WORDS[k])) is = (Command)k;
    if (!strcmp(argv[i], "-h")) is = COMMAND_HELP;
    if (is == COMMAND_RUN)
      argv[kept++] = argv[i];
    else
      found = is;
    if (is == COMMAND_RUN && !strcmp(argv[i], "--set") && i + 1 < *argc) argv[kept++] = argv[++i];
  }
  *argc = kept;
  argv[kept] = NULL;
  return found;
}

static void Help(const CommandAnswers *a)
{
  printf(
      "coracle-%s: the %s of a coupled run of fluid, coupler and solid.\n"
      "\n"
      "  coracle-%s [option] case.yaml [--set key=value]...\n"
      "\n"
      "In a run all three programs are started in one mpirun with the same arguments (scripts/launch.sh does "
      "it):\n"
      "  mpirun -n 2 coracle-fluid case.yaml : -n 1 coracle-coupler case.yaml : -n 1 coracle-solid "
      "case.yaml\n"
      "\n"
      "  --set key=value  replaces or adds a key of the case file: --set solid.bodies[0].size=0.01\n"
      "  --check          tells all faults of the case that concern the %s, and what a run would be made of\n"
      "  --draw           as --check, and writes the first snapshot into output.folder\n"
      "  --keys           lists the keys that are read of this case\n"
      "%s"
      "  --version, --help\n",
      a->role, a->role, a->role, a->role, a->options);
}

/* The context of CoracleCaseCheck and CoracleCaseKeysOf. */
typedef struct {
  const CommandAnswers *answers;
  Command command;
} Asked;

static void Tell(void *context, const char *message)
{
  printf("coracle %s: %s\n", ((const Asked *)context)->answers->role, message);
}

static void Fail(void *context, const char *message)
{
  fprintf(stderr, "coracle %s: error: %s\n", ((const Asked *)context)->answers->role, message);
  exit(1);
}

static void Read(CoracleCase c, void *context)
{
  Asked *asked = context;
  asked->answers->read(c, &asked->command);
}

int CommandAnswer(Command command, const CommandAnswers *answers, int argc, char **argv)
{
  Asked asked = {answers, command};
  if (command == COMMAND_HELP) {
    Help(answers);
    return 0;
  }
  if (command == COMMAND_VERSION) {
    printf("coracle-%s %s\n", answers->role, CORACLE_VERSION);
    return 0;
  }
  if (command == COMMAND_KEYS) return CoracleCaseKeysOf(argc, argv, Read, &asked, Fail, stdout);
  return CoracleCaseCheck(argc, argv, Read, &asked, Tell) > 0;
}
