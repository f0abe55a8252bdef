// ranks: 1 2 3
/* The budget of momentum closes in each step to 1e-10 of its terms when the momentum equation is solved to 1e-13, with every kind of
 * boundary, absorption, theta, moving phases, surface tension, a gas, adapting meshes.  Forces on walls: water at rest weighs on them, and in a
 * channel they take the pressure drop. */
#include "fluid/flow/budget.h"
#include "tests/fluid/adapting_tank.h"
#include "tests/fluid/box_mesh.h"

#define CLOSED 1e-10

static double Length(const double v[2])
{
  return hypot(v[0], v[1]);
}

/* The last step's, whose momentum is that of the fluid. */
static PetscErrorCode CheckClosed(Fluid fluid, const char *what, int step)
{
  const FluidBudget *b = FluidGetBudget(fluid);
  double momentum[2], energy;
  PetscFunctionBeginUser;
  CHECK(b->scale > 0.0 && BudgetDefect(b) < CLOSED, "%s, step %d: (%g, %g) N/m are left over of %g", what,
        step, b->rest[0], b->rest[1], b->scale);
  PetscCall(FluidMomentumTotal(fluid, momentum, &energy));
  for (int c = 0; c < 2; c++)
    CHECK(fabs(momentum[c] - b->momentum[c]) <= 1e-12 * b->scale * b->dt,
          "%s, step %d: momentum %g, %g in the budget", what, step, momentum[c], b->momentum[c]);
  CHECK(fabs(energy - b->energy) <= 1e-12 * energy, "%s, step %d: energy %g, %g in the budget", what, step,
        energy, b->energy);
  PetscFunctionReturn(0);
}

/* --- one fluid -------------------------------------------------------------------------------------------- */

/* A stream of 1 m/s and a vortex that makes it come in through the open side. */
static void Vortex(void *context, double t, const double x[2], double v[])
{
  const double d[2] = {x[0] - 1.8, x[1] - 0.5};
  const double s = 4.0 * exp(0.5 - (d[0] * d[0] + d[1] * d[1]) / (2.0 * 0.12 * 0.12)) / 0.12;
  v[0] = 1.0 - s * d[1];
  v[1] = s * d[0];
}

/* In and out through a wall. */
static void Breathing(void *context, double t, const double x[2], double v[])
{
  v[0] = 0.5;
  v[1] = 0.2 * sin(10.0 * t) * sin(3.0 * M_PI * x[0]);
}

static void BodyForce(void *context, double t, const double x[2], double force[])
{
  force[0] = x[1] * cos(5.0 * t);
  force[1] = 2.0 + x[0] * t;
}

static PetscErrorCode Stream(double theta)
{
  Boundary boundary[8] = {0};
  FluidSetup setup = {.theta = theta,
                      .rho = 2.0,
                      .mu = 1e-3,
                      .gravity = {0.3, -1.0},
                      .cfl = 1.0,
                      .dt_max = 1.0,
                      .source = BodyForce,
                      .absorption = {1, {{{1.0, 0.0}, {1.7, 0.3}, {0.5, 0.2}, 3.0, 0}}},
                      .boundary = boundary};
  Mesh *mesh;
  Fluid fluid;
  PetscFunctionBeginUser;
  PetscCall(BoxMesh(2.0, 0.08, &mesh));
  for (int b = 0; b < mesh->ntags; b++) {
    const char *name = mesh->tag_name[b];
    boundary[b].kind = !strcmp(name, "right") ? BOUNDARY_OPEN
                       : !strcmp(name, "top") ? BOUNDARY_FREE_SLIP
                                              : BOUNDARY_VELOCITY;
    if (!strcmp(name, "bottom")) boundary[b].function = Breathing;
    boundary[b].velocity[0] = 1.0;
    boundary[b].parabolic = PETSC_TRUE;
    boundary[b].rise = 0.1;
  }
  PetscCall(FluidCreate(mesh, &setup, &fluid));
  PetscCall(FluidSetInitial(fluid, 0.0, Vortex, NULL, NULL));
  PetscCall(FluidMakeSolenoidal(fluid));
  for (int k = 0; k < 8; k++) {
    PetscCall(FluidStep(fluid, k % 3 ? 0.01 : 0.02));
    PetscCall(CheckClosed(fluid, "stream", k));
  }
  const FluidBudget *b = FluidGetBudget(fluid);
  CHECK(Length(b->term[BUDGET_DIVERGENCE]) > 1e4 * CLOSED * b->scale, "divergence (%g, %g) of %g N/m",
        b->term[BUDGET_DIVERGENCE][0], b->term[BUDGET_DIVERGENCE][1], b->scale);
  PetscCall(FluidDestroy(&fluid));
  PetscCall(MeshDestroy(&mesh));
  PetscFunctionReturn(0);
}

/* Of a box at rest, 2 m x 1 m: all boundaries take the weight, the sides half of rho g each. */
static PetscErrorCode Hydrostatic(BoundaryKind kind)
{
  const double rho = 1000.0, g = 9.81, weight = 2.0 * rho * g;
  Boundary boundary[8] = {0};
  FluidSetup setup = {.theta = 0.5,
                      .rho = rho,
                      .mu = 1.0,
                      .gravity = {0.0, -g},
                      .cfl = 0.5,
                      .dt_max = 0.01,
                      .boundary = boundary};
  double sum[2] = {0.0}, right[2];
  Mesh *mesh;
  Fluid fluid;
  PetscFunctionBeginUser;
  PetscCall(BoxMesh(2.0, 0.1, &mesh));
  for (int b = 0; b < mesh->ntags; b++)
    boundary[b].kind = strcmp(mesh->tag_name[b], "top") ? kind : BOUNDARY_OPEN;
  PetscCall(FluidCreate(mesh, &setup, &fluid));
  PetscCall(FluidSetInitial(fluid, 0.0, NULL, NULL, NULL));
  for (int k = 0; k < 3; k++) PetscCall(FluidStep(fluid, 0.01));
  PetscCall(CheckClosed(fluid, "at rest", 3));
  for (int b = 0; b < mesh->ntags; b++) {
    double force[2];
    PetscCall(FluidBoundaryForce(fluid, mesh->tag_name[b], force));
    for (int c = 0; c < 2; c++) sum[c] += force[c];
  }
  PetscCall(FluidBoundaryForce(fluid, "right", right));
  CHECK(fabs(sum[1] + weight) < 1e-10 * weight && fabs(sum[0]) < 1e-10 * weight,
        "(%g, %g) N/m on all, weight %g", sum[0], sum[1], weight);
  CHECK(fabs(right[0] - 0.5 * rho * g) < 1e-10 * weight && fabs(right[1]) < 1e-10 * weight,
        "(%g, %g) N/m on a side", right[0], right[1]);
  PetscCall(FluidDestroy(&fluid));
  PetscCall(MeshDestroy(&mesh));
  PetscFunctionReturn(0);
}

/* Driven through a channel, 2 m x 1 m, by a pressure so small that what is convected is below round-off. */
static PetscErrorCode Poiseuille(void)
{
  const double drop = 1e-9, mu = 1.0, dt = 0.1;
  Boundary boundary[8] = {0};
  FluidSetup setup = {.theta = 1.0, .rho = 1.0, .mu = mu, .cfl = 1.0, .dt_max = 1.0, .boundary = boundary};
  double bottom[2], top[2], before[2], after[2];
  Mesh *mesh;
  Fluid fluid;
  PetscFunctionBeginUser;
  PetscCall(BoxMesh(2.0, 0.1, &mesh));
  for (int b = 0; b < mesh->ntags; b++) {
    const int left = !strcmp(mesh->tag_name[b], "left"), right = !strcmp(mesh->tag_name[b], "right");
    boundary[b].kind = left || right ? BOUNDARY_OPEN : BOUNDARY_VELOCITY;
    if (left) boundary[b].pressure = drop;
  }
  PetscCall(FluidCreate(mesh, &setup, &fluid));
  PetscCall(FluidSetInitial(fluid, 0.0, NULL, NULL, NULL));
  for (int k = 0; k < 60; k++) {
    PetscCall(FluidMomentumTotal(fluid, before, NULL));
    PetscCall(FluidStep(fluid, dt));
  }
  PetscCall(CheckClosed(fluid, "channel", 60));
  PetscCall(FluidMomentumTotal(fluid, after, NULL));
  PetscCall(FluidBoundaryForce(fluid, "bottom", bottom));
  PetscCall(FluidBoundaryForce(fluid, "top", top));
  const double walls = bottom[0] + top[0], faster = (after[0] - before[0]) / dt;
  CHECK(fabs(walls + faster - drop) < CLOSED * drop, "walls take %g of the pressure drop, the fluid %g",
        walls / drop, faster / drop);
  CHECK(fabs(faster) < 1e-3 * drop, "the fluid takes %g of it", faster / drop);
  CHECK(fabs(top[0] - 0.5 * drop) < 0.02 * drop, "one wall takes %g of it", top[0] / drop);
  PetscCall(FluidDestroy(&fluid));
  PetscCall(MeshDestroy(&mesh));
  PetscFunctionReturn(0);
}

/* --- phases ----------------------------------------------------------------------------------------------- */

/* A column collapses on meshes that adapt to it.  Phases move momentum with their mass: its flux has no divergence. */
static PetscErrorCode Column(const PhaseProperties *phases, const char *what)
{
  const Region region[2] = {{.shape = REGION_BOX, .phase = 1, .a = {-1, -1}, .b = {2, 2}},
                            {.shape = REGION_BOX, .phase = 0, .a = {-1, -1}, .b = {0.3, 0.6}}};
  AdaptationSetup setup = TANK_ADAPTATION;
  AdaptingTank m = {0};
  PetscFunctionBeginUser;
  PetscCall(TankCreatePhases(12, 5u, phases, 2, region, NULL, &m.tank));
  setup.size_min = setup.corner_size = setup.interface_size = 0.06;
  PetscCall(AdaptationCreate(&setup, &m.adaptation));
  for (int k = 0; k < 12; k++) {
    PetscCall(AdaptingTankStep(&m, 0.002));
    if (m.new_mesh) continue; /* the new fluid has no step yet */
    const FluidBudget *b = FluidGetBudget(m.tank.fluid);
    PetscCall(CheckClosed(m.tank.fluid, what, k));
    CHECK(Length(b->term[BUDGET_DIVERGENCE]) < CLOSED * b->scale, "%s, step %d: divergence of %g of %g N/m",
          what, k, Length(b->term[BUDGET_DIVERGENCE]), b->scale);
  }
  CHECK(m.meshes > 1, "%s: %d meshes", what, m.meshes);
  PetscCall(AdaptingTankDestroy(&m));
  PetscFunctionReturn(0);
}

static PetscErrorCode ManyPhases(void)
{
  PhaseProperties water = {.n = 2, .rho = {WATER, AIR}, .mu = {1e-3, 1.8e-5}}, gas = water, tension = water;
  PetscFunctionBeginUser;
  PetscCall(Column(&water, "water and air"));
  gas.state[1] = (EquationOfState){.pressure = 1e5, .exponent = 1.4};
  PetscCall(Column(&gas, "water and gas"));
  tension.surface_tension.value[0][1] = tension.surface_tension.value[1][0] = 0.07;
  PetscCall(Column(&tension, "surface tension"));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(PetscOptionsSetValue(NULL, "-momentum_ksp_rtol", "1e-13"));
  PetscCall(Stream(0.5));
  PetscCall(Stream(0.75));
  PetscCall(Stream(1.0));
  PetscCall(Hydrostatic(BOUNDARY_VELOCITY));
  PetscCall(Hydrostatic(BOUNDARY_FREE_SLIP));
  PetscCall(Poiseuille());
  PetscCall(ManyPhases());
  PetscCall(PetscFinalize());
  return 0;
}
