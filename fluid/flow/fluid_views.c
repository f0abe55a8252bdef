/* What others see of the fluid. */
#include "fluid/flow/fluid_impl.h"

/* The array of a Vec that stays where it is as long as the Vec lives. */
static const double *View(Vec v)
{
  const PetscScalar *array = NULL, *view;
  (void)VecGetArrayRead(v, &array);
  view = array;
  (void)VecRestoreArrayRead(v, &array); /* nulls array */
  return view;
}

const double *FluidVelocity(Fluid f)
{
  return View(f->u);
}
const double *FluidVelocityStar(Fluid f)
{
  return View(f->u_star);
}
const double *FluidVelocityProjected(Fluid f)
{
  return View(f->u_projected);
}
const double *FluidPressure(Fluid f)
{
  return View(f->p);
}
const double *FluidDensity(Fluid f)
{
  return MaterialDensity(f->material, MATERIAL_NEW);
}
const double *FluidViscosity(Fluid f)
{
  return MaterialViscosity(f->material, MATERIAL_NEW);
}
void FluidStartVelocity(Fluid f, int e, double start[])
{
  SolidCouplingStart(f->solid, e, FluidVelocity(f) + 6 * e, start);
}
const double *FluidGravity(Fluid f)
{
  return f->setup.gravity;
}

const double *FluidSolidFraction(Fluid f)
{
  return SolidCouplingFraction(f->solid);
}
PhaseTransport FluidPhases(Fluid f)
{
  return f->phases;
}
const FluidStats *FluidGetStats(Fluid f)
{
  return &f->stats;
}
const Mesh *FluidMesh(Fluid f)
{
  return f->domain.mesh;
}
const P2Space *FluidPressureSpace(Fluid f)
{
  return f->domain.p2;
}

const double *FluidRemainder(Fluid f)
{
  return f->remainder;
}
