/* CoracleBegin and CoracleEnd of a solid that makes steps longer than LONGEST, too, but rejects what has come of them. */
#include "common/link/coracle.h"

#define LONGEST 2e-3 /* s */

static double length; /* of the step, s */

int ReluctantBegin(CoracleClient c, double *t, double *dt, CoracleAction *action);
int ReluctantEnd(CoracleClient c, const double x[]);

int ReluctantBegin(CoracleClient c, double *t, double *dt, CoracleAction *action)
{
  CoracleBegin(c, t, dt, action);
  length = *dt;
  return 0;
}

int ReluctantEnd(CoracleClient c, const double x[])
{
  if (length > LONGEST) CoracleRejectStep(c, "the disc makes steps of at most 2 ms");
  return CoracleEnd(c, x);
}
