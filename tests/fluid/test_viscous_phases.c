// ranks: 1 2
/* Two layers of very viscous liquids in a channel, the upper one ten times as viscous: with steps in which viscosity crosses the channel they have
 * the velocity and the pressure of Poiseuille's flow within 9 and 6 % (fluid/pressure/viscous_share.h; without it they are 36 and 70 % off).  A step that is redone,
 * another fluid on the same mesh and a checkpoint go on as they were.  fluid_viscous_phases SIZE VISCOSITY: prints errors with elements of SIZE, 0.05 m, and this upper
 * viscosity, 10 Pa s. */
#include "tests/check.h"
#include "tests/fluid/exact.h"
#include "tests/fluid/through_checkpoint.h"

#define DT 0.1 /* s: viscosity crosses the lower layer and ten times the upper one */
#define STEPS 60
#define FEW 6
#define GRADIENT 1e-3 /* Pa/m: nothing moves by more than 0.01 m */
#define LENGTH 2.0
static double viscosity[2] = {1.0, 10.0}; /* below and above 1/2; of density 1 */

typedef enum { STRAIGHT, REDONE, TRANSFERRED, RESUMED, VARIANTS } Variant;

/* Between walls at 0 and 1 mu u'' = -GRADIENT, u and mu u' continuous at 1/2; c is the stress at 0. */
static void Profile(void *context, double t, const double x[2], double v[])
{
  const double a = viscosity[0], b = viscosity[1], y = x[1];
  const double c = GRADIENT * (0.375 / b + 0.125 / a) / (0.5 / a + 0.5 / b);
  v[0] = y < 0.5 ? (c - 0.5 * GRADIENT * y) * y / a : (0.5 * GRADIENT * (1.0 - y * y) - c * (1.0 - y)) / b;
  v[1] = 0.0;
}

static PetscErrorCode Create(Mesh *mesh, Fluid *fluid)
{
  const Region layer[2] = {{.shape = REGION_BOX, .phase = 1, .a = {-1, -1}, .b = {LENGTH + 1, 2}},
                           {.shape = REGION_HALF_PLANE, .phase = 0, .a = {0.5, 0.5}, .b = {0.0, 1.0}}};
  Boundary boundary[8] = {0};
  const FluidSetup setup = {.theta = 0.5,
                            .rho = 1.0,
                            .mu = viscosity[0],
                            .phases = {.n = 2, .rho = {1.0, 1.0}, .mu = {viscosity[0], viscosity[1]}},
                            .cfl = 1.0,
                            .dt_max = 1.0,
                            .boundary = boundary};
  PetscFunctionBeginUser;
  boundary[MeshTagIndex(mesh, "left")].function = Profile;
  boundary[MeshTagIndex(mesh, "right")].kind = BOUNDARY_OPEN;
  PetscCall(FluidCreate(mesh, &setup, fluid));
  PetscCall(FluidSetPhases(*fluid, 2, layer));
  PetscFunctionReturn(0);
}

/* What comes before step 3 of a variant. */
static PetscErrorCode Interrupt(Mesh *mesh, Variant variant, Fluid *fluid)
{
  Fluid next;
  PetscFunctionBeginUser;
  if (variant == REDONE) {
    PetscCall(FluidSaveState(*fluid));
    PetscCall(FluidMomentum(*fluid, DT));
    PetscCall(FluidProject(*fluid, DT));
    PetscCall(FluidRestoreState(*fluid));
  }
  if (variant != TRANSFERRED && variant != RESUMED) PetscFunctionReturn(0);
  PetscCall(Create(mesh, &next));
  if (variant == TRANSFERRED)
    PetscCall(FluidTransfer(*fluid, next));
  else
    PetscCall(ThroughCheckpoint(*fluid, mesh, next));
  PetscCall(FluidDestroy(fluid));
  *fluid = next;
  PetscFunctionReturn(0);
}

static PetscErrorCode Run(Mesh *mesh, int steps, Variant variant, Fluid *fluid)
{
  PetscFunctionBeginUser;
  PetscCall(Create(mesh, fluid));
  PetscCall(FluidSetInitial(*fluid, 0.0, NULL, NULL, NULL));
  for (int k = 0; k < steps; k++) {
    if (k == 3) PetscCall(Interrupt(mesh, variant, fluid));
    PetscCall(FluidStep(*fluid, DT));
  }
  PetscFunctionReturn(0);
}

/* The largest difference of the velocity from the profile's away from both ends, over its largest; of the pressure's fall from x = 1/2 to 3/2,
 * relative. */
static PetscErrorCode Errors(Fluid fluid, const Mesh *mesh, double *velocity, double *pressure)
{
  const double *u = FluidVelocity(fluid), *p = FluidPressure(fluid);
  const P2Space *space = FluidPressureSpace(fluid);
  double most[2] = {0.0, 0.0}, sum[2] = {0.0, 0.0}, n[2] = {0.0, 0.0};
  PetscFunctionBeginUser;
  for (int k = 0; k < 3 * mesh->ne; k++) {
    const double *x = ElementVertex(mesh, k / 3, k % 3), *now = u + 6 * (k / 3) + k % 3;
    double v[2];
    Profile(NULL, 0.0, x, v);
    if (x[0] > 0.3 && x[0] < 1.7) most[0] = fmax(most[0], hypot(now[0] - v[0], now[3]));
    most[1] = fmax(most[1], v[0]);
    for (int side = 0; side < 2; side++)
      if (fabs(x[0] - 0.5 - side) < 1e-9) {
        sum[side] += p[space->node[6 * (k / 3) + k % 3]];
        n[side] += 1.0;
      }
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, most, 2, MPI_DOUBLE, MPI_MAX, mesh->comm));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sum, 2, MPI_DOUBLE, MPI_SUM, mesh->comm));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, n, 2, MPI_DOUBLE, MPI_SUM, mesh->comm));
  *velocity = most[0] / most[1];
  *pressure = (sum[0] / n[0] - sum[1] / n[1]) / GRADIENT - 1.0;
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  Mesh *mesh;
  Fluid straight, other;
  double velocity, pressure;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(PetscOptionsSetValue(NULL, "-momentum_ksp_rtol", "1e-12"));
  if (argc > 2) viscosity[1] = atof(argv[2]);
  PetscCall(BoxMesh(LENGTH, argc > 1 ? atof(argv[1]) : 0.05, &mesh));
  PetscCall(Run(mesh, STEPS, STRAIGHT, &straight));
  PetscCall(Errors(straight, mesh, &velocity, &pressure));
  if (argc > 1)
    PetscCall(PetscPrintf(PETSC_COMM_WORLD, "velocity %.4f, pressure %+.4f\n", velocity, pressure));
  CHECK(argc > 1 || (velocity < 0.09 && fabs(pressure) < 0.06),
        "the velocity is off by %g, the pressure by %g of theirs", velocity, pressure);
  PetscCall(FluidDestroy(&straight));
  PetscCall(Run(mesh, FEW, STRAIGHT, &straight));
  for (Variant v = argc > 1 ? VARIANTS : REDONE; v < VARIANTS; v++) {
    PetscCall(Run(mesh, FEW, v, &other));
    const double difference = LargestVelocity(straight, other) / LargestVelocity(straight, NULL);
    CHECK(difference <= (v == TRANSFERRED ? 1e-4 : 1e-9), "variant %d differs by %g", (int)v, difference);
    PetscCall(FluidDestroy(&other));
  }
  PetscCall(FluidDestroy(&straight));
  PetscCall(MeshDestroy(&mesh));
  return PetscFinalize();
}
