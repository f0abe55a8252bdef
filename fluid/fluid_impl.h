/* Private to the fluid: what is behind the handle.  The solvers (momentum.h, projection.h) keep their own data; here is the
 * flow itself and what the three parts of a step hand each other. */
#ifndef FLUID_IMPL_H
#define FLUID_IMPL_H
#include "fluid/fluid.h"
#include "fluid/material.h"
#include "fluid/momentum.h"
#include "fluid/projection.h"
#include "fluid/solid_coupling.h"

enum { ASSEMBLY, MOMENTUM, PRESSURE, COUPLING, ADAPTATION, SETUP };

struct Fluid_s {
  FluidSetup setup; /* setup.boundary: that of the domain */
  FluidDomain domain;
  Material material;
  SolidCoupling solid;
  MomentumSolver momentum;
  ProjectionSolver projection;
  /* the flow; ghosted, velocities in blocks [2][3] an element, pressure on P2 nodes */
  double t, dt_previous;
  Vec u, u_previous, u_star, u_projected, mass_flux;
  Vec p;
  struct {
    double t, dt_previous;
    Vec u, u_previous, p;
  } saved;
  FluidStats stats;
};
#endif
