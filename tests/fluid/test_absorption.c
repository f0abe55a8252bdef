// ranks: 1 2
/* A uniform stream through a zone of absorption: one that is drawn to its own velocity stays as it is; where it is drawn to rest it cannot slow
 * down, and the pressure before the zone is what the zone takes, rho U rate L/3 for a rate that rises with the square of the way
 * over the length L.  The budget of momentum has it. */
#include "fluid/flow/budget.h"
#include "tests/check.h"
#include "tests/fluid/box_mesh.h"

#define SPEED 0.5
#define RATE 2.0
#define BEGIN 1.0
#define LENGTH 0.8

static PetscErrorCode Stream(const Mesh *mesh, double target, Fluid *fluid)
{
  Boundary boundary[8] = {0};
  FluidSetup setup = {.theta = 0.5,
                      .rho = 3.0,
                      .mu = 1e-3,
                      .velocity = {SPEED, 0.0},
                      .cfl = 1.0,
                      .dt_max = 0.05,
                      .boundary = boundary,
                      .absorption = {1, {{{BEGIN, 0.0}, {BEGIN + LENGTH, 0.0}, {target, 0.0}, RATE, -1}}}};
  PetscFunctionBeginUser;
  for (int b = 0; b < mesh->ntags; b++) {
    boundary[b].kind = !strcmp(mesh->tag_name[b], "right")  ? BOUNDARY_OPEN
                       : !strcmp(mesh->tag_name[b], "left") ? BOUNDARY_VELOCITY
                                                            : BOUNDARY_FREE_SLIP;
    boundary[b].velocity[0] = SPEED;
  }
  PetscCall(FluidCreate(mesh, &setup, fluid));
  PetscCall(FluidSetInitial(*fluid, 0.0, NULL, NULL, NULL));
  for (int k = 0; k < 10; k++) PetscCall(FluidStep(*fluid, 0.05));
  PetscFunctionReturn(0);
}

/* What the zone takes from the stream, N/m, and how far the velocity is from uniform. */
static PetscErrorCode Measure(const Mesh *mesh, Fluid fluid, double *taken, double *change)
{
  const FluidBudget *b = FluidGetBudget(fluid);
  const double mass = 3.0 * 2.0 * 1.0;
  PetscFunctionBeginUser;
  *taken = -b->term[BUDGET_ABSORPTION][0];
  *change = fmax(fabs(b->energy - 0.5 * mass * SPEED * SPEED), fabs(b->momentum[1]));
  CHECK(BudgetDefect(b) < 1e-10, "(%g, %g) N/m are left over of %g", b->rest[0], b->rest[1], b->scale);
  for (int k = 0; k < mesh->ntags; k++)
    if (!strcmp(mesh->tag_name[k], "left"))
      CHECK(fabs(-b->boundary[k][FORCE_PRESSURE][0] - *taken) < 1e-3 * 3.0 * SPEED * RATE * LENGTH / 3.0,
            "pressure %g N/m on the inflow, the zone takes %g", -b->boundary[k][FORCE_PRESSURE][0], *taken);
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  const double expected = 3.0 * SPEED * RATE * LENGTH / 3.0 + 3.0 * SPEED * RATE * (2.0 - BEGIN - LENGTH);
  double taken, change;
  Mesh *mesh;
  Fluid fluid;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(PetscOptionsSetValue(NULL, "-momentum_ksp_rtol", "1e-13"));
  PetscCall(BoxMesh(2.0, 0.05, &mesh));
  PetscCall(Stream(mesh, SPEED, &fluid));
  PetscCall(Measure(mesh, fluid, &taken, &change));
  CHECK(fabs(taken) < 1e-10 && change < 1e-10, "a stream of the zone's velocity: %g N/m, changed by %g",
        taken, change);
  PetscCall(FluidDestroy(&fluid));
  PetscCall(Stream(mesh, 0.0, &fluid));
  PetscCall(Measure(mesh, fluid, &taken, &change));
  CHECK(fabs(taken - expected) < 0.005 * expected, "the zone takes %g of %g N/m", taken, expected);
  CHECK(change < 0.01, "the stream changes by %g", change);
  PetscCall(FluidDestroy(&fluid));
  PetscCall(MeshDestroy(&mesh));
  return PetscFinalize();
}
