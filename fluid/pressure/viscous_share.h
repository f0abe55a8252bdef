/* Among phases: the part of the last step's dynamic pressure that the momentum equation feels.
 *
 * The pressure of phases is p_0, which gravity makes with the lines of the step, and phi, which the projection makes anew in each step
 * (fluid/README.md), since the last phi has its kinks where the interface was.  But a u* that has not felt phi has not the boundary layers that
 * viscosity makes with it: where viscosity crosses a channel within a step the stream was a plug, with a sixth of its pressure.  So the momentum
 * equation has the force - chi grad phi^n,
 *
 *     chi  =  z/(1 + z),     z  =  mu dt/(rho h^2),     h^2 twice an element's area,
 *
 * and u* gets dt/rho chi grad phi^n back before the projection, which makes all of phi.  chi is the element's own: viscosity levels what its jumps do.  What of the
 * velocity has not felt phi is 1 - chi of dt/rho grad phi, in a steady stream h^2/H^2 of it, H the channel's width, with any step.  In water and air
 * chi is some 1e-3 or less.  Not with compressible phases, nor in elements with a part of a solid, whose inertia the pressure moves,
 * too: with it there what grows in slivers beside a disc that is pushed (tests/coupled/README.md, "Very viscous fluids") does so from the eighth step on; without it from the 35th, without
 * any share from the tenth.
 *
 * Two layers, one ten times as viscous, in a channel with 20 elements and z of 40 and 400 (tests/fluid/test_viscous_phases.c): velocity and pressure's gradient are
 * 7 and 4 % off, without it 36 and 70 %; with 10 elements 12 and 10 %. */
#ifndef FLUID_VISCOUS_SHARE_H
#define FLUID_VISCOUS_SHARE_H

/* chi; area, m2; rho, kg/m3; mu, Pa s; dt, s */
static inline double ViscousShare(double area, double rho, double mu, double dt)
{
  const double z = mu * dt / (2.0 * area * rho);
  return z / (1.0 + z);
}
#endif
