// ranks: 1 2
/* A pressure that swings drives the fluid between two plates.  Where they let it slip it moves as a whole, u = P/(L omega) (1 - cos(omega t)):
 * the error is that of time, of second order.  Where they do not it is Womersley's flow, here with the Womersley number 2 (half the gap over
 * sqrt(nu/omega)), in the fourth period and the middle third of a channel of six gaps: ends
 * without traction are not part of it (half a step late it would be wrong by 0.08). */
#include "tests/check.h"
#include "tests/fluid/exact.h"
#include <complex.h>

#define PERIOD 1.0
#define PRESSURE 1e-3
#define OMEGA (2.0 * M_PI / PERIOD)
#define HALF 0.5
#define LENGTH 6.0
#define VISCOSITY (OMEGA * HALF * HALF / 4.0)

/* u at y and t under a pressure of PRESSURE sin(OMEGA t) at x = 0 and none at x = LENGTH, rho = 1. */
static double Velocity(BoundaryKind walls, double y, double t)
{
  if (walls == BOUNDARY_FREE_SLIP) return PRESSURE / (LENGTH * OMEGA) * (1.0 - cos(OMEGA * t));
  const double complex k = csqrt(I * OMEGA / VISCOSITY);
  const double complex profile = 1.0 - ccosh(k * (y - HALF)) / ccosh(k * HALF);
  return cimag(PRESSURE / LENGTH / (I * OMEGA) * profile * cexp(I * OMEGA * t));
}

/* The largest error of u in the middle third, over PRESSURE/(LENGTH OMEGA). */
static PetscErrorCode Error(Fluid f, const Mesh *m, BoundaryKind walls, double t, double *error)
{
  const double *u = FluidVelocity(f);
  PetscFunctionBeginUser;
  *error = 0.0;
  for (int e = 0; e < m->ne; e++)
    for (int i = 0; i < 3; i++) {
      const double *x = ElementVertex(m, e, i);
      if (fabs(x[0] - 0.5 * LENGTH) < LENGTH / 6.0)
        *error = fmax(*error, fabs(u[6 * e + i] - Velocity(walls, x[1], t)));
    }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, error, 1, MPI_DOUBLE, MPI_MAX, m->comm));
  *error *= LENGTH * OMEGA / PRESSURE;
  PetscFunctionReturn(0);
}

/* The largest error at the quarters of the last of so many periods. */
static PetscErrorCode Run(Mesh *mesh, BoundaryKind walls, int periods, double dt, double *error)
{
  const int quarter = (int)lround(0.25 * PERIOD / dt);
  Boundary boundary[8] = {0};
  const FluidSetup setup = {
      .theta = 0.5, .rho = 1.0, .mu = VISCOSITY, .cfl = 1.0, .dt_max = 1.0, .boundary = boundary};
  Fluid fluid;
  PetscFunctionBeginUser;
  for (int b = 0; b < mesh->ntags; b++) {
    const int left = !strcmp(mesh->tag_name[b], "left"), right = !strcmp(mesh->tag_name[b], "right");
    boundary[b].kind = left || right ? BOUNDARY_OPEN : walls;
    boundary[b].pressure = left ? PRESSURE : 0.0;
    boundary[b].period = left ? PERIOD : 0.0;
  }
  PetscCall(FluidCreate(mesh, &setup, &fluid));
  PetscCall(FluidSetInitial(fluid, 0.0, NULL, NULL, NULL));
  *error = 0.0;
  for (int k = 1; k <= 4 * periods * quarter; k++) {
    double now;
    PetscCall(FluidStep(fluid, dt));
    if (k <= 4 * (periods - 1) * quarter || k % quarter) continue;
    PetscCall(Error(fluid, mesh, walls, k * dt, &now));
    *error = fmax(*error, now);
  }
  PetscCall(FluidDestroy(&fluid));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  Mesh *mesh;
  double coarse, fine, viscous;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(BoxMesh(LENGTH, 0.1, &mesh));
  PetscCall(Run(mesh, BOUNDARY_FREE_SLIP, 1, 0.05, &coarse));
  PetscCall(Run(mesh, BOUNDARY_FREE_SLIP, 1, 0.025, &fine));
  PetscCall(Run(mesh, BOUNDARY_VELOCITY, 4, 0.025, &viscous));
  CHECK(fine < 0.01 && coarse > 3.5 * fine, "plug flow: errors %g, %g with half of the step", coarse, fine);
  CHECK(viscous < 0.04, "Womersley's flow: error %g", viscous);
  PetscCall(MeshDestroy(&mesh));
  PetscCall(PetscFinalize());
  return 0;
}
