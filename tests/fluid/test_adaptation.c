// ranks: 1 2 3
/* A flow with a known solution on a mesh that adapts to it: its error follows the one asked for, momentum
 * goes over to round-off, the pressure does not jump; and a fluid at rest stays at rest. */
#include "tests/check.h"
#include "tests/fluid/adapting.h"
#include "tests/fluid/exact.h"

typedef struct {
  Mesh *mesh;
  Fluid fluid;
  Adaptation adaptation;
  PetscBool new_mesh;
  int meshes;
} RunState;

static double Norm(const double v[2])
{
  return hypot(v[0], v[1]);
}

/* Momentum before and after, against what moves at all: sqrt(2 m E). */
static PetscErrorCode TransferKeeps(Fluid from, Fluid to)
{
  double before[2], after[2], energy[2];
  PetscFunctionBeginUser;
  PetscCall(FluidMomentumTotal(from, before, &energy[0]));
  PetscCall(FluidTransfer(from, to));
  PetscCall(FluidMomentumTotal(to, after, &energy[1]));
  const double scale = sqrt(2.0 * RHO * energy[0]), lost[2] = {after[0] - before[0], after[1] - before[1]};
  CHECK(Norm(lost) <= 1e-12 * scale, "momentum changes by %g of %g", Norm(lost), scale);
  CHECK(energy[1] <= energy[0] * (1.0 + 1e-12), "energy grows from %g to %g", energy[0], energy[1]);
  PetscFunctionReturn(0);
}

static PetscErrorCode Step(RunState *m, double dt)
{
  PetscFunctionBeginUser;
  PetscCall(AdaptingStep(m->adaptation, dt, TransferKeeps, &m->mesh, &m->fluid, &m->new_mesh));
  m->meshes += m->new_mesh;
  PetscFunctionReturn(0);
}

static PetscErrorCode Destroy(RunState *m)
{
  PetscFunctionBeginUser;
  PetscCall(AdaptationDestroy(&m->adaptation));
  PetscCall(FluidDestroy(&m->fluid));
  PetscCall(MeshDestroy(&m->mesh));
  PetscFunctionReturn(0);
}

/* The errors at the end of 12 steps with four meshes, for an interpolation error asked for. */
static PetscErrorCode Vortex(double asked, double *velocity, double *pressure, PetscInt *triangles)
{
  const AdaptationSetup setup = {.size_min = 0.01,
                                 .corner_size = 0.01,
                                 .size_max = 0.3,
                                 .velocity_error = asked,
                                 .growth = 1.5,
                                 .anisotropy = 5.0,
                                 .elements_max = 1e5,
                                 .every = 3};
  Exact exact = {2.0};
  RunState m = {0};
  PetscFunctionBeginUser;
  PetscCall(SquareMesh(0.02, &m.mesh));
  PetscCall(ExactFluid(m.mesh, &exact, ExactSource, MU, &m.fluid));
  PetscCall(AdaptationCreate(&setup, &m.adaptation));
  for (int k = 0; k < 12; k++) PetscCall(Step(&m, 0.005));
  CHECK(m.meshes == 4, "%d meshes", m.meshes);
  PetscCall(ExactErrors(m.fluid, &exact, (const double[2]){0.06, 0.06}, velocity, pressure));
  *triangles = m.mesh->nglobal;
  PetscCall(Destroy(&m));
  PetscFunctionReturn(0);
}

static PetscErrorCode Rest(void)
{
  const AdaptationSetup setup = {.size_min = 0.02,
                                 .corner_size = 0.02,
                                 .size_max = 0.3,
                                 .velocity_error = 0.01,
                                 .growth = 1.5,
                                 .anisotropy = 5.0,
                                 .elements_max = 1e5,
                                 .every = 2};
  Boundary boundary[8] = {0};
  FluidSetup fluid = {
      .theta = 0.5, .rho = 1000.0, .mu = 1.0, .gravity = {1.0, -9.81}, .cfl = 0.5, .dt_max = 0.01};
  RunState m = {0};
  double speed = 0.0;
  PetscFunctionBeginUser;
  PetscCall(SquareMesh(0.1, &m.mesh));
  for (int b = 0; b < m.mesh->ntags; b++) boundary[b].kind = b % 2 ? BOUNDARY_OPEN : BOUNDARY_VELOCITY;
  fluid.boundary = boundary;
  PetscCall(FluidCreate(m.mesh, &fluid, &m.fluid));
  PetscCall(FluidSetInitial(m.fluid, 0.0, NULL, NULL, NULL));
  PetscCall(AdaptationCreate(&setup, &m.adaptation));
  for (int k = 0; k < 6; k++) PetscCall(Step(&m, 0.01));
  for (int k = 0; k < 6 * m.mesh->ne; k++) speed = fmax(speed, fabs(FluidVelocity(m.fluid)[k]));
  CHECK(speed < 1e-10, "a fluid at rest moves at %g m/s", speed);
  CHECK(m.mesh->nglobal < 60, "%d triangles where nothing moves", (int)m.mesh->nglobal);
  PetscCall(Destroy(&m));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  double u[2], p[2];
  PetscInt n[2];
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(Rest());
  PetscCall(Vortex(0.02, &u[0], &p[0], &n[0]));
  PetscCall(Vortex(0.005, &u[1], &p[1], &n[1]));
  if (argc > 1)
    PetscCall(PetscPrintf(PETSC_COMM_WORLD, "triangles %d %d velocity %g %g pressure %g %g\n", (int)n[0],
                          (int)n[1], u[0], u[1], p[0], p[1]));
  /* a quarter of the error: four times the triangles, half the size, and order 2 */
  CHECK(n[1] > 3.0 * n[0] && n[1] < 5.0 * n[0], "%d and %d triangles", (int)n[0], (int)n[1]);
  CHECK(u[0] < 0.02 && u[1] < u[0] / 3.2, "velocity errors %g and %g", u[0], u[1]);
  CHECK(p[1] < p[0] / 2.5, "pressure errors %g and %g", p[0], p[1]);
  PetscCall(PetscFinalize());
  return 0;
}
