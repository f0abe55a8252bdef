/* The fluid's momentum over a step, and the forces on its boundaries.  The momentum equation (momentum.h), the projection and
 * the coupler's correction, tested with 1 on all elements, where interior faces cancel but for what is said below:
 *
 *   (P^{n+1} - P^n)/dt  =  sum of terms  -  sum over boundaries of (pressure + viscous + convection)  +  rest,    N/m
 *
 *   P           sum over K of rho_K int u, rho_K at the same time
 *   weight      rho |K| g, rho of the step, and the body force
 *   solid       s - a u* - I (G u_projected - kept start), where K is covered less rho M/dt start: minus the reaction on the solid
 *               (coupler/force/force.h), equal to round-off
 *   correction  rho^{n+1} r/dt, r of solid_coupling.h
 *   divergence  sum (d_j + (rho^{n+1} - rho^n) |K|/(3 dt)) u_j, d_j the weak divergence of the mass flux (kernels.h), u at
 *               t + theta dt: the advective form of one fluid lets what its mass flux lacks of balance have the velocity there.  With
 *               phases the mass flux is balanced in each element, and it is round-off
 *   interface   with phases: rho (weight - R^-1 grad p_0) - (rho g - grad p_0), which includes surface tension
 *   absorption  rho |K| k (U - u), u at t + theta dt (absorption.h)
 *   adaptation  what has changed P between two steps: transfer to another mesh, the projection of its velocity, at the start of a
 *               run the solid's velocity inside it (FluidStartInside)
 *   pressure    int p n, p at the step's end
 *   viscous     int P (-tau n + eta (u - g)), P of boundary.h: what the scheme takes from the fluid, at t + theta dt
 *   convection  int m.n u - k min(m.n, 0) (u - g): momentum that leaves; k = 1/2 where one fluid's boundary is open, 0 where it
 *               slips, else 1
 *
 * rest is what the linear solver of the momentum equation leaves of its sum; the sum has no part of the pressure's solver.  Terms are
 * on the fluid, boundaries' forces on the boundary. */
#ifndef FLUID_BUDGET_H
#define FLUID_BUDGET_H
#include "fluid/flow/fluid.h"

enum {
  BUDGET_WEIGHT,
  BUDGET_SOLID,
  BUDGET_CORRECTION,
  BUDGET_DIVERGENCE,
  BUDGET_INTERFACE,
  BUDGET_ABSORPTION,
  BUDGET_ADAPTATION,
  BUDGET_TERMS
};
enum { FORCE_PRESSURE, FORCE_VISCOUS, FORCE_CONVECTION, FORCE_PARTS };

/* On one boundary: x and y of each part, N/m. */
typedef double BoundaryForce[FORCE_PARTS][2];

typedef struct {
  double dt;                  /* s */
  double start[2];            /* momentum that the step begins with, that of the end of the last one, kg/s */
  double momentum[2], energy; /* at the step's end, kg/s and J/m */
  double term[BUDGET_TERMS][2]; /* N/m */
  double rest[2];               /* N/m */
  double scale; /* N/m: the sum of the absolute values of all terms and of all parts on all boundaries */
  BoundaryForce *boundary; /* [mesh->ntags] */
} FluidBudget;

/* Of the last step, the same on all ranks; borrowed.  Not collective. */
const FluidBudget *FluidGetBudget(Fluid fluid);
/* Length of rest over scale; 0 where nothing acts. */
double BudgetDefect(const FluidBudget *budget);
#endif
