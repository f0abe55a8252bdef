/* --help, --version, --check, --draw and --keys of coracle-coupler (common/link/command_line.h). */
#ifndef CORACLE_COUPLER_CHECK_H
#define CORACLE_COUPLER_CHECK_H
#include "common/link/command_line.h"

/* Returns the program's exit status. */
int CouplerAnswer(Command command, int argc, char **argv);
#endif
