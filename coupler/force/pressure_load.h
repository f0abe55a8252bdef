/* The pressure of the fluid around compresses the solid, of solids that ask for it (CoracleSetPressureLoad; mode reaction).
 *
 * What force.h gives a node is the fluid's inside the solid: of its pressure p there, -int N_i grad p, which a uniform p has no
 * part in.  Traction -p n on the surface is that and, in each of the solid's elements T, a load without resultant and without
 * moment,
 *
 *     L_i  =  - q int_T grad N_i,          q = p:     sum over T of L_i - int_T N_i grad p  =  - int_surface N_i p n.
 *
 * But the fluid inside is incompressible and the solid is not.  Where the solid's own forces change its volume, p has what keeps the
 * fluid from doing the same, of the order rho L^2 div(u_s)/dt over a length L: as -grad p it holds the solid, as q it pushes it on, and
 * a soft beam turns inside out.  So the load has of p inside what cancels that, and the level of the pressure from outside:
 *
 *     q  =  p - H(p_s) + H(p_o)
 *
 * p_s   p at the surface, the mean over the shell around each surface node
 * p_o   p outside, the mean over the same pairs of p at the vertex of the fluid element that lies farthest out of the solid
 * H     the harmonic function inside the solid with these values on its surface (linear elements on the solid's mesh where the
 *       step has it; nodes whose shell the fluid does not cover are free)
 *
 * Force and load together are then the traction -p_o n and a body force -grad H(p_s - p_o).  Of the load the solid's acceleration that
 * moves the fluid inside (inertia.h, CouplerBuild) has H(p_o) alone, as of a force that is not the fluid's; the rest, which is 0 on the
 * surface, is taken as the fluid's own.
 *
 * Each step the load rises by PRESSURE_LOAD_RISE of what it lacks: the elements keep q and H(p_o), which are in checkpoints, and nothing
 * fast feeds on itself.  It needs a mesh that does not change and one fluid: an element with an interface has one p for both sides.
 * All functions are collective. */
#ifndef CORACLE_COUPLER_PRESSURE_LOAD_H
#define CORACLE_COUPLER_PRESSURE_LOAD_H
#include "common/output/checkpoint.h"
#include "coupler/geometry/overlap.h"

#define PRESSURE_LOAD_RISE 0.05

typedef struct PressureLoad_s *PressureLoad;

PetscErrorCode PressureLoadCreate(MPI_Comm comm, PressureLoad *load);
PetscErrorCode PressureLoadDestroy(PressureLoad *load);
/* The solid's mesh of the step to come (copied), the same elements in every call; at the first one nothing has risen yet. */
PetscErrorCode PressureLoadBuild(PressureLoad load, const SolidState *solid);
/* force[nnodes][2] += L, N, of this rank's elements; p[nelements][6], Pa, of the overlap's elements.  May be repeated in a step. */
PetscErrorCode PressureLoadAdd(PressureLoad load, Overlap overlap, const double p[], double force[]);
/* The step that the last PressureLoadAdd was of is accepted.  acceleration[nnodes][2] += mobility times the load of H(p_o), m/s2, of
 * all ranks' elements; mobility[nnodes], 1/kg. */
PetscErrorCode PressureLoadAccept(PressureLoad load, Overlap overlap, const double mobility[],
                                  double acceleration[]);
/* Load takes the elements of `solid` from what any ranks have saved; a checkpoint without them leaves all as at the start. */
PetscErrorCode PressureLoadSave(PressureLoad load, Checkpoint to);
PetscErrorCode PressureLoadLoad(PressureLoad load, const SolidState *solid, Checkpoint from);
#endif
