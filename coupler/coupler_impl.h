/* The inside of the coupler, for its modes. */
#ifndef CORACLE_COUPLER_IMPL_H
#define CORACLE_COUPLER_IMPL_H
#include "coupler/coupler.h"

struct Coupler_s {
  MPI_Comm comm;
  CouplerOptions options;
  const CouplerModeTable *mode;
  Shell shell;
  Overlap overlap;
  double *mu;                     /* [overlap->nelements] Pa s */
  double dt;                      /* of the step that was built, s */
  int built, nnodes;              /* nnodes: nodes that this rank owns */
  const double *us;               /* [nnodes][2] the velocity that the fluid couples to, m/s; borrowed */
  double (*start_velocity)[3][2]; /* [overlap->nsources] the solid's velocity at the step's start, m/s */
  double *implicit_factor;        /* [overlap->nsources] b (inertia.h) */
  FluidFlow flow;                 /* borrowed */
  WallCoefficient *coefficient;   /* [overlap->pairs.n] a */
  CoracleCoupling *coupling;      /* [overlap->ncoupled] */
  CoracleCorrection *correction;  /* [overlap->ncoupled] */
  ForceVertex *vertex;            /* [overlap->nsources][3] */
  ForceVertex *node;              /* [nnodes] */
  double *force;                  /* [nnodes][2] N */
};

/* The force of the modes that conserve momentum (force.h): reaction, added inertia and buoyancy. */
PetscErrorCode CouplerConservativeForce(Coupler coupler);
/* The correction that sets the fluid inside the solid to the solid's new velocity. */
PetscErrorCode CouplerSolidCorrection(Coupler coupler, const SolidState *moved);
/* The correction of modes that have none: the fluid keeps its velocity. */
PetscErrorCode CouplerNoCorrection(Coupler coupler, const SolidState *moved);
#endif
