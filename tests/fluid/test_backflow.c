// ranks: 1 2
/* A vortex that is faster than the stream that carries it leaves through an open side, and the fluid comes back
 * in there while it does.  Kinetic energy grows by no more than what the stream brings. */
#include "tests/check.h"
#include "tests/fluid/exact.h"

/* The stream of 1 m/s and a vortex of up to 4 m/s, 0.12 m from (1.5, 0.5) m. */
static void Vortex(void *context, double t, const double x[2], double v[])
{
  const double d[2] = {x[0] - 1.5, x[1] - 0.5};
  const double s = 4.0 * exp(0.5 - (d[0] * d[0] + d[1] * d[1]) / (2.0 * 0.12 * 0.12)) / 0.12;
  v[0] = 1.0 - s * d[1];
  v[1] = s * d[0];
}

int main(int argc, char **argv)
{
  Mesh *mesh;
  Fluid fluid;
  Boundary boundary[8] = {0};
  FluidSetup setup = {.theta = 0.5, .rho = 1.0, .mu = 1e-4, .cfl = 1.0, .dt_max = 0.02, .boundary = boundary};
  double start, energy = 0.0, largest = 0.0, momentum[2], t = 0.0;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(BoxMesh(2.0, 0.04, &mesh));
  for (int b = 0; b < mesh->ntags; b++) {
    boundary[b].kind = !strcmp(mesh->tag_name[b], "right")  ? BOUNDARY_OPEN
                       : !strcmp(mesh->tag_name[b], "left") ? BOUNDARY_VELOCITY
                                                            : BOUNDARY_FREE_SLIP;
    boundary[b].velocity[0] = 1.0;
  }
  PetscCall(FluidCreate(mesh, &setup, &fluid));
  PetscCall(FluidSetInitial(fluid, 0.0, Vortex, NULL, NULL));
  PetscCall(FluidMomentumTotal(fluid, momentum, &start));
  while (t < 1.5) {
    PetscCall(FluidStep(fluid, 0.01));
    t += 0.01;
    PetscCall(FluidMomentumTotal(fluid, momentum, &energy));
    largest = fmax(largest, energy);
  }
  CHECK(largest < 1.01 * start, "energy of %g J/m, %g at the start", largest, start);
  PetscCall(FluidDestroy(&fluid));
  PetscCall(MeshDestroy(&mesh));
  PetscCall(PetscFinalize());
  return 0;
}
