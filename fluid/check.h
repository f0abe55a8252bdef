/* --help, --version, --check, --draw and --keys of coracle-fluid (common/link/command_line.h). */
#ifndef CORACLE_FLUID_CHECK_H
#define CORACLE_FLUID_CHECK_H
#include "common/link/command_line.h"

/* Returns the program's exit status. */
int FluidAnswer(Command command, int argc, char **argv);
#endif
