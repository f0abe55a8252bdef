/* What a program answers by itself, without a job: --help, --version, --check and --keys.
 *
 *     coracle-fluid --check case.yaml [--set key=value]...     all faults of the case that concern the fluid, and what a
 *                                                              run would be made of; touches no output
 *     coracle-fluid --draw case.yaml [--set key=value]...      as --check, and writes the first snapshot into output.folder
 *     coracle-fluid --keys case.yaml                           the keys that the fluid reads of this case (CoracleCaseKeysOf)
 *
 * One process each, no coupler, no messages. */
#ifndef CORACLE_COMMAND_LINE_H
#define CORACLE_COMMAND_LINE_H
#include "common/link/case_file.h"

typedef enum {
  COMMAND_RUN,
  COMMAND_HELP,
  COMMAND_VERSION,
  COMMAND_CHECK,
  COMMAND_DRAW,
  COMMAND_KEYS
} Command;

/* Which of them argv asks for, and takes it out of argv. */
Command CommandTake(int *argc, char **argv);

/* A program's own part. */
typedef struct {
  const char *role;    /* "fluid" */
  const char *options; /* lines for --help about options of its own, or "" */
  /* context is a Command: of CHECK, DRAW, KEYS; prints what a run would be made of when CoracleCaseFaultless, but for KEYS */
  CoracleCaseReader read;
} CommandAnswers;

/* Answers; returns the program's exit status: 0, or 1 when the case has faults. */
int CommandAnswer(Command command, const CommandAnswers *answers, int argc, char **argv);
#endif
