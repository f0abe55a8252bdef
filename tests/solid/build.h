/* Bodies for the solid's tests, and the little checks that they share. */
#ifndef TESTS_SOLID_BUILD_H
#define TESTS_SOLID_BUILD_H
#include "check.h"
#include "shape.h"
#include "solid.h"

static inline Material MaterialOf(double density, double youngs_modulus, double poisson_ratio, double damping)
{
  return (Material){.density = density,
                    .youngs_modulus = youngs_modulus,
                    .poisson_ratio = poisson_ratio,
                    .damping = damping,
                    .penalty = youngs_modulus};
}

static inline BodySetup BodyAtRest(Material material)
{
  return (BodySetup){.material = material, .stretch = {1.0, 1.0}};
}

static inline void AddMesh(Assembly *a, MeshSerial *mesh, const BodySetup *setup)
{
  const char *why = NULL;
  CHECK(!AssemblyAdd(a, mesh, setup, &why), "%s", why);
  (void)MeshSerialDestroy(mesh);
}

static inline void AddDisc(Assembly *a, double x, double y, double radius, double size,
                           const BodySetup *setup)
{
  const double centre[2] = {x, y};
  MeshSerial mesh;
  (void)ShapeDisc(centre, radius, size, &mesh);
  AddMesh(a, &mesh, setup);
}

/* A rectangle whose inner nodes are shaken by 0.2 size when `shake` is not 0. */
static inline void AddRectangle(Assembly *a, double x, double y, double width, double height, double angle,
                                double size, int shake, const BodySetup *setup)
{
  const double centre[2] = {x, y};
  MeshSerial mesh;
  (void)ShapeRectangle(centre, width, height, angle, size, &mesh);
  char *outer = calloc((size_t)mesh.nv, 1);
  for (int k = 0; k < 2 * mesh.nb; k++) outer[mesh.facet[k]] = 1;
  for (int k = 0; shake && k < 2 * mesh.nv; k++)
    if (!outer[k / 2]) mesh.x[k] += 0.2 * size * sin(12.9898 * k + 4.1);
  free(outer);
  AddMesh(a, &mesh, setup);
}

/* One rank's solid, writable. */
static inline SolidView ViewOf(Solid s, double **x, double **v)
{
  SolidView view;
  SolidGetView(s, &view);
  if (x) *x = (double *)(size_t)view.x;
  if (v) *v = (double *)(size_t)view.v;
  return view;
}

/* Runs from now on for `time` in steps of dt without load. */
static inline PetscErrorCode Run(Solid s, double time, double dt)
{
  const int steps = (int)ceil(time / dt * (1.0 - 1e-12));
  double h;
  for (int k = 0; k < steps; k++) {
    PetscCall(SolidStart(s, time / steps, NULL));
    while (SolidRemaining(s)) PetscCall(SolidSubstep(s, &h));
  }
  return 0;
}

static inline PetscErrorCode TotalEnergy(Solid s, int nbodies, double *energy)
{
  BodyState state[8];
  PetscCall(SolidBodies(s, nbodies, state));
  *energy = 0.0;
  for (int b = 0; b < nbodies; b++) *energy += state[b].kinetic + state[b].strain;
  return 0;
}
#endif
