/* Jointed bodies for the tests of fracture. */
#ifndef TESTS_SOLID_CRACK_H
#define TESTS_SOLID_CRACK_H
#include "tests/solid/build.h"

/* A rock: strengths in Pa, energy in J/m2. */
static inline Material RockOf(double tensile, double shear, double energy, double damping)
{
  Material m = MaterialOf(2500.0, 3e10, 0.2, damping);
  m.strength[0] = tensile;
  m.strength[1] = shear;
  m.fracture_energy[0] = m.fracture_energy[1] = energy;
  return m;
}

/* As a fluid that pushes to the right, stronger in a step that is tried. */
static inline PetscErrorCode PushStep(Solid s, double strength)
{
  SolidView v = ViewOf(s, NULL, NULL);
  double *load = calloc(2 * (size_t)v.nnodes + 1, sizeof *load);
  for (int k = 0; k < v.nfacets; k++)
    for (int i = 0; i < 2; i++)
      load[2 * v.facet[2 * k + i]] +=
          strength * (v.x[2 * v.facet[2 * k + 1] + 1] - v.x[2 * v.facet[2 * k] + 1]);
  PetscCall(RunStep(s, 1e-5, load));
  free(load);
  return 0;
}

/* Gives nodes that are fixed, and so keep their velocity for ever, one along `axis`: -speed those on the left
 * of `middle` at rest, speed the others. */
static inline void Draw(Solid s, const Model *a, int axis, double middle, double speed)
{
  double *v;
  const SolidView view = ViewOf(s, NULL, &v);
  for (int n = 0; n < view.nnodes; n++)
    if (view.gid[n] < a->nnodes && a->fixed[view.gid[n]])
      v[2 * n + axis] = view.rest[2 * n] < middle ? -speed : speed;
}

/* The force that holds the nodes drawn with exactly this velocity along `axis`, whose parts are drawn as they
 * are. */
static inline PetscErrorCode SupportReaction(Solid s, int axis, double speed, double *sum)
{
  const SolidView view = ViewOf(s, NULL, NULL);
  const double *force;
  PetscCall(SolidForces(s, &force));
  *sum = 0.0;
  for (int n = 0; n < view.nnodes; n++)
    if (view.v[2 * n + axis] == speed && view.v[2 * n + 1 - axis] == 0.0) *sum -= force[2 * n + axis];
  return 0;
}
#endif
