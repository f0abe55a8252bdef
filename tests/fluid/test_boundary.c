/* A velocity that is prescribed rises smoothly and keeps its profile, which may be a table, whose flux is exact; it may swing, or follow a
 * table, once or in each period; a level does. */
#include "fluid/flow/fluid_impl.h"
#include "tests/check.h"
#include "tests/fluid/box_mesh.h"

static void Factors(void)
{
  static const double ROW[] = {0.0, 1.0, 0.5, 3.0, 1.0, 2.0};
  const double time[] = {-1.0, 0.25, 0.5, 0.75, 1.125, 1.5}, once[] = {1.0, 2.0, 3.0, 2.5, 2.0, 2.0},
               repeated[] = {2.0, 2.0, 3.0, 2.5, 2.0, 2.0}; /* the last row's from 1 s to the period's end */
  Boundary b = {.factor = {3, 2, ROW}};
  for (int k = 0; k < 6; k++) CHECK(BoundaryFactor(&b, time[k]) == once[k], "factor at %g s", time[k]);
  b.period = 1.25;
  for (int k = 0; k < 6; k++)
    CHECK(BoundaryFactor(&b, time[k]) == repeated[k], "factor at %g s that repeats itself", time[k]);
  BoundaryPhases phases = {.nlevels = 2, .level = {0.5}, .level_table = {{0}, {3, 2, ROW}}};
  for (int k = 0; k < 6; k++) {
    CHECK(BoundaryLevel(&phases, 0, time[k]) == 0.5, "a constant level at %g s", time[k]);
    CHECK(BoundaryLevel(&phases, 1, time[k]) == once[k], "level at %g s", time[k]);
  }
  phases.level_period = 1.25;
  for (int k = 0; k < 6; k++)
    CHECK(BoundaryLevel(&phases, 1, time[k]) == repeated[k], "level at %g s that repeats itself", time[k]);
  const Boundary open = {.kind = BOUNDARY_OPEN, .pressure = 2.0, .phases = phases};
  CHECK(BoundaryVaries(&open) && BoundaryFactor(&open, 0.3) == 1.0, "a constant pressure beside a level");
  b.factor.nrows = 0;
  for (int k = 0; k < 6; k++)
    CHECK(BoundaryFactor(&b, time[k]) == sin(2.0 * M_PI * time[k] / 1.25), "factor at %g s that swings",
          time[k]);
}

/* A table along the left side, with rows between the mesh's vertices. */
static PetscErrorCode Profile(void)
{
  static const double ROW[] = {0.13, -1.0, 0.27, 1.0, 0.71, 0.5}, Y[] = {0.0, 0.13, 0.2, 0.49, 0.9},
                      VALUE[] = {-1.0, -1.0, 0.0, 0.75, 0.5};
  const double exact = -0.13 + 0.44 * 0.75 + 0.29 * 0.5;
  double net, gross, v[2];
  Mesh *mesh;
  PetscFunctionBeginUser;
  PetscCall(SquareMesh(0.1, &mesh));
  Boundary boundary[4] = {{0}};
  Boundary *left = &boundary[MeshTagIndex(mesh, "left")];
  left->velocity[0] = 2.0;
  left->profile = (TimeTable){3, 2, ROW};
  PetscCall(BoundaryPrescribedFlux(mesh, boundary, 0.0, &net, &gross));
  CHECK(fabs(net + 2.0 * exact) < 1e-14, "%.17g m2/s of a table's %.17g", net, -2.0 * exact);
  for (int k = 0; k < 5; k++) {
    const double x[2] = {0.0, Y[k]};
    BoundaryVelocity(left, 0.0, x, v);
    CHECK(fabs(v[0] - 2.0 * VALUE[k]) < 1e-14 && v[1] == 0.0, "%g m/s at a height of %g m", v[0], Y[k]);
  }
  PetscCall(MeshDestroy(&mesh));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  Boundary b = {.kind = BOUNDARY_VELOCITY,
                .velocity = {2.0, -1.0},
                .parabolic = PETSC_TRUE,
                .lower = {0.0, 0.0},
                .upper = {0.0, 4.0},
                .rise = 0.5};
  const double time[5] = {0.0, 0.125, 0.25, 0.5, 7.0}, part[5] = {0.0, 0.5 - M_SQRT1_2 / 2.0, 0.5, 1.0, 1.0};
  const double x[2] = {0.0, 1.0}; /* three quarters of the largest */
  double v[2];
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  for (int k = 0; k < 5; k++) {
    BoundaryVelocity(&b, time[k], x, v);
    for (int c = 0; c < 2; c++)
      CHECK(fabs(v[c] - 0.75 * part[k] * b.velocity[c]) < 1e-15, "%g m/s at %g s", v[c], time[k]);
  }
  Factors();
  PetscCall(Profile());
  b.rise = 0.0;
  BoundaryVelocity(&b, 0.0, x, v);
  CHECK(v[0] == 1.5 && v[1] == -0.75, "%g, %g m/s at once", v[0], v[1]);
  return PetscFinalize();
}
