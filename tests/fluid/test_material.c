// ranks: 1 2 3
/* Density and viscosity as fields with two time levels: a fluid that is given another material is that other
 * fluid; a density that changes within a step counts as its mean; a heavy layer under a light one stays at
 * rest; and a step that is redone starts from the material it started from. */
#include "tests/fluid/exact.h"

#define DT 0.01
#define LIGHT 2.0
#define HEAVY 14.0

static void Push(void *context, double t, const double x[2], double force[2])
{
  force[0] = sin(3.0 * x[1]) * cos(2.0 * x[0]);
  force[1] = x[0] * x[1];
}

static PetscErrorCode Create(const Mesh *mesh, double rho, double mu, FieldFunction push, Fluid *fluid)
{
  Boundary boundary[8] = {0};
  FluidSetup setup = {.theta = 0.5,
                      .rho = rho,
                      .mu = mu,
                      .gravity = {0.0, push ? 0.0 : -9.81},
                      .cfl = 0.5,
                      .dt_max = DT,
                      .boundary = boundary,
                      .source = push};
  PetscFunctionBeginUser;
  for (int b = 0; b < mesh->ntags; b++) boundary[b].kind = BOUNDARY_FREE_SLIP;
  PetscCall(FluidCreate(mesh, &setup, fluid));
  PetscCall(FluidSetInitial(*fluid, 0.0, NULL, NULL, NULL));
  PetscFunctionReturn(0);
}

/* The material of the elements below y, and that of those above it. */
static PetscErrorCode Layers(Fluid fluid, MaterialLevel level, double y, double below, double above,
                             double mu)
{
  const Mesh *m = FluidMesh(fluid);
  double *rho, *viscosity;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(m->ne, &rho, m->ne, &viscosity));
  for (int e = 0; e < m->ne; e++) {
    double sum = 0.0;
    for (int i = 0; i < 3; i++) sum += m->x[2 * m->vertex[3 * e + i] + 1];
    rho[e] = sum <= 3.0 * y ? below : above;
    viscosity[e] = mu;
  }
  PetscCall(FluidSetMaterial(fluid, level, rho, viscosity));
  PetscCall(PetscFree2(rho, viscosity));
  PetscFunctionReturn(0);
}

/* Two steps each; the first fluid's density goes from `before` to `after` in the first of them. */
static PetscErrorCode SameAs(const Mesh *mesh, double before, double after, double constant, int steps)
{
  Fluid fluid, other;
  PetscFunctionBeginUser;
  PetscCall(Create(mesh, LIGHT, 0.3, Push, &fluid));
  PetscCall(Create(mesh, constant, 0.02, Push, &other));
  PetscCall(Layers(fluid, MATERIAL_OLD, 2.0, before, before, 0.02));
  PetscCall(Layers(fluid, MATERIAL_NEW, 2.0, after, after, 0.02));
  for (int k = 0; k < steps; k++) {
    PetscCall(FluidStep(fluid, DT));
    PetscCall(FluidStep(other, DT));
  }
  const double error = LargestVelocity(fluid, other) / LargestVelocity(other, NULL);
  PetscCheck(error < 1e-5, PETSC_COMM_SELF, PETSC_ERR_PLIB,
             "a fluid whose density goes from %g to %g moves %g otherwise than one of %g", before, after,
             error, constant);
  PetscCheck(FluidDensity(fluid)[0] == after, PETSC_COMM_SELF, PETSC_ERR_PLIB, "found %g kg/m3, expected %g",
             FluidDensity(fluid)[0], after);
  PetscCall(FluidDestroy(&fluid));
  PetscCall(FluidDestroy(&other));
  PetscFunctionReturn(0);
}

static PetscErrorCode LayersAtRest(const Mesh *mesh, double ratio)
{
  Fluid fluid;
  PetscFunctionBeginUser;
  PetscCall(Create(mesh, LIGHT, 1e-12, NULL, &fluid));
  PetscCall(Layers(fluid, MATERIAL_OLD, 0.5, ratio * LIGHT, LIGHT, 1e-12));
  PetscCall(Layers(fluid, MATERIAL_NEW, 0.5, ratio * LIGHT, LIGHT, 1e-12));
  PetscCall(FluidStep(fluid, DT));
  const double speed = LargestVelocity(fluid, NULL);
  PetscCheck(speed < 1e-6 * 9.81 * DT, PETSC_COMM_SELF, PETSC_ERR_PLIB,
             "ratio %g: layers at rest move at %g m/s", ratio, speed);
  PetscCall(FluidDestroy(&fluid));
  PetscFunctionReturn(0);
}

/* A step with another material is undone; then the step is what it would have been at first, up to round-off where the
 * pressure is solved so far. */
static PetscErrorCode Redo(const Mesh *mesh)
{
  Fluid fluid, other;
  PetscFunctionBeginUser;
  PetscCall(PetscOptionsSetValue(NULL, "-pressure_varying_ksp_rtol", "1e-13"));
  PetscCall(Create(mesh, LIGHT, 0.02, Push, &fluid));
  PetscCall(Create(mesh, LIGHT, 0.02, Push, &other));
  for (int k = 0; k < 2; k++) {
    PetscCall(Layers(k ? other : fluid, MATERIAL_OLD, 0.5, HEAVY, LIGHT, 0.02));
    PetscCall(Layers(k ? other : fluid, MATERIAL_NEW, 0.5, HEAVY, LIGHT, 0.02));
  }
  PetscCall(FluidSaveState(fluid));
  PetscCall(Layers(fluid, MATERIAL_NEW, 2.0, HEAVY, HEAVY, 0.5));
  PetscCall(FluidStep(fluid, DT));
  PetscCall(FluidRestoreState(fluid));
  PetscCall(FluidStep(fluid, DT));
  PetscCall(FluidStep(other, DT));
  const double error = LargestVelocity(fluid, other) / LargestVelocity(other, NULL);
  PetscCheck(error < 1e-12, PETSC_COMM_SELF, PETSC_ERR_PLIB, "a step that is redone differs by %g", error);
  PetscCall(FluidDestroy(&fluid));
  PetscCall(FluidDestroy(&other));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  Mesh *mesh;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(SquareMesh(0.1, &mesh));
  PetscCall(SameAs(mesh, HEAVY, HEAVY, HEAVY, 3));
  PetscCall(SameAs(mesh, LIGHT, HEAVY, 0.5 * (LIGHT + HEAVY), 1));
  for (double ratio = 10.0; ratio < 2000.0; ratio *= 10.0) PetscCall(LayersAtRest(mesh, ratio));
  PetscCall(Redo(mesh));
  PetscCall(MeshDestroy(&mesh));
  PetscCall(PetscFinalize());
  return 0;
}
