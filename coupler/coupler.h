/* The coupler: takes the solid's motion and the fluid's flow, gives the fluid its coupling term and the solid
 * its force.  It knows no messages (scheme.c does); everything is collective over its communicator.
 * One step:
 *
 *     CouplerBuild     solid at t^n, dt           ->  coupling of every fluid element that the solid or its shell touches
 *     CouplerReact     the fluid's u*, u+, rho, mu ->  force on the solid's nodes
 *     CouplerCorrect   the solid's new velocity   ->  correction of the fluid, on the overlap of CouplerBuild
 *
 * Modes (method.md sections 3, 4, 8, 9):
 *     reaction         the solid's inside is held by sigma = relaxation rho_f/dt, its surface by the wall term; the force
 *                      is the reaction to both, plus the inertia of the fluid inside and buoyancy.  Conservative.  What
 *                      gives way by itself is held implicitly (inertia.h).
 *     stress_shell     the paper, literal: wall term in the shell only, from the viscosity projected to the surface;
 *                      force by the surface integral of [43], [44].
 *     penalty_shell    Vire, Xiang, Pain 2015: a = rho_f/dt I in the shell only; force the reaction to it, plus the
 *                      inertia of the fluid inside and buoyancy.  Conservative. */
#ifndef CORACLE_COUPLER_H
#define CORACLE_COUPLER_H
#include "coupler/force.h"

typedef struct Coupler_s *Coupler;

typedef enum { COUPLER_REACTION, COUPLER_STRESS_SHELL, COUPLER_PENALTY_SHELL } CouplerMode;
/* The modes' names in a case file, in the order of the enumeration, ended by NULL. */
extern const char *const COUPLER_MODES[];

typedef struct {
  CouplerMode mode;
  double thickness;  /* of the shell, dr, m */
  double relaxation; /* sigma dt / rho_f, used by the mode reaction */
  double gravity[2]; /* m/s2 */
} CouplerOptions;

PetscErrorCode CouplerCreate(MPI_Comm comm, const CouplerOptions *options, Coupler *coupler);
/* Whether the mode uses the fluid's pressure: then CouplerReact's flow must have it. */
PetscBool CouplerNeedsPressure(Coupler coupler);
/* The fluid's elements near the solid, with the density and viscosity of the coming step (copied). */
PetscErrorCode CouplerSetElements(Coupler coupler, const ServerElements *elements);
/* The coupling over the coming step of dt seconds with the solid as it is: one entry per touched element.
 * The solid's velocity is used until CouplerReact has returned or CouplerSetInterfaceVelocity gives another; coupling is
 * borrowed until the next CouplerBuild. */
PetscErrorCode CouplerBuild(Coupler coupler, const ServerSolid *solid, double dt, int *n,
                            const CoracleCoupling **coupling);
/* For another try of the step: the coupling with u[nnodes][2], m/s, as the solid's velocity, but where
 * nodes give way by themselves (mobility[nnodes] > 0).  u is used as the solid's arrays are. */
PetscErrorCode CouplerSetInterfaceVelocity(Coupler coupler, const double mobility[], const double u[], int *n,
                                           const CoracleCoupling **coupling);
/* The force on the solid's nodes [nnodes][2], N, borrowed until the next call of this; the flow's arrays are
 * used until CouplerCorrect has returned. */
PetscErrorCode CouplerReact(Coupler coupler, const CoracleFlow *flow, const double **force,
                            ForceTotals *totals);
/* One entry per entry of CouplerBuild.  After fracture (moved->changed) the old overlap has no new velocity
 * and the fluid is left as it is for this step.  Borrowed until the next CouplerCorrect. */
PetscErrorCode CouplerCorrect(Coupler coupler, const ServerSolid *moved, int *n,
                              const CoracleCorrection **correction);
/* For output and tests, borrowed until the next CouplerBuild. */
Shell CouplerShell(Coupler coupler);
Overlap CouplerOverlap(Coupler coupler);
PetscErrorCode CouplerDestroy(Coupler *coupler);
#endif
