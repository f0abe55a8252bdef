/* The fluid as the coupler's numerics see it: its elements K near the solid, triangles with P1DG velocity and
 * P2 pressure.  Arrays are borrowed from whoever fills the struct (exchange.h in a run).  The flow on them
 * (CoracleFlow), and what the fluid receives per element (CoracleCoupling, CoracleCorrection), are declared in
 * coracle.h. */
#ifndef CORACLE_FLUID_STATE_H
#define CORACLE_FLUID_STATE_H
#include "common/link/coracle.h"

typedef struct {
  int n;                                 /* elements of this rank's clients */
  const double *x;                       /* [n][3][2] vertices, m */
  const double *rho, *mu;                /* [n] kg/m3, Pa s: at the start of the coming step */
  const double *rho_inside, *rho_beside; /* [n] kg/m3, as in CoracleElements */
  double lower[2], upper[2];             /* bounds of the fluid's whole domain, m */
} FluidElements;
#endif
