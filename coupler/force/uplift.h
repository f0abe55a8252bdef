/* The pressure between solids that touch each other or a wall of the tank, or are about to (mode reaction).
 *
 * Between the two lies less than a fluid element: what is there moves with both, and so the fluid's solve holds them apart by a pressure p,
 * whatever the contact does: with any contact force N the fluid's force is the weight less N; a block that is let down
 * on a floor stands on the water, without friction, and a heap of stones flows.  But water gets in between, and what it has there is the
 * pressure of the water around: the head
 *
 *     h  =  p_o - rho_o g.x        p_o at x beside the solid, rho_o the density of the phases there,
 *
 * known where the fluid beside the surface is resolved, is harmonic between such places: linear along the surface, as of a slow flow
 * through the gap, and nearly the same on both sides of it.  What p has beyond that is taken from the force in part,
 *
 *     F_i  +=  int N_i e n       over the close points of close_points.h, within UPLIFT_REACH of an element's size
 *     e     =  p - rho_o g.x - h,   but at most the larger of dt |g| sqrt(2 rho_s |e|) and, where the gap is closed, UPLIFT_TAKEN |e|
 *
 * and from what is opposite with the other sign; of two facets, each with half of its e (all, if the other is held).
 *
 * All that p has beyond the head drives the fluid out of the gap (squeeze_film.h).
 *
 * e moves the solid against the other, by a part of a step's fall, and the next step's p lacks what the contact bears then: N grows by the
 * integral of e in each step, until e is 0: across an open gap in the time that the solid takes to fall through the height of that pressure, where
 * the two touch within ten steps, too, since N keeps whatever error the force of a step has until e takes it away.  A blow of a few steps passes an open
 * gap: the wall's reaction to it is the fluid's (with all of e a square that a dam's front struck was thrown up, with an e that follows p at that rate a
 * caisson bounced).  What is held (no mobility) does not move: it has e as a whole, against a wall, half of it against
 * what is held, too, and against what is free what that takes from it.  Facets that no such place is connected with stay as they are.  The momentum of walls is in
 * the columns `uplift` of coupler.csv. */
#ifndef CORACLE_COUPLER_UPLIFT_H
#define CORACLE_COUPLER_UPLIFT_H
#include "coupler/geometry/overlap.h"

#define UPLIFT_REACH 0.5
#define UPLIFT_TAKEN 0.1
/* Below this part of an element's size a gap is closed. */
#define UPLIFT_CLOSED 1e-3

typedef struct Uplift_s *Uplift;

/* lower, upper: the walls, m; infinite where there are none.  gravity, m/s2: borrowed, that of the step to come whenever it is built. */
PetscErrorCode UpliftCreate(MPI_Comm comm, const double lower[2], const double upper[2],
                            const double gravity[2], Uplift *uplift);
PetscErrorCode UpliftDestroy(Uplift *uplift);
/* Collective: the solid of the step to come (copied), its shell, borrowed until the next call, and their overlap: what is close. */
PetscErrorCode UpliftBuild(Uplift uplift, const SolidState *solid, const Shell shell, const Overlap overlap);
/* Collective: force[nnodes][2] += the above, N, to each copy of a node what its facets do; total[2]: of all ranks.  dt: of the step that was
 * built; p[nelements][6], Pa, of the overlap's elements. */
PetscErrorCode UpliftAdd(Uplift uplift, Overlap overlap, const double p[], double dt, double force[],
                         double total[2]);
/* Not collective, after UpliftAdd: where films yield, on any rank, CoracleGetFilm's load[nnodes][2], N, and resistance[nnodes][2][2], N s/m,
 * borrowed until the next call; else NULL. */
void UpliftFilm(Uplift uplift, const double **load, const double **resistance);
#endif
