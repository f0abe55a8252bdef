/* Element-substeps per second on one core: bench_solid [size]. */
#include "build.h"

static PetscErrorCode Measure(double size, double damping)
{
  const BodySetup setup = BodyAtRest(MaterialOf(1000.0, 1.0e6, 0.3, damping));
  const SolidSetup options = {.courant = 0.5};
  Assembly a = {0};
  Solid s;
  double limit, h;
  AddRectangle(&a, 0.0, 0.0, 1.0, 1.0, 0.3, size, 1, &setup);
  PetscCall(SolidCreate(PETSC_COMM_SELF, &a, &options, &s));
  PetscCall(SolidLimit(s, &limit));
  const int substeps = 1 + (int)(2e7 / a.nelements);
  const double start = MPI_Wtime();
  PetscCall(SolidStart(s, 0.4999 * limit * substeps, NULL));
  while (SolidRemaining(s)) PetscCall(SolidSubstep(s, &h));
  const double seconds = MPI_Wtime() - start;
  printf("%8d elements, damping %.1f: %.3g element-substeps/s\n", a.nelements, damping,
         (double)a.nelements * (double)SolidGetStats(s)->total / seconds);
  PetscCall(AssemblyDestroy(&a));
  return SolidDestroy(&s);
}

int main(int argc, char **argv)
{
  const double sizes[] = {0.05, 0.02, 0.01, 0.003};
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  for (int k = 0; k < 4; k++)
    for (int damped = 0; damped < 2; damped++) PetscCall(Measure(sizes[k], 0.2 * damped));
  return PetscFinalize();
}
