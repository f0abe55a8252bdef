// ranks: 1 2 3
/* Strengths that scatter have the mean and the spread of Weibull's distribution, the same factor in tension and shear, and are those of the edge whatever the
 * ranks; another seed is another sample. */
#include "solid/cracks/joints_impl.h"
#include "tests/solid/build.h"

#define MODULUS 8.0
#define STRENGTH 2e6

enum { COUNT, MEAN, SQUARE, CUBE, BY_NUMBER, WEAKEST, NSUMS };

/* Sums over all joints of a plate on comm, of their strengths over the mean. */
static PetscErrorCode Sums(MPI_Comm comm, int seed, double sum[NSUMS])
{
  Model a = {0};
  BodySetup body = BodyAtRest(MaterialOf(2000.0, 1e9, 0.2, 0.0));
  const SolidSetup setup = {.courant = 0.8};
  Solid s;
  Material *m = &body.material;
  m->strength[0] = STRENGTH;
  m->strength[1] = 3.0 * STRENGTH;
  m->fracture_energy[0] = m->fracture_energy[1] = 100.0;
  m->weibull_modulus = MODULUS;
  m->weibull_seed = seed;
  body.joints.all = 1;
  AddRectangle(&a, 0.0, 0.0, 1.0, 1.0, 0.0, 0.02, 0, &body);
  PetscCall(SolidCreate(comm, &a, &setup, &s));
  PetscCall(ModelDestroy(&a));
  PetscCall(PetscArrayzero(sum, NSUMS));
  sum[WEAKEST] = HUGE_VAL;
  for (int k = 0; k < s->joints->n; k++) {
    const Joint *joint = &s->joints->joint[k];
    const double f = joint->law.strength[0] / STRENGTH;
    if (!joint->mine) continue;
    CHECK(fabs(joint->law.strength[1] / joint->law.strength[0] - 3.0) < 1e-12, "shear %g of tension %g",
          joint->law.strength[1], joint->law.strength[0]);
    sum[COUNT] += 1.0;
    sum[MEAN] += f;
    sum[SQUARE] += f * f;
    sum[CUBE] += f * f * f;
    sum[BY_NUMBER] += joint->number * f;
    sum[WEAKEST] = fmin(sum[WEAKEST], f);
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sum, WEAKEST, MPI_DOUBLE, MPI_SUM, comm));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sum + WEAKEST, 1, MPI_DOUBLE, MPI_MIN, comm));
  PetscCall(SolidDestroy(&s));
  return 0;
}

int main(int argc, char **argv)
{
  double sum[NSUMS], serial[NSUMS], other[NSUMS];
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(Sums(PETSC_COMM_WORLD, 0, sum));
  PetscCall(Sums(PETSC_COMM_SELF, 0, serial));
  PetscCall(Sums(PETSC_COMM_SELF, 1, other));
  const double n = sum[COUNT], gamma = tgamma(1.0 + 1.0 / MODULUS);
  for (int k = 0; k < 3; k++) { /* moments, each within four times its own deviation */
    const double power = k + 1.0, exact = tgamma(1.0 + power / MODULUS) / pow(gamma, power);
    const double spread = tgamma(1.0 + 2.0 * power / MODULUS) / pow(gamma, 2.0 * power) - exact * exact;
    CHECK(fabs(sum[MEAN + k] / n - exact) < 4.0 * sqrt(spread / n), "moment %d: %g, expected %g of %g joints",
          k + 1, sum[MEAN + k] / n, exact, n);
  }
  const double weakest = pow(1.0 / n, 1.0 / MODULUS) / gamma;
  CHECK(sum[WEAKEST] > 0.5 * weakest && sum[WEAKEST] < 1.5 * weakest, "the weakest has %g, expected some %g",
        sum[WEAKEST], weakest);
  CHECK(fabs(sum[BY_NUMBER] / serial[BY_NUMBER] - 1.0) < 1e-12 && sum[COUNT] == serial[COUNT],
        "sums by number: %.17g, on one rank %.17g", sum[BY_NUMBER], serial[BY_NUMBER]);
  CHECK(fabs(other[BY_NUMBER] / serial[BY_NUMBER] - 1.0) > 1e-6, "another seed has the same strengths");
  return PetscFinalize();
}
