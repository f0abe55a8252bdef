/* The solid's own inertia in the fluid's solve (mode reaction), for solids that send their nodes' mobility and acceleration
 * (CoracleSetInertia).
 *
 * 1. Inside the solid the fluid has the solid's inertia.
 *
 * The fluid fills the whole domain, the inside of solids too.  There it is given the solid's density rho_s (its mass per area now) and the
 * forces that act on the solid.  With u^n the fluid's velocity at the step's start and a the solid's acceleration by all forces but the fluid's,
 *
 *     rho_s (u - u^n)/dt  =  rho_s a - grad p + div tau            inside the solid.
 *
 * So one solve moves fluid and solid together, the pressure's too (implicit inertia in coracle.h), and one coupling iteration is right at any
 * density ratio >= 1.  The pairs (wall_term.h) add what this has beyond the fluid's own rho_f (u - u^n)/dt - rho_f g:
 *
 *     inertia  m = (rho_s - rho_f)/dt,     body force  q = rho_s a - rho_f g.
 *
 * The force on the solid is the reaction to both plus the added inertia and the buoyancy of force.h, together
 * F = int rho_s N ((u+ - u^n)/dt - a).
 *
 * 2. The velocity that the inertia begins with.
 *
 * In u^n there is more than the solid's velocity v: the fluid's slip along the surface (slip.h), and, where the solid has come to since the last
 * step, what the fluid did there.  The solid's inertia begins with v and the slip; in elements that lie in the solid as a whole (covered) that of the
 * fluid begins with v, too:
 *
 *     m (u - D u^n - (I - D) v):   start  =  m (I - D) (+ rho_f/dt in covered elements),     D of slip.h, 0 in covered elements.
 *
 *   - If m began with u^n, an element that the surface crosses could keep a velocity through it.  The correction (force.h) takes a part of
 *     that away in each step, so that the solid would leak the more the longer the steps are: FSI2 of cases/flexible_beam, a beam of ten times the
 *     fluid's density, swung by 92, 78, 69 mm with steps of 4, 2, 1 ms (le 0.008 m; 71, 66, 62 with v).
 *   - In covered elements the pressure displaces the fluid that was there within the step.  Otherwise the correction alone would give its momentum
 *     to the solid, after the step, and the drag would grow with dt: a disc at Re 180 (row Yc20-200 of cases/falling_cylinder, U dt = le/2) is at
 *     2 s 0.5 % slower than with half of the step; with it 0.2 %, and 0.6 % faster.
 *
 * 3. Solids much heavier than the fluid.
 *
 * An element that the surface of a heavy solid comes to cannot carry the solid's mass along the surface, whatever velocity that begins with.  With the
 * fluid's it is momentum that the fluid never had: a disc of 2500 kg/m3 and 2 m/s in a fluid of 1 kg/m3 (radius 0.02 m, le 0.006 m) made it
 * as fast as 424 m/s, and itself 10 % faster within 0.1 s, and a wall of rubber that swung in it was torn.  With the solid's the fluid is held to the
 * surface, the more the shorter the steps: a cylinder of 1000 and 10 000 times the fluid's density in the channel of tests/coupled/channel.yaml
 * (le D/12, free to move) has 9 and 13 % more drag than a fixed one.  So along the surface no more of the inertia counts than a light solid has:
 *
 *     m (G u - k P u^n - (I - P) v),     G  =  I - (1 - k) P   (CoracleCoupling.inertia_tensor),     kept  =  k P,
 *     k  =  min(1, INERTIA_KEPT_RATIO rho_o |K and S| / int_{K and S} (rho_s - rho_f)),     rho_o of outside.h, else rho_f.
 *
 * The rest, (1 - k) P, is moved by the forces on the solid alone: q there is rho_s a - rho_f g - (rho_s - rho_f) (1 - k) P a.
 * P is D where k = 1.  Of a heavy solid it is nearly the projector t t along the surface, t its direction in K, for D, of a mean over normals, has
 * little of a large m too much or too little where the surface is curved:
 *
 *     P  =  k D + (1 - k) q min(1, CORNER s) t t,     s and q of slip.h, D = q (I - s^8 n n).
 *
 * q is below 1 where faces oppose each other and at corners of small parts.  With P of a D taken to have q = 1, what D lacks of I along t counted as if it
 * lay along n: an eigenvalue (1 - k) (q - 1)/(q s^8) of P was negative and I - P, the part of the inertia that begins with v, many times I.  The element
 * then had more inertia than the solid has mass, and the solid more than its share of each change of velocity: two blocks of 2500 kg/m3 that touched
 * in a fluid of 1.2 kg/m3 had a million times their energy (tests/coupled/touching.sh).
 *
 * The cylinder's drag is then that of a fixed one within 1 % (k is 1 up to 21 times the fluid's density; tests/coupled/wind.sh).  A solid of more
 * than INERTIA_MOST times the fluid's density counts as one of so many times, on both sides of the coupling: beyond that round-off decides
 * what is left along the surface.
 *
 * In one fluid that is INERTIA_FREE_MOST for what is free.  Where the fluid inside has all of the solid's inertia, its force -grad p on the solid keeps what it
 * cannot follow from moving: compression, since p makes the fluid free of divergence, and what varies over less than an element, as the parting of
 * the faces of a crack or of two bodies in it.  With less inertia the force on a heavy solid is that of the fluid beside it all the same, and in the
 * inside it is less.  A rock (2500 kg/m3, air) that strikes a floor with 6 m/s, steps of 0.02 ms: 15 broken edges, 41 J and a rebound of 5.25 m/s
 * without fluid; 52, 163 J, 3.7 m/s with all of the inertia; 14, 39 J, 5.19 m/s with 1000 times the fluid's, 14, 36 J, 5.17 with 300, 15, 40 J,
 * 5.21 with 100.  A block that slides over another one without friction, 2 m/s, steps of 0.5 ms, after 0.08 s: 1.67, 1.83, 1.95, 1.98 m/s.  But the
 * fluid inside yields to a pressure that lasts by dt grad p (1/rho_c - 1/rho_s), rho_c what counts: through a wall 0.02 m thick that is held at
 * its ends against 100 Pa (wind of 13 m/s), steps of 2 ms, air flows with 0.002, 0.007, 0.031, 0.096 m/s, with 0.5 ms with about a third.
 *
 * Among phases G is I and kept is k I; k is 1 in elements that the solid all but covers.
 *
 * 4. Solids lighter than the fluid.
 *
 * They are filled with rho_f, which keeps m positive.  The inertia in excess, rho_f - rho_s, acts with the acceleration a' = (v' - v)/dt of the
 * interface velocity v',
 *
 *     q = rho_s a + (rho_f - rho_s) a' - rho_f g,
 *
 * and coupling iterations find v' (coupling_iteration.h).
 *
 * 5. Forces that vary over few elements.
 *
 * A solid sends a as forces on its nodes over their masses, m_l a; the forces of the field a are M a, M = int rho_s N N.  Where a varies over few
 * elements the two differ.  What the forces lack accelerates the fluid inside in each step, and a body that floats, whose a goes from 2 g
 * below the water to 0 above, is pushed about.  So among phases q is of
 *
 *     a~ = a + (1 - m_l^-1 M) a + ... + (1 - m_l^-1 M)^3 a,         M a~ -> m_l a.
 *
 * Not more of the series: forces between nodes closer than a fluid element, which it does not see, would be kept for ever; so a part of them is let
 * go in each step.  (With 16 terms the air beside a block at rest, of elements of half the fluid's size, is fast enough for 15 % more steps.)
 * In one fluid q is of a: with a~ the tip of the beam of cases/flexible_beam, FSI1 with le 0.008, is 0.30 instead of 0.70 mm high after
 * 6 s (reference 0.82).
 *
 * 6. Solids that are held: their nodes have no mobility, the fluid does not move them.
 *
 * In one fluid m = INERTIA_HELD rho_f/dt, across the surface alone (G = I - P, with k = 0), which begins with the velocity u_s that is predicted
 * for the step's end in place of v.  The solid's velocity is also the bulk velocity there (ms, us of wall_term.h), which the pressure makes free of
 * divergence: an element that the surface crosses conducts with what of it is open, but at least with BULK_LEAST of it.  u itself yields to the pressure's increment phi by
 * 1/INERTIA_HELD of what the fluid would, so that a flow past narrow gaps is steady as soon as viscosity lets it be, and what the solid resists is in
 * its reaction.  (Held in the momentum equation alone, by a penalty, it was to phi what the fluid is: where a part w/H of a channel was open, a step
 * took off w/H of what the pressure lacked.)
 *
 * Among phases, where phi is not an increment, what is held is one of INERTIA_MOST times the density of the phase that fills it.  Along the
 * surface its inertia counts as that of other heavy solids does in one fluid (P, of its normals alone), but as at most INERTIA_HELD_RATIO
 * times the fluid's mass.  (With 1e5 times, 4e-4 of the water that a wall holds back 0.5 m deep passes it in a second, with 1e6 nothing.)
 *
 * Where surface tension is resolved, elements at the interface being smaller than the capillary length sqrt(tension/(density g)), it is held by a
 * penalty in the momentum equation, a = HELD_PENALTY rho_f/dt, without inertia, and its velocity is the bulk velocity: a line's force in an
 * element with a held solid's inertia does not balance the pressure of the drop beside it.  A drop at 120 degrees on a block, of nine elements a
 * radius, comes to rest at 120 to 122, wherever it lies in its elements; held by 10 times the fluid's inertia at 117, by 100 times at 120
 * to 128, by INERTIA_MOST it never came to rest (tests/coupled/wetting.sh). */
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
/* The same of what is free in one fluid (3). */
#define INERTIA_FREE_MOST 300.0

/* What is held in one fluid counts as so many times the fluid's density more than it.  With 10, 100 and 1000 the drag of 2D-1 (tests/coupled/channel.sh)
 * is - 0.17, - 0.07 and + 0.03 % off, the largest lift of 2D-2 - 0.5, - 0.2 and + 0.3 %, and a gap of 4 elements is 0.16, 0.14 and 0.13 of one too wide
 * (gap.sh).  With 30 000 a crossed element holds the fluid beside the solid, too: an array of discs has a quarter more drag. */
#define INERTIA_HELD 100.0

#define HELD_PENALTY 10.0

/* Collective.  Density, held and bulk of source[nsources]: rho_s of volume triangles, at most INERTIA_MOST (free, one fluid: INERTIA_FREE_MOST) times rho_f, and INERTIA_MOST times where all
 * nodes are held; 0 for the shell's, and what the penalty holds.  term[pairs.n] gets the inertia above, or the penalty.  capillary: surface tension is
 * resolved. */
PetscErrorCode InertiaCoefficients(Overlap overlap, const SolidState *solid, double dt, PetscBool capillary,
                                   PairTerm term[], SourceTerm source[]);
/* Local, after OutsideDensity: k of element e with INERTIA_KEPT_RATIO, or another ratio. */
double InertiaKept(const Overlap overlap, const SourceTerm source[], const ElementTerm *element, double ratio,
                   int e);
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
