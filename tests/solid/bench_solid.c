/* Element-substeps per second on one core, of each law: bench_solid [size]. */
#include "tests/solid/build.h"
#include <time.h>

static PetscErrorCode Measure(double size, double damping, int plane_stress, ElementLawKind kind)
{
  BodySetup setup = BodyAtRest(MaterialOf(1000.0, 1.0e6, 0.3, damping));
  const SolidSetup options = {.courant = 0.5};
  Model a = {0};
  Solid s;
  double limit;
  setup.material.plane_stress = plane_stress;
  static const char *const NAMES[] = {"neo-Hookean", "corotated", "St. Venant"};
  setup.material.law = kind;
  AddRectangle(&a, 0.0, 0.0, 1.0, 1.0, 0.3, size, 1, &setup);
  PetscCall(SolidCreate(PETSC_COMM_SELF, &a, &options, &s));
  PetscCall(SolidLimit(s, &limit));
  const int substeps = 1 + (int)(2e7 / a.nelements);
  const clock_t start = clock(); /* of the processor: others may compute, too */
  PetscCall(RunStep(s, 0.4999 * limit * substeps, NULL));
  const double seconds = (double)(clock() - start) / CLOCKS_PER_SEC;
  printf("%8d elements, damping %.1f, plane %s, %s: %.3g element-substeps/s\n", a.nelements, damping,
         plane_stress ? "stress" : "strain", NAMES[kind],
         (double)a.nelements * (double)SolidGetStats(s)->total / seconds);
  PetscCall(ModelDestroy(&a));
  return SolidDestroy(&s);
}

int main(int argc, char **argv)
{
  const double sizes[] = {0.05, 0.02, 0.01, 0.003};
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  for (int k = 0; k < (argc > 1 ? 1 : 4); k++)
    for (int law = 0; law < 4; law++)
      for (int damped = 0; damped < 2; damped++)
        PetscCall(Measure(argc > 1 ? atof(argv[1]) : sizes[k], 0.2 * damped, law == 1,
                          law < 2 ? LAW_NEO_HOOKEAN : law - 1));
  return PetscFinalize();
}
