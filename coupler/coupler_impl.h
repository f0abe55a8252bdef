/* The inside of the coupler, for its modes. */
#ifndef CORACLE_COUPLER_IMPL_H
#define CORACLE_COUPLER_IMPL_H
#include "coupler/coupler.h"

/* What a mode decides; each function is collective. */
typedef struct {
  PetscBool needs_pressure;                                     /* react uses flow.p */
  PetscErrorCode (*weigh)(Coupler, const ServerSolid *);        /* fills weight */
  PetscErrorCode (*react)(Coupler);                             /* fills node from flow */
  PetscErrorCode (*correct)(Coupler, const ServerSolid *moved); /* fills correction */
} CouplerActions;

struct Coupler_s {
  MPI_Comm comm;
  CouplerOptions options;
  const CouplerActions *actions;
  Shell shell;
  Overlap overlap;
  double dt;                     /* of the step that was built, s */
  int built, nnodes;             /* nodes at home */
  const double *us;              /* [nnodes][2] the solid's velocity; borrowed */
  double (*now)[3][2];           /* [overlap->npieces] the solid's when the step began */
  double *firmness;              /* [overlap->npieces] */
  CoracleFlow flow;              /* borrowed */
  WallWeight *weight;            /* [overlap->pairs.n] */
  CoracleCoupling *coupling;     /* [overlap->nentries] */
  CoracleCorrection *correction; /* [overlap->nentries] */
  ForceVertex *vertex;           /* [overlap->npieces][3] */
  ForceVertex *node;             /* [nnodes] */
  double *force;                 /* [nnodes][2] */
};

extern const CouplerActions COUPLER_ACTIONS_REACTION, COUPLER_ACTIONS_STRESS_SHELL,
    COUPLER_ACTIONS_PENALTY_SHELL;

/* The force of the modes that conserve momentum: the reaction to the weights, inertia and weight of the fluid inside. */
PetscErrorCode CouplerReactConserving(Coupler coupler);
/* The correction that gives the fluid inside the solid the solid's velocity; and that of modes that leave it alone. */
PetscErrorCode CouplerFillSolid(Coupler coupler, const ServerSolid *moved);
PetscErrorCode CouplerNoCorrection(Coupler coupler, const ServerSolid *moved);
/* P1 values of the P2 pressure p[6] on one element: its L2 projection. */
void CouplerPressureP1(const double p[6], double p1[3]);
#endif
