#include "common/link/exit_guard.h"
#include <stdlib.h>

static Participant *WATCHED; /* of this process; NULL when leaving is in order */
static int KEYVAL = MPI_KEYVAL_INVALID;

static int OnFinalize(MPI_Comm comm, int keyval, void *value, void *extra)
{
  if (WATCHED)
    ParticipantFail(
        WATCHED, "left the job in step %d, before the end of the run: MPI_Finalize came before CoracleClose",
        WATCHED->step);
  return MPI_SUCCESS;
}

static void OnExit(void)
{
  int finalized;
  MPI_Finalized(&finalized);
  if (WATCHED && !finalized)
    ParticipantFail(WATCHED, "the program exited in step %d, before the end of the run", WATCHED->step);
}

void ExitGuardWatch(Participant *p)
{
  static bool registered;
  if (!registered) atexit(OnExit);
  registered = true;
  WATCHED = p;
  MPI_Comm_create_keyval(MPI_COMM_NULL_COPY_FN, OnFinalize, &KEYVAL, NULL);
  MPI_Comm_set_attr(MPI_COMM_SELF, KEYVAL, p);
}

void ExitGuardUnwatch(void)
{
  WATCHED = NULL;
  MPI_Comm_delete_attr(MPI_COMM_SELF, KEYVAL);
  MPI_Comm_free_keyval(&KEYVAL);
}

bool ExitGuardWatched(void)
{
  return WATCHED != NULL;
}
void ExitGuardExpected(void)
{
  WATCHED = NULL;
}
