// ranks: 1 2 3
/* Water and air on a mesh that adapts to their interface: still water stays still, no water is lost, the interface's
 * elements have the size asked for, and a column that collapses does the same on any ranks.
 * phase_adaptation print: says what it found. */
#include "fluid/adaptation.h"
#include "tests/fluid/tank.h"

/* Of the column's water after 12 steps: from this program with `print`; meshes of different ranks differ, and the centre
 * by 1e-5 m. */
#define CENTRE_X 0.15417
#define CENTRE_Y 0.28753

typedef struct {
  Tank tank;
  Adaptation adaptation;
  PetscBool new_mesh;
  int meshes;
} RunState;

static const AdaptationSetup SETUP = {.size_min = 0.03,
                                      .size_max = 0.3,
                                      .interface_size = 0.03,
                                      .velocity_error = 0.05,
                                      .growth = 1.5,
                                      .anisotropy = 5.0,
                                      .elements_max = 1e5,
                                      .every = 3};

/* As in main.c. */
static PetscErrorCode Step(RunState *m, double dt)
{
  Fluid f = m->tank.fluid, next;
  PetscBool due;
  Mesh *mesh;
  PetscFunctionBeginUser;
  if (m->new_mesh) PetscCall(FluidMakeSolenoidal(f));
  m->new_mesh = PETSC_FALSE;
  PetscCall(FluidMomentum(f, dt));
  PetscCall(FluidProject(f, dt));
  PetscCall(AdaptationDue(m->adaptation, f, &due));
  if (due) PetscCall(AdaptationMesh(m->adaptation, f, &mesh));
  PetscCall(FluidCorrect(f, dt, NULL));
  if (!due) PetscFunctionReturn(0);
  PetscCall(FluidCreateLike(f, mesh, &next));
  PetscCall(FluidTransfer(f, next));
  PetscCall(TankDestroy(&m->tank));
  m->tank = (Tank){mesh, next};
  m->new_mesh = PETSC_TRUE;
  m->meshes++;
  PetscFunctionReturn(0);
}

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
static PetscErrorCode March(const Region region[2], int steps, double dt, RunState *m, double *speed)
{
  PetscFunctionBeginUser;
  *m = (RunState){0};
  PetscCall(TankCreate(12, 3u, 1e-3, 2, region, &m->tank));
  PetscCall(AdaptationCreate(&SETUP, &m->adaptation));
  *speed = 0.0;
  for (int k = 0; k < steps; k++) {
    PetscCall(Step(m, dt));
    *speed = fmax(*speed, TankSpeed(&m->tank, 0));
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode Still(void)
{
  const Region region[2] = {{.shape = REGION_BOX, .phase = 1, .a = {-1, -1}, .b = {2, 2}},
                            {.shape = REGION_HALF_PLANE, .phase = 0, .a = {0.5, 0.473}, .b = {0.0, 1.0}}};
  double volume, centre[2], longest, speed;
  RunState m;
  PetscFunctionBeginUser;
  PetscCall(March(region, 12, 0.005, &m, &speed));
  PetscCall(Measure(&m.tank, &volume, centre, &longest));
  CHECK(m.meshes == 4, "%d meshes", m.meshes);
  CHECK(speed < 1e-6 * sqrt(9.81), "still water moves at %g m/s", speed);
  CHECK(fabs(volume - 0.473) < 1e-12, "%.15g m2 of 0.473", volume);
  CHECK(longest < 2.0 * SETUP.interface_size, "edges of %g m at the interface", longest);
  PetscCall(AdaptationDestroy(&m.adaptation));
  PetscCall(TankDestroy(&m.tank));
  PetscFunctionReturn(0);
}

static PetscErrorCode Column(int print)
{
  const Region region[2] = {{.shape = REGION_BOX, .phase = 1, .a = {-1, -1}, .b = {2, 2}},
                            {.shape = REGION_BOX, .phase = 0, .a = {-1, -1}, .b = {0.3, 0.6}}};
  double volume, centre[2], longest, speed;
  RunState m;
  PetscFunctionBeginUser;
  PetscCall(March(region, 12, 0.005, &m, &speed));
  PetscCall(Measure(&m.tank, &volume, centre, &longest));
  if (print)
    PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%d meshes, water %.15f m2 at (%.7f, %.7f), largest |u| %g m/s\n",
                          m.meshes, volume, centre[0], centre[1], speed));
  CHECK(fabs(volume - 0.18) < 1e-12, "%.15g m2 of 0.18", volume);
  CHECK(hypot(centre[0] - CENTRE_X, centre[1] - CENTRE_Y) < 1e-4, "the water's centre is (%g, %g)", centre[0],
        centre[1]);
  PetscCall(AdaptationDestroy(&m.adaptation));
  PetscCall(TankDestroy(&m.tank));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(Column(argc > 1));
  PetscCall(Still());
  return PetscFinalize();
}
