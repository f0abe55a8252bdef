/* The solid's own inertia in the fluid's solve (mode reaction), for solids that send their nodes' mobility and
 * acceleration (CoracleSetInertia).
 *
 * Fluid is everywhere, inside the solid too.  There it is given the solid's density rho_s (its mass per area
 * now) and the forces that act on the solid: with u^n its velocity at the step's start and a the solid's acceleration by all
 * forces but the fluid's,
 *
 *     rho_s (u - u^n)/dt  =  rho_s a - grad p + div tau            inside the solid,
 *
 * so that the fluid's solve moves fluid and solid together, by pressure too (implicit inertia in coracle.h),
 * and one coupling iteration is right at any density ratio >= 1.  As inertia and body force of the pairs
 * (wall_term.h), beside the fluid's own rho_f (u - u^n)/dt - rho_f g:
 *
 *     inertia  m = (rho_s - rho_f)/dt,     body force  q = rho_s a - rho_f g,
 *
 * and the force on the solid is the reaction to both plus the added inertia and buoyancy of force.h, together
 * F = int rho_s N ((u+ - u^n)/dt - a).
 *
 * What of u^n is not the solid's velocity v is of the fluid that was there before, or, along the surface, slip (slip.h).  The
 * solid's inertia begins with v but for the slip, in elements that lie in the solid as a whole the fluid's, too:
 *
 *     m (u - D u^n - (I - D) v):   start  =  m (I - D) (+ rho_f/dt in covered elements),
 *
 * D of slip.h, 0 in covered elements.  Beside a fluid much lighter than the solid an element that its surface comes to cannot carry
 * the solid's mass along the surface: whatever velocity it begins with there, the fluid's is momentum that the fluid never had (a disc of
 * 2500 kg/m3 and 2 m/s in a fluid of 1 kg/m3, radius 0.02 m, le 0.006 m, made it as fast as 424 m/s, and itself 10 % faster within 0.1 s,
 * and a wall of rubber that swung in it was torn), the solid's holds the fluid to the surface, the more the shorter the steps (a cylinder of
 * 1000 and 10 000 times the fluid's density in the channel of tests/coupled/channel.yaml, le D/12, free to move, has 9 and 13 % more
 * drag than a fixed one).  So there only as much of the inertia counts along the surface as a light solid's:
 *
 *     m (G u - k P u^n - (I - P) v),     G  =  I - (1 - k) P   (CoracleCoupling.inertia_tensor),     kept  =  k P,
 *     k  =  min(1, INERTIA_KEPT_RATIO rho_o |K and S| / int_{K and S} (rho_s - rho_f)),     rho_o of outside.h, else rho_f,
 *
 * the rest, (1 - k) P, is moved by the forces on the solid alone, so that q there is rho_s a - rho_f g - (rho_s - rho_f) (1 - k) P a.
 * P is D where k = 1.  Of a heavy solid it is nearly the projector t t along the surface, t its direction in K: what D, a mean over
 * normals, lacks of it where the surface is curved is little, but little of a large m,
 *
 *     P  =  k D + (1 - k) min(1, CORNER (1 - 2 s)) t t,     s the mean of sin^2 of the normals' angle to the mean one.
 *
 * The cylinder's drag is then that of a fixed one within 1 % (k up to 21 times the fluid's density is 1; tests/coupled/wind.sh).
 *
 * A solid of more than INERTIA_MOST times the fluid's density counts as one of so many times, on both sides of the coupling: beyond that
 * round-off decides what is left along the surface.
 *
 * Were m to begin with u^n, an element that the surface crosses could keep a velocity through
 * it: the correction (force.h) takes a part of that away in each step, so that the solid leaked the more the longer the steps are.
 * FSI2 of cases/flexible_beam, a beam of ten times the fluid's density, swung by 92, 78, 69 mm with steps of 4, 2, 1 ms (le 0.008 m;
 * 71, 66, 62 with v).  In covered elements the pressure displaces the fluid that was there within the step.  Without that its
 * momentum is given to the solid by the correction alone, after the step, and the drag grows with dt: a disc at Re 180 (row
 * Yc20-200 of cases/falling_cylinder, U dt = le/2) is at 2 s 0.5 % slower than with half of the step; with it 0.2 %, and 0.6 %
 * faster.
 *
 * Among phases D is 0, G is I and kept is k, 1 in elements that the solid all but covers.
 *
 * A solid lighter than the fluid is filled with rho_f, which keeps m positive; the inertia in
 * excess, rho_f - rho_s, acts with the acceleration a' = (v - v^n)/dt of the interface velocity v,
 *
 *     q = rho_s a + (rho_f - rho_s) a' - rho_f g,
 *
 * and coupling iterations find v (coupling_iteration.h).
 *
 * A solid sends a as forces on its nodes over their masses, m_l a; that field's forces are M a, M = int rho_s N N.  Where a
 * varies over few elements the two differ: the fluid inside is accelerated in each step by what the forces lack, and a body
 * that floats, whose a goes from 2 g below the water to 0 above, is pushed about.  Among phases q is therefore of
 *
 *     a~ = a + (1 - m_l^-1 M) a + ... + (1 - m_l^-1 M)^3 a,         M a~ -> m_l a
 *
 * Not more of the series: forces that no fluid element sees, between nodes closer than its size, would be kept for ever; so a part of
 * them is let go in each step.  (With 16 terms the air beside a block at rest, of elements of half the fluid's size, is fast enough
 * for 15 % more steps.)  In one fluid q is of a: with a~ the tip of the beam of cases/flexible_beam, FSI1 with le 0.008, is 0.30
 * instead of 0.70 mm high after 6 s (reference 0.82).
 *
 * Where nodes have no mobility the solid is held: the fluid does not move it.
 *
 *   One fluid.  m = INERTIA_HELD rho_f/dt, across the surface alone (G = I - P, with k = 0), which begins with the velocity u_s that is predicted for
 *   the step's end in place of v.  The solid's velocity is also the bulk velocity there
 *   (ms, us of wall_term.h), which the pressure makes free of divergence: what an element that the surface crosses conducts is what of it is open.
 *   u itself yields to the pressure's increment phi by 1/INERTIA_HELD of what the fluid would, so that a flow past narrow gaps is steady as soon as
 *   viscosity lets it be, and what the solid resists is in its reaction.  (Held in the momentum equation alone, by a penalty, it was to phi what the fluid is: where a
 *   part w/H of a channel was open, a step took off w/H of what the pressure lacked.)
 *
 *   Among phases, where phi is not an increment, what is held is one of INERTIA_MOST times the density of the phase that fills it.
 *   Its inertia counts along the surface as that of other heavy ones does in one fluid (P, with D = I - mean of its n n), but as at most
 *   INERTIA_HELD_RATIO times the fluid's mass.  (With 1e5 times, 4e-4 of the water that a wall holds back 0.5 m deep passes it in a second, with 1e6 nothing.)
 *   Where surface tension is resolved, elements at the interface being smaller than the capillary length sqrt(tension/(density g)), it is held
 *   as in one fluid, but by INERTIA_HELD_CAPILLARY and along the surface, too: a line's force in an element of so much inertia does not balance the pressure of the drop beside it
 *   (a drop at 120 degrees on a block stood at 108 and never came to rest). */
#ifndef CORACLE_INERTIA_H
#define CORACLE_INERTIA_H
#include "coupler/geometry/overlap.h"
#include "coupler/terms/wall_term.h"

/* Along its surface the solid's inertia counts as at most so many times the mass that the fluid beside it would have in its place: half of
 * the largest with which u^n was stable when all of the inertia counted. */
#define INERTIA_KEPT_RATIO 20.0

/* The same of what is held among phases.  The correction takes a part of it to the solid's velocity in each step, however short, and elements that the
 * surface comes to bring it with them; with none an element that the surface crosses conducts along it as if it were open as a whole.  With 20, 2 and 0 the
 * force on a wedge of 45 degrees that enters water is 0.88, 0.99 and 0.99 of theory, the first one of water on a dam that is shaken 1.01, 0.98 and 0.97
 * (tests/coupled/SOLIDS_AMONG_PHASES.md, "Water entry of a wedge"). */
#define INERTIA_HELD_RATIO 2.0

#define INERTIA_MOST 1e6

/* What is held in one fluid counts as so many times the fluid's density more than it.  With 10, 100 and 1000 the drag of 2D-1 (tests/coupled/channel.sh)
 * is - 0.17, - 0.07 and + 0.03 % off, the largest lift of 2D-2 - 0.5, - 0.2 and + 0.3 %, and a gap of 4 elements is 0.16, 0.14 and 0.13 of one too wide
 * (gap.sh).  With 30 000 a crossed element holds the fluid beside the solid, too: an array of discs has a quarter more drag. */
#define INERTIA_HELD 100.0

/* The same where surface tension is resolved.  On meshes of 5 elements a radius a drop at 120 degrees comes to rest at 120 to 122 with 10, wherever it lies in
 * its elements; with 20 at 124 to 130, with 100 at 115 to 122 (tests/coupled/wetting.sh). */
#define INERTIA_HELD_CAPILLARY 10.0

/* Collective.  Density, held and bulk of source[nsources]: rho_s of volume triangles, at most INERTIA_MOST times rho_f, and so many times where all
 * nodes are held; 0 for the shell's.  term[pairs.n] gets the inertia above.  capillary: surface tension is resolved. */
PetscErrorCode InertiaCoefficients(Overlap overlap, const SolidState *solid, double dt, PetscBool capillary,
                                   PairTerm term[], SourceTerm source[]);
/* Local, after InertiaCoefficients, OutsideDensity and SlipTensors: start of term[pairs.n], kept and covered of element[ncoupled]. */
void InertiaStart(Overlap overlap, const SourceTerm source[], double dt, ElementTerm element[],
                  PairTerm term[]);
/* Collective: a~ of acceleration[nnodes][2], in place, where the fluid has phases. */
PetscErrorCode InertiaNodalForces(Overlap overlap, const SolidState *solid, double acceleration[]);
/* Collective.  explicit_fraction[nnodes], 0 .. 1: how much of a node's motion the fluid's solve takes from the
 * interface velocity: 1 where the node is held in one fluid, 1 - rho_s/rho_f where the solid is lighter than the fluid,
 * else 0. */
PetscErrorCode InertiaExplicitFraction(Overlap overlap, const SolidState *solid, const SourceTerm source[],
                                       double explicit_fraction[]);
#endif
