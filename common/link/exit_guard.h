/* Notices a participant that leaves before the end of the run: MPI_Finalize called too early (found by an
 * attribute of MPI_COMM_SELF, whose delete function MPI calls first of all) or the program's exit (found by
 * atexit).  Either would leave the other participants waiting for ever. */
#ifndef CORACLE_LEAVING_H
#define CORACLE_LEAVING_H
#include "common/link/participant.h"

void ExitGuardWatch(Participant *p);
void ExitGuardUnwatch(void);
bool ExitGuardWatched(void);
/* From now on leaving is in order, or the job is being ended already. */
void ExitGuardExpected(void);
#endif
