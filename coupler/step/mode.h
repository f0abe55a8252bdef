/* Coupling modes: everything that distinguishes one way to couple solid and fluid from another.
 *
 *     reaction         default.  The fluid inside the solid has the solid's inertia (inertia.h), much of it where nodes have
 *                      no mobility; the surface is held by the wall term.  The force is the reaction to both, plus the
 *                      inertia of the fluid inside and buoyancy.  Conservative.
 *     stress_shell     Yang et al. 2016, literal: wall term in the shell only, from the viscosity
 *                      projected to the surface; force by the surface integral of [43], [44].  Not conservative.
 *     penalty_shell    Vire, Xiang, Pain 2015: a = rho_f/dt I in the shell only; the force is the reaction to
 *                      it, plus the inertia of the fluid inside and buoyancy.  Conservative.
 *
 * In all of them the fluid inside takes the solid's velocity at the step's end [5] (CouplerSolidCorrection).
 *
 * A mode is one file, mode_<name>.c, which exports one constant table.  Numbers in [ ], here and in the other
 * headers, are equations of Yang, Xiang, Fang, Pavlidis, Latham, Pain, J.  Comput.  Phys. 2016, doi
 * 10.1016/j.jcp.2016.05.035. */
#ifndef CORACLE_COUPLER_MODE_H
#define CORACLE_COUPLER_MODE_H
#include "common/program/gravity.h"
#include "coupler/geometry/solid_state.h"

typedef struct Coupler_s *Coupler;

typedef enum { COUPLER_REACTION, COUPLER_STRESS_SHELL, COUPLER_PENALTY_SHELL } CouplerMode;
/* The modes' names in a case file, in the order of the enumeration, ended by NULL. */
extern const char *const COUPLER_MODES[];

typedef struct {
  CouplerMode mode;
  double thickness;          /* of the shell, dr, m */
  double gravity[2];         /* m/s2, of the current step */
  TimeTable gravity_table;   /* of t, s, and gravity in its place, borrowed (gravity.h); nrows 0: none */
  PetscBool capillary;       /* surface tension is resolved (inertia.h) */
  PetscBool uplift;          /* the solid may touch walls or itself (uplift.h) */
  double lower[2], upper[2]; /* m; the walls, infinite where there are none */
} CouplerOptions;

/* Which of the solid's velocities over the last step u_s is: the one at its end, without vibrations, or the
 * mean, displacement / dt.  A reaction needs the end's: with the mean, half a step late, its inertia term is
 * unstable below rho_s/rho_f of about 1, and it excites the vibrations of a disc until elements invert. */
typedef enum { COUPLER_VELOCITY_END, COUPLER_VELOCITY_MEAN } CouplerVelocity;

/* What a mode decides.  The last two functions are collective. */
typedef struct {
  CouplerVelocity velocity;
  PetscBool needs_pressure; /* the fluid sends p with its flow */
  PetscErrorCode (*coefficients)(Coupler coupler, const SolidState *solid); /* sets every pair's a */
  PetscErrorCode (*force)(Coupler coupler);                                 /* sets node from the flow */
} CouplerModeTable;

extern const CouplerModeTable COUPLER_MODE_REACTION, COUPLER_MODE_STRESS_SHELL, COUPLER_MODE_PENALTY_SHELL;

const CouplerModeTable *CouplerModeGet(CouplerMode mode);
#endif
