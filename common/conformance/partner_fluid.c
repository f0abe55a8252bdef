/* The fluid of the conformance kit: it has no elements and lets the coupler do what it wants. */
#include "common/link/case_file.h"
#include "common/link/coracle.h"
#include <math.h>

static int Region(void *context, int nbox, const double box[], CoracleElements *elements)
{
  elements->n = 0;
  return 0;
}

int main(int argc, char **argv)
{
  const double lower[2] = {-1e9, -1e9}, upper[2] = {1e9, 1e9};
  const CoracleFlow flow = {0};
  double t, dt, state = 0.0;
  MPI_Comm comm;
  CoracleAction action;
  CoracleClient c;
  CoracleOpen("fluid", argc, argv, &comm, &c);
  CoracleBindState(c, &state, sizeof state); /* so that the library saves it in checkpoints */
  CoracleSetRegion(c, CORACLE_DIM, lower, upper, Region, NULL);
  CoracleProposeStep(c, 1.0);
  CoracleReady(c);
  for (;;) {
    CoracleBegin(c, &t, &dt, &action);
    if (action == CORACLE_STOP) break;
    CoracleSetFlow(c, &flow);
    CoracleEnd(c, NULL);
  }
  return CoracleClose(&c);
}
