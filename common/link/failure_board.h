/* A notice board in memory that the ranks of one computer share.  It serves dying in good order, where
 * messages cannot:
 *   - when many ranks fail at once, the first to claim the board reports, and a run ends with one message;
 *   - when a rank is killed, the launcher ends the others by SIGTERM: one of them finds on the board whose
 *     process is gone, and says so;
 *   - when a rank receives SIGSEGV, SIGBUS, SIGFPE, SIGILL, or a SIGTERM that is not the launcher's, it claims the
 *     board, says so in one line, and dies of the signal.  Handlers that a host program has installed stay.
 * Open and close are collective over the job; the rest is local and needs no MPI. */
#ifndef CORACLE_BOARD_H
#define CORACLE_BOARD_H
#include <mpi.h>
#include <stdbool.h>

typedef struct FailureBoard_s *FailureBoard;

int FailureBoardOpen(MPI_Comm job, const char *role, int rank, FailureBoard *failures);
int FailureBoardClose(FailureBoard *failures);
/* True for one caller on this computer, false for all others. */
bool FailureBoardClaim(FailureBoard failures);
/* The step this rank is in, for the message about its death. */
void FailureBoardStep(FailureBoard failures, int step);
#endif
