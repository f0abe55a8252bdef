/* The inside of the coupler, for its modes. */
#ifndef CORACLE_COUPLER_IMPL_H
#define CORACLE_COUPLER_IMPL_H
#include "coupler/force/pressure_load.h"
#include "coupler/force/uplift.h"
#include "coupler/step/coupler.h"
#include "coupler/step/history.h"
#include "coupler/terms/displaced.h"

struct Coupler_s {
  MPI_Comm comm;
  CouplerOptions options;
  const CouplerModeTable *mode;
  Shell shell;
  Overlap overlap;
  double dt;         /* of the step that was built, s */
  int built, nnodes; /* nnodes: nodes that this rank owns */
  const double *us;  /* [nnodes][2] the velocity that the fluid couples to, m/s; borrowed */
  /* the solid as the step began, and what is predicted for the step */
  double *mobility;              /* [nnodes] 1/kg */
  double *start;                 /* [nnodes][2] velocity, m/s */
  double *predicted;             /* [nnodes][2] velocity at the step's end, m/s */
  double *acceleration;          /* [nnodes][2] a: by all but the fluid inside the solid, m/s2 (inertia.h) */
  double *explicit_fraction;     /* [nnodes] (inertia.h) */
  double single_iteration_step;  /* s (viscous_response.h) */
  char *given;                   /* [nnodes] CouplerGiven */
  double *displaced;             /* [nnodes] kg/m3 (displaced.h) */
  Harmonic harmonic;             /* of the solid's elements, for displaced; NULL: not needed so far */
  History history;               /* of the steps before */
  PressureLoad pressure_load;    /* NULL: none */
  Uplift uplift;                 /* NULL: nothing to touch */
  CoracleFlow flow;              /* borrowed */
  SourceTerm *source;            /* [overlap->nsources] */
  ElementTerm *element;          /* [overlap->ncoupled] */
  PairTerm *term;                /* [overlap->pairs.n] */
  CoracleCoupling *coupling;     /* [overlap->ncoupled] */
  CoracleCorrection *correction; /* [overlap->ncoupled] */
  ForceVertex *vertex;           /* [overlap->nsources][3] */
  ForceVertex *node;             /* [nnodes] */
  double *force;                 /* [nnodes][2] N */
};

/* The force of the modes that conserve momentum (force.h): reaction, added inertia and buoyancy. */
PetscErrorCode CouplerConservativeForce(Coupler coupler);
/* The correction that sets the fluid inside the solid to the solid's new velocity [5]; all modes have it. */
PetscErrorCode CouplerSolidCorrection(Coupler coupler, const SolidState *moved);
#endif
