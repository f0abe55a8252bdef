// ranks: 1 2
/* A damped disc falls on the tank's floor and comes to rest there: on it, not in it, carried with its weight.
 */
#include "tests/solid/build.h"

int main(int argc, char **argv)
{
  const double radius = 0.1, gravity = 9.81, young = 2.0e5;
  const SolidSetup options = {.gravity = {0.0, -gravity},
                              .courant = 0.8,
                              .walls = PETSC_TRUE,
                              .lower = {-0.3, 0.0},
                              .upper = {0.3, 1.0}};
  BodySetup setup = BodyAtRest(MaterialOf(1000.0, young, 0.3, 0.5));
  Model a = {0};
  BodyState b;
  Solid s;
  double lowest = 1.0;
  const double *force;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  AddDisc(&a, 0.1, 0.15, radius, 0.02, &setup);
  PetscCall(SolidCreate(PETSC_COMM_WORLD, &a, &options, &s));
  PetscCall(Run(s, 0.1, 0.01)); /* free fall of 0.05 m ends at 0.101 s */
  PetscCall(SolidBodies(s, 1, &b));
  CHECK(fabs(b.v[1] + gravity * 0.1) < 1e-9, "falls with %g", b.v[1]);
  PetscCall(Run(s, 6.0, 0.01));
  PetscCall(SolidBodies(s, 1, &b));
  SolidView v = ViewOf(s, NULL, NULL);
  PetscCall(SolidForces(s, &force));
  double sum[2] = {0.0, 0.0};
  for (int n = 0; n < v.nnodes; n++) {
    lowest = fmin(lowest, v.x[2 * n + 1]);
    for (int c = 0; c < 2; c++) sum[c] += force[2 * n + c];
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &lowest, 1, MPI_DOUBLE, MPI_MIN, PETSC_COMM_WORLD));
  const double weight = b.mass * gravity;
  if (getenv("VERBOSE"))
    printf(
        "centre (%.6f, %.6f), v (%.2e, %.2e), lowest %.2e, floor carries %.6f of the weight, %lld substeps\n",
        b.x[0], b.x[1], b.v[0], b.v[1], lowest, sum[1] / weight, SolidGetStats(s)->total);
  CHECK(fabs(b.mass / (1000.0 * M_PI * radius * radius) - 1.0) < 1e-12, "mass %.15g", b.mass);
  CHECK(hypot(b.v[0], b.v[1]) < 1e-4, "still moves with (%g, %g)", b.v[0], b.v[1]);
  /* flattened by its weight: by Hertz's order W/E, and less than a tenth of an element into the floor */
  CHECK(b.x[1] < radius && b.x[1] > radius - 10.0 * weight / young, "rests at height %g", b.x[1]);
  CHECK(lowest < 0.0 && lowest > -0.002, "lowest point %g", lowest);
  PetscMPIInt size;
  PetscCallMPI(MPI_Comm_size(PETSC_COMM_WORLD, &size));
  if (size == 1)
    CHECK(fabs(sum[1] / weight - 1.0) < 1e-3, "the floor carries %g of the weight", sum[1] / weight);
  PetscCall(ModelDestroy(&a));
  PetscCall(SolidDestroy(&s));
  return PetscFinalize();
}
