// ranks: 1 2
/* What the fluid sees of a disc that moves (and spins) and swells: all of it while the step resolves the
 * swelling, the rigid motion alone when it does not. */
#include "build.h"

#define STEP 1e-3
#define SWELLING 0.5 /* 1/s */

/* Largest difference over the nodes between what is seen and rigid motion + swelling (x - centre), m/s. */
static PetscErrorCode Difference(double youngs_modulus, double swelling, double *largest)
{
  const SolidSetup options = {.courant = 0.8};
  BodySetup setup = BodyAtRest(MaterialOf(1000.0, youngs_modulus, 0.3, 0.0));
  Assembly a = {0};
  BodyState b;
  Solid s;
  SolidView view;
  const double *seen;
  double h;
  PetscFunctionBeginUser;
  setup.velocity[0] = 1.0;
  setup.velocity[1] = -2.0;
  setup.angular_velocity = swelling > 0.0 ? 0.0 : 3.0; /* a mean over a turning step has a part of its own */
  AddDisc(&a, 0.3, 0.2, 0.1, 0.02, &setup);
  PetscCall(SolidCreate(PETSC_COMM_WORLD, &a, &options, &s));
  SolidGetView(s, &view);
  double *v = (double *)view.v; /* the test's own solid: writable */
  for (int n = 0; n < view.nnodes; n++) {
    v[2 * n] += SWELLING * (view.x[2 * n] - 0.3);
    v[2 * n + 1] += SWELLING * (view.x[2 * n + 1] - 0.2);
  }
  PetscCall(SolidStart(s, STEP, NULL));
  while (SolidRemaining(s)) PetscCall(SolidSubstep(s, &h));
  PetscCall(SolidSeenVelocity(s, &seen));
  PetscCall(SolidBodies(s, 1, &b));
  *largest = 0.0;
  for (int n = 0; n < view.nnodes; n++) {
    const double r[2] = {view.x[2 * n] - b.x[0], view.x[2 * n + 1] - b.x[1]};
    const double u[2] = {b.v[0] - b.angular_velocity * r[1] + swelling * r[0],
                         b.v[1] + b.angular_velocity * r[0] + swelling * r[1]};
    for (int c = 0; c < 2; c++) *largest = fmax(*largest, fabs(seen[2 * n + c] - u[c]));
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, largest, 1, MPI_DOUBLE, MPI_MAX, PETSC_COMM_WORLD));
  PetscCall(SolidDestroy(&s));
  PetscCall(AssemblyDestroy(&a));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  double difference;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  /* slowest vibrations: about 2 sqrt(E / rho) / r = 200 and 0.2 times STEP's inverse */
  PetscCall(Difference(1e11, 0.0, &difference));
  CHECK(difference < 1e-12, "a stiff disc is seen to deform at %g m/s", difference);
  PetscCall(Difference(1e1, SWELLING, &difference));
  CHECK(difference < 1e-3 * SWELLING * 0.1, "a soft disc's swelling is seen wrong by %g m/s", difference);
  PetscCall(PetscFinalize());
  return 0;
}
