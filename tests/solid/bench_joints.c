/* Joint-substeps per second on one core, intact and active: bench_joints [size].  The active ones are the
 * joints of a body all of whose edges carry more than their strength. */
#include "tests/solid/crack.h"

static PetscErrorCode Measure(double size, double stretch)
{
  BodySetup setup = BodyAtRest(RockOf(3e6, 3e6, 1e4, 0.0));
  const SolidSetup options = {.courant = 0.3};
  Model a = {0};
  FractureState f;
  Solid s;
  double limit;
  setup.joints.all = 1;
  setup.stretch[0] = setup.stretch[1] = stretch;
  AddRectangle(&a, 0.0, 0.0, 1.0, 1.0, 0.3, size, 0, &setup);
  PetscCall(SolidCreate(PETSC_COMM_SELF, &a, &options, &s));
  PetscCall(SolidLimit(s, &limit));
  PetscCall(RunStep(s, 0.1 * limit, NULL)); /* the joints activate */
  PetscCall(SolidLimit(s, &limit));
  const SolidStats before = *SolidGetStats(s);
  const int substeps = 1 + (int)(2e6 / a.nelements);
  const double start = MPI_Wtime();
  PetscCall(RunStep(s, 0.3 * limit * substeps, NULL));
  const double seconds = MPI_Wtime() - start;
  const SolidStats *stats = SolidGetStats(s);
  const double joints = 0.5 * (3.0 * a.nelements - a.nfacets), total = (double)(stats->total - before.total);
  PetscCall(SolidFracture(s, &f));
  printf(
      "%8d elements, %8.0f joints, %8d active, %3d searches: %.3g joint-substeps/s in the joints alone, %.3g "
      "element-substeps/s in all\n",
      a.nelements, joints, f.active, stats->searches - before.searches,
      joints * total / (stats->seconds[4] - before.seconds[4]), a.nelements * total / seconds);
  PetscCall(ModelDestroy(&a));
  return SolidDestroy(&s);
}

int main(int argc, char **argv)
{
  const double sizes[] = {0.05, 0.02, 0.01}, given = argc > 1 ? atof(argv[1]) : 0.0;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  for (int k = 0; k < (given > 0.0 ? 1 : 3); k++)
    for (int active = 0; active < 2; active++)
      PetscCall(Measure(given > 0.0 ? given : sizes[k], 1.0 + 4e-4 * active));
  return PetscFinalize();
}
