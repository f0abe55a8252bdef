// ranks: 1 2
/* A step among phases that is redone begins as it did at first, also where lines of the interface lie beside a solid: a solid that is elsewhere in the first attempt
 * leaves nothing behind. */
#include "tests/fluid/tank.h"

#define DT 0.01 /* s */

/* A solid fills the part alpha of the elements whose centres are within 0.15 of (x, 0.5), and nothing of others. */
static PetscErrorCode SetSolid(Tank *t, double x, double alpha)
{
  CoracleCoupling *entry;
  int n = 0;
  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(t->mesh->ne, &entry));
  for (int e = 0; e < t->mesh->ne; e++) {
    double centre[2] = {-x, -0.5};
    for (int k = 0; k < 6; k++) centre[k % 2] += ElementVertex(t->mesh, e, k / 2)[k % 2] / 3.0;
    if (hypot(centre[0], centre[1]) > 0.15) continue;
    entry[n].element = e;
    entry[n++].alpha = alpha;
  }
  PetscCall(FluidSetCoupling(t->fluid, n, entry));
  PetscCall(PetscFree(entry));
  PetscFunctionReturn(0);
}

/* Water that sloshes, its surface tilted, around a solid that fills the part 0.4. */
static PetscErrorCode Begin(Tank *t)
{
  const Region layer[2] = {{.shape = REGION_BOX, .phase = 1, .a = {-1, -1}, .b = {2, 2}},
                           {.shape = REGION_HALF_PLANE, .phase = 0, .a = {0.5, 0.5}, .b = {0.1, 1.0}}};
  PetscFunctionBeginUser;
  PetscCall(TankCreate(12, 3, 1.0, 2, layer, t));
  for (int k = 0; k < 3; k++) {
    PetscCall(SetSolid(t, 0.4, 0.4));
    PetscCall(FluidStep(t->fluid, DT));
  }
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  double most[2] = {0.0, 0.0}; /* difference, velocity, m/s */
  Tank redone, straight;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(PetscOptionsSetValue(NULL, "-pressure_varying_ksp_rtol", "1e-13"));
  PetscCall(PetscOptionsSetValue(NULL, "-momentum_ksp_rtol", "1e-13"));
  PetscCall(Begin(&redone));
  PetscCall(Begin(&straight));
  PetscCall(FluidSaveState(redone.fluid));
  PetscCall(SetSolid(&redone, 0.7, 0.9));
  PetscCall(FluidMomentum(redone.fluid, DT));
  PetscCall(FluidProject(redone.fluid, DT));
  PetscCall(FluidRestoreState(redone.fluid));
  PetscCall(SetSolid(&redone, 0.4, 0.4));
  PetscCall(SetSolid(&straight, 0.4, 0.4));
  PetscCall(FluidStep(redone.fluid, DT));
  PetscCall(FluidStep(straight.fluid, DT));
  const double *u = FluidVelocity(redone.fluid), *v = FluidVelocity(straight.fluid);
  for (int k = 0; k < 6 * redone.mesh->ne; k++) {
    most[0] = fmax(most[0], fabs(u[k] - v[k]));
    most[1] = fmax(most[1], fabs(v[k]));
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, most, 2, MPI_DOUBLE, MPI_MAX, PETSC_COMM_WORLD));
  CHECK(most[1] > 0.01 && most[0] < 1e-9 * most[1], "a redone step differs by %g m/s of %g", most[0],
        most[1]);
  PetscCall(TankDestroy(&redone));
  PetscCall(TankDestroy(&straight));
  return PetscFinalize();
}
