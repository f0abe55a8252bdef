// ranks: 1 2 3
/* Water and air on a mesh that adapts to their interface: still water stays still, no water is lost, the interface's
 * elements have the size asked for, and a column that collapses does the same on any ranks.
 * phase_adaptation print: says what it found. */
#include "tests/fluid/adapting_tank.h"

/* Of the column's water after 12 steps: from this program with `print`; meshes of different ranks differ, and the centre
 * by 1e-5 m. */
#define CENTRE_X 0.15417
#define CENTRE_Y 0.28753

/* The water's volume and centre, and the longest edge of a cut element. */
static PetscErrorCode Measure(const Tank *t, double *volume, double centre[2], double *longest)
{
  Phases phases = PhaseTransportPhases(FluidPhases(t->fluid));
  double sum[3] = {0};
  PetscFunctionBeginUser;
  *longest = 0.0;
  for (int e = 0; e < t->mesh->ne; e++) {
    Polygon part;
    PetscCall(PhasesGetPolygon(phases, e, 0, &part));
    for (int k = 1; k + 1 < part.n; k++) {
      const double area = 0.5 * GeometryTurn(part.x[0], part.x[k], part.x[k + 1]);
      sum[0] += area;
      for (int c = 0; c < 2; c++) sum[1 + c] += area / 3.0 * (part.x[0][c] + part.x[k][c] + part.x[k + 1][c]);
    }
    for (int i = 0; i < 3 && PhasesSingle(phases, e) < 0; i++) {
      const double *a = t->mesh->x + 2 * t->mesh->vertex[3 * e + i];
      const double *b = t->mesh->x + 2 * t->mesh->vertex[3 * e + (i + 1) % 3];
      *longest = fmax(*longest, hypot(a[0] - b[0], a[1] - b[1]));
    }
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sum, 3, MPI_DOUBLE, MPI_SUM, t->mesh->comm));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, longest, 1, MPI_DOUBLE, MPI_MAX, t->mesh->comm));
  *volume = sum[0];
  for (int c = 0; c < 2; c++) centre[c] = sum[1 + c] / sum[0];
  PetscFunctionReturn(0);
}

/* March on a mesh that starts coarse; *speed: the largest of all steps. */
static PetscErrorCode March(const Region region[2], int steps, double dt, AdaptingTank *m, double *speed)
{
  PetscFunctionBeginUser;
  *m = (AdaptingTank){0};
  PetscCall(TankCreate(12, 3u, 1e-3, 2, region, &m->tank));
  PetscCall(AdaptationCreate(&TANK_ADAPTATION, &m->adaptation));
  *speed = 0.0;
  for (int k = 0; k < steps; k++) {
    PetscCall(AdaptingTankStep(m, dt));
    *speed = fmax(*speed, TankSpeed(&m->tank, 0));
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode Still(void)
{
  const Region region[2] = {{.shape = REGION_BOX, .phase = 1, .a = {-1, -1}, .b = {2, 2}},
                            {.shape = REGION_HALF_PLANE, .phase = 0, .a = {0.5, 0.473}, .b = {0.0, 1.0}}};
  double volume, centre[2], longest, speed;
  AdaptingTank m;
  PetscFunctionBeginUser;
  PetscCall(March(region, 12, 0.005, &m, &speed));
  PetscCall(Measure(&m.tank, &volume, centre, &longest));
  CHECK(m.meshes == 4, "%d meshes", m.meshes);
  CHECK(speed < 1e-6 * sqrt(9.81), "still water moves at %g m/s", speed);
  CHECK(fabs(volume - 0.473) < 1e-12, "%.15g m2 of 0.473", volume);
  CHECK(longest < 2.0 * TANK_ADAPTATION.interface_size, "edges of %g m at the interface", longest);
  PetscCall(AdaptingTankDestroy(&m));
  PetscFunctionReturn(0);
}

static PetscErrorCode Column(int print)
{
  const Region region[2] = {{.shape = REGION_BOX, .phase = 1, .a = {-1, -1}, .b = {2, 2}},
                            {.shape = REGION_BOX, .phase = 0, .a = {-1, -1}, .b = {0.3, 0.6}}};
  double volume, centre[2], longest, speed;
  AdaptingTank m;
  PetscFunctionBeginUser;
  PetscCall(March(region, 12, 0.005, &m, &speed));
  PetscCall(Measure(&m.tank, &volume, centre, &longest));
  if (print)
    PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%d meshes, water %.15f m2 at (%.7f, %.7f), largest |u| %g m/s\n",
                          m.meshes, volume, centre[0], centre[1], speed));
  CHECK(fabs(volume - 0.18) < 1e-12, "%.15g m2 of 0.18", volume);
  CHECK(hypot(centre[0] - CENTRE_X, centre[1] - CENTRE_Y) < 1e-4, "the water's centre is (%g, %g)", centre[0],
        centre[1]);
  PetscCall(AdaptingTankDestroy(&m));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(Column(argc > 1));
  PetscCall(Still());
  return PetscFinalize();
}
