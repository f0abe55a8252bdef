/* The solid of the conformance kit: it has no nodes and lets the coupler do what it wants. */
#include "common/link/coracle.h"

int main(int argc, char **argv)
{
  double t, dt, state = 0.0;
  const double *force;
  MPI_Comm comm;
  CoracleAction action;
  CoracleClient c;
  CoracleOpen("solid", argc, argv, &comm, &c);
  CoracleBindState(c, &state, sizeof state); /* so that the library saves it in checkpoints */
  CoracleSetNodes(c, CORACLE_DIM, 0, NULL, NULL, NULL);
  CoracleSetSurface(c, 0, NULL);
  CoracleSetVolume(c, 0, NULL);
  CoracleReady(c);
  for (;;) {
    CoracleBegin(c, &t, &dt, &action);
    if (action == CORACLE_STOP) break;
    CoracleGetForce(c, &force);
    CoracleSubstep(c, dt, &state);
    CoracleEnd(c, &state);
  }
  return CoracleClose(&c);
}
