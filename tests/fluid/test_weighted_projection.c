// ranks: 1 2 3
/* Elements that carry a solid's inertia are a heavier fluid: a heavy layer under a light one is at rest after
 * one step, whatever its density, and a box that is heavy throughout moves as a fluid of that density; one that is heavy in some
 * directions more than in others is at rest, too. */
#include "tests/fluid/exact.h"

#define DT 0.01
#define LIGHT 1.0
static const double GRAVITY[2] = {0.0, -9.81};
static const double ALL[2][2] = {{1.0, 0.0}, {0.0, 1.0}}, SOME[2][2] = {{0.3, -0.2}, {-0.2, 0.9}};

/* Inertia (heavy - LIGHT) M/dt times the tensor, and its weight, on elements below y; u^n at rest. */
static PetscErrorCode Load(Fluid fluid, double heavy, double below, const double tensor[2][2])
{
  const Mesh *m = FluidMesh(fluid);
  CoracleCoupling *coupling;
  int n = 0;
  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(m->ne, &coupling));
  for (int e = 0; e < m->ne; e++) {
    const double *x[3] = {m->x + 2 * m->vertex[3 * e], m->x + 2 * m->vertex[3 * e + 1],
                          m->x + 2 * m->vertex[3 * e + 2]};
    const double area =
        0.5 * ((x[1][0] - x[0][0]) * (x[2][1] - x[0][1]) - (x[2][0] - x[0][0]) * (x[1][1] - x[0][1]));
    CoracleCoupling *k = coupling + n;
    if (x[0][1] + x[1][1] + x[2][1] > 3.0 * below) continue;
    n++;
    k->element = e;
    k->flags = CORACLE_HAS_INERTIA;
    memcpy(k->inertia_tensor, tensor, sizeof k->inertia_tensor);
    for (int c = 0; c < 2; c++)
      for (int i = 0; i < 3; i++) {
        k->s[c][i] = (heavy - LIGHT) * (tensor[c][0] * GRAVITY[0] + tensor[c][1] * GRAVITY[1]) * area / 3.0;
        for (int j = 0; j < 3; j++)
          k->implicit_inertia[i][j] = (heavy - LIGHT) / DT * area / (i == j ? 6.0 : 12.0);
      }
  }
  PetscCall(FluidSetCoupling(fluid, n, coupling));
  PetscCall(PetscFree(coupling));
  PetscFunctionReturn(0);
}

static void Push(void *context, double t, const double x[2], double force[2])
{
  force[0] = sin(3.0 * x[1]) * cos(2.0 * x[0]);
  force[1] = x[0] * x[1];
}

/* One step from rest of a fluid of density rho, loaded to be as heavy as `heavy` below y.  Almost inviscid:
 * before the projection one layer slides on the other. */
static PetscErrorCode Step(const Mesh *mesh, double rho, double heavy, double below,
                           const double tensor[2][2], FieldFunction push, Fluid *fluid)
{
  Boundary boundary[8] = {0};
  FluidSetup setup = {.theta = 0.5,
                      .rho = rho,
                      .mu = 1e-12,
                      .gravity = {GRAVITY[0], GRAVITY[1]},
                      .cfl = 0.5,
                      .dt_max = DT,
                      .boundary = boundary,
                      .source = push};
  PetscFunctionBeginUser;
  for (int b = 0; b < mesh->ntags; b++) boundary[b].kind = BOUNDARY_FREE_SLIP;
  PetscCall(FluidCreate(mesh, &setup, fluid));
  PetscCall(FluidSetInitial(*fluid, 0.0, NULL, NULL, NULL));
  PetscCall(Load(*fluid, heavy, below, tensor));
  PetscCall(FluidStep(*fluid, DT));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  Mesh *mesh;
  Fluid fluid, heavy;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(SquareMesh(0.1, &mesh));
  /* both fluids start with all of gravity, which the pressure has to take away to the last digits compared */
  PetscCall(PetscOptionsSetValue(NULL, "-momentum_ksp_rtol", "1e-9"));
  PetscCall(PetscOptionsSetValue(NULL, "-pressure_varying_ksp_rtol", "1e-10"));
  for (double ratio = 10.0; ratio < 2000.0; ratio *= 10.0) {
    PetscCall(Step(mesh, LIGHT, ratio * LIGHT, 0.5, ALL, NULL, &fluid));
    const double speed = LargestVelocity(fluid, NULL);
    PetscCheck(speed < 1e-6 * 9.81 * DT, PETSC_COMM_SELF, PETSC_ERR_PLIB,
               "ratio %g: layers at rest move at %g m/s", ratio, speed);
    PetscCall(FluidDestroy(&fluid));
    PetscCall(Step(mesh, LIGHT, ratio * LIGHT, 2.0, SOME, NULL, &fluid));
    const double along = LargestVelocity(fluid, NULL);
    PetscCheck(along < 1e-6 * 9.81 * DT, PETSC_COMM_SELF, PETSC_ERR_PLIB,
               "ratio %g: a box with an inertia tensor moves at %g m/s", ratio, along);
    PetscCall(FluidDestroy(&fluid));
  }
  PetscCall(Step(mesh, LIGHT, 8.0 * LIGHT, 2.0, ALL, Push, &fluid));
  PetscCall(Step(mesh, 8.0 * LIGHT, LIGHT, -1.0, ALL, Push, &heavy));
  const double error = LargestVelocity(fluid, heavy) / LargestVelocity(heavy, NULL);
  PetscCheck(error < 1e-5, PETSC_COMM_SELF, PETSC_ERR_PLIB,
             "a loaded fluid moves %g otherwise than a heavy one", error);
  PetscCall(FluidDestroy(&fluid));
  PetscCall(FluidDestroy(&heavy));
  PetscCall(MeshDestroy(&mesh));
  PetscCall(PetscFinalize());
  return 0;
}
