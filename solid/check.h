/* --help, --version, --check, --draw and --keys of coracle-solid (common/link/command_line.h). */
#ifndef CORACLE_SOLID_CHECK_H
#define CORACLE_SOLID_CHECK_H
#include "common/link/command_line.h"

/* Returns the program's exit status. */
int SolidAnswer(Command command, int argc, char **argv);
#endif
