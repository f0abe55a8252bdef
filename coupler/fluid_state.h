/* The fluid as the coupler's numerics see it: its elements K near the solid, triangles with P1DG velocity and
 * P2 pressure, and the flow on them after a solve.  Arrays are borrowed from whoever fills the structs
 * (exchange.h in a run).  What the fluid receives per element (CoracleCoupling, CoracleCorrection) is
 * declared in coracle.h. */
#ifndef CORACLE_FLUID_STATE_H
#define CORACLE_FLUID_STATE_H
#include "common/link/coracle.h"

typedef struct {
  int n;                     /* elements of this rank's clients */
  const double *x, *rho;     /* [n][3][2] vertices, m; [n] density, kg/m3 */
  double lower[2], upper[2]; /* bounds of the fluid's whole domain, m */
} FluidElements;

typedef struct {
  const double *u_star; /* [n][2][3] velocity with the coupling solved, before the pressure correction, m/s */
  const double *u_plus; /* [n][2][3] velocity after it, m/s */
  const double *p;      /* [n][6] pressure on the P2 nodes, Pa; NULL unless the mode needs it (mode.h) */
  const double *mu;     /* [n] dynamic viscosity, Pa s */
} FluidFlow;
#endif
