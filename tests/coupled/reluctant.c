/* CoracleBegin and CoracleEnd of a solid that makes steps longer than LONGEST, too, but rejects what has come of them.  With TEST_LATE its state is
 * saved by a function and it asks for the checkpoint's path only when a step has been made. */
#include "common/link/coracle.h"
#include <stdlib.h>
#include <string.h>

#define LONGEST 2e-3 /* s */

static double length; /* of the step, s */

int ReluctantBegin(CoracleClient c, double *t, double *dt, CoracleAction *action);
int ReluctantEnd(CoracleClient c, const double x[]);
int ReluctantBindState(CoracleClient c, void *state, size_t bytes);

typedef struct {
  void *state, *saved;
  size_t bytes;
} Bound;

static int SaveOrRestore(void *context, int save)
{
  const Bound *b = context;
  memcpy(save ? b->saved : b->state, save ? b->state : b->saved, b->bytes);
  return 0;
}

int ReluctantBindState(CoracleClient c, void *state, size_t bytes)
{
  static Bound bound[4];
  static int n;
  if (!getenv("TEST_LATE")) return CoracleBindState(c, state, bytes);
  bound[n] = (Bound){state, malloc(bytes + 1), bytes};
  return CoracleBindStateFunction(c, SaveOrRestore, &bound[n++]);
}

int ReluctantBegin(CoracleClient c, double *t, double *dt, CoracleAction *action)
{
  CoracleBegin(c, t, dt, action);
  length = *dt;
  if (*action == CORACLE_STOP && getenv("TEST_LATE")) CoracleCheckpointPath(c);
  return 0;
}

int ReluctantEnd(CoracleClient c, const double x[])
{
  if (length > LONGEST)
    CoracleRejectStep(c, "the disc makes steps of at most 2 ms");
  else if (getenv("TEST_LATE"))
    CoracleCheckpointPath(c);
  return CoracleEnd(c, x);
}
