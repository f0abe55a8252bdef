/* The coupler: from the solid's motion and the fluid's flow it computes the fluid's coupling term and the
 * solid's force, on the supermesh of both (overlap.h).  It knows no messages; exchange.h does.  One step from
 * t^n to t^n + dt:
 *
 *        solid x^n, u_s                    fluid u*, u+, rho, mu            solid u_s^{n+1}
 *             |                                   |                               |
 *        CouplerBuild                   CouplerComputeForce                CouplerCorrect
 *        a, s = a u_s per element       F on the solid's nodes             r = (u_s^{n+1} - u+) inside S
 *             |                                   |                               |
 *             v                                   v                               v
 *          to fluid                           to solid                        to fluid
 *
 * In further coupling iterations CouplerSetInterfaceVelocity and CouplerComputeForce are repeated within the
 * step, on the geometry of CouplerBuild.  mode.h lists the modes: what a, F and r are in each.  All functions are
 * collective over the coupler's communicator. */
#ifndef CORACLE_COUPLER_H
#define CORACLE_COUPLER_H
#include "common/output/checkpoint.h"
#include "coupler/force/force.h"
#include "coupler/step/mode.h"

PetscErrorCode CouplerCreate(MPI_Comm comm, const CouplerOptions *options, Coupler *coupler);
PetscErrorCode CouplerDestroy(Coupler *coupler);
/* Before the first CouplerBuild: the pressure compresses the solid (pressure_load.h), whose mesh must not change, in mode
 * reaction; the flow then has p. */
PetscErrorCode CouplerUsePressureLoad(Coupler coupler);

/* The fluid's elements near the solid, with density and viscosity at the start of the coming step (copied). */
PetscErrorCode CouplerSetElements(Coupler coupler, const FluidElements *elements);

/* The coupling over the coming step of dt seconds from t on, with the solid where it is expected in the middle of the
 * step, x + dt/2 u_s (modes other than reaction: where it is now), so that forces which depend on its position
 * are neither early nor late; and with the velocity at the step's end that CouplerPredictedVelocity has:
 * coupling[n], one per fluid element that overlaps the solid or its shell,
 * in ascending order, borrowed until the next CouplerBuild. */
PetscErrorCode CouplerBuild(Coupler coupler, const SolidState *solid, double t, double dt, int *n,
                            const CoracleCoupling **coupling);
/* The same coupling with u[nnodes][2], m/s, as the solid's velocity at the step's end.  u is used until
 * CouplerComputeForce has returned. */
PetscErrorCode CouplerSetInterfaceVelocity(Coupler coupler, const double u[], int *n,
                                           const CoracleCoupling **coupling);
/* In the step that was built a, the solid's acceleration by all but the fluid inside (inertia.h), becomes that of `end`, the
 * solid as an attempt at the step has left it, on the same mesh: CouplerSetInterfaceVelocity comes next.  Collective. */
PetscErrorCode CouplerSetAcceleration(Coupler coupler, const SolidState *end);
/* Not collective; of the step that was built, borrowed: the velocity predicted for its end [nnodes][2], m/s;
 * and how much of each node's motion depends on that prediction [nnodes], 0 .. 1 (inertia.h). */
const double *CouplerPredictedVelocity(Coupler coupler);
const double *CouplerExplicitFraction(Coupler coupler);
/* Not collective; of the step that was built: the longest step from there that one coupling iteration would be enough for, s (viscous_response.h); 0: unknown, or none. */
double CouplerSingleIterationStep(Coupler coupler);
/* [nnodes] nodes without mobility whose acceleration is given: the predicted velocity is theirs, whatever the fluid does. */
const char *CouplerGiven(Coupler coupler);
/* Not collective, after CouplerComputeForce: CoracleGetFilm's load[nnodes][2] and resistance[nnodes][2][2], borrowed until the next one; NULL, on
 * all ranks, where no film yields (squeeze_film.h). */
void CouplerFilm(Coupler coupler, const double **load, const double **resistance);
/* force[nnodes][2], N, on the solid's nodes, borrowed until the next call of this; the flow's arrays are used
 * until CouplerCorrect has returned. */
PetscErrorCode CouplerComputeForce(Coupler coupler, const CoracleFlow *flow, const double **force,
                                   ForceTotals *totals);
/* correction[n], one per element of CouplerBuild and in its order; 0 when the elements of the step's start cannot
 * be recovered from the solid's new mesh (moved->lost).  Borrowed until the next CouplerCorrect. */
PetscErrorCode CouplerCorrect(Coupler coupler, const SolidState *moved, int *n,
                              const CoracleCorrection **correction);

/* The history (history.h) and what has risen of the pressure's load: between two steps; Load before the first CouplerBuild. */
PetscErrorCode CouplerSave(Coupler coupler, Checkpoint to);
PetscErrorCode CouplerLoad(Coupler coupler, const SolidState *solid, Checkpoint from);

/* Not collective; for output and tests, borrowed until the next CouplerBuild. */
Shell CouplerShell(Coupler coupler);
Overlap CouplerOverlap(Coupler coupler);
#endif
