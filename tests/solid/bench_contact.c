/* Cost of contact against size: walls of touching blocks of 8 elements, 1e3 to 1e5 elements in all. Processor
 * time in microseconds per element of a search, and of a substep with all its contact forces. */
#include "solid/solid_impl.h"
#include "tests/solid/build.h"
#include <time.h>

static double Processor(void)
{
  return (double)clock() / CLOCKS_PER_SEC;
}

static PetscErrorCode Measure(int side)
{
  BodySetup setup = BodyAtRest(MaterialOf(1000.0, 1.0e6, 0.3, 0.2));
  const SolidSetup options = {.gravity = {0.0, -9.81},
                              .courant = 0.8,
                              .walls = PETSC_TRUE,
                              .lower = {0.0, 0.0},
                              .upper = {0.1 * side, 0.1 * side + 1.0}};
  const int repeats = 1 + 200000 / (8 * side * side);
  Model a = {0};
  Solid s;
  double limit, h;
  setup.material.friction = 0.3;
  setup.material.contact_damping = 0.2;
  (void)snprintf(setup.material.name, sizeof setup.material.name, "stone");
  for (int k = 0; k < side * side; k++)
    AddRectangle(&a, (k % side + 0.5) * 0.1, (k / side + 0.5) * 0.1, 0.1, 0.1, 0.0, 0.05, 0, &setup);
  PetscCall(SolidCreate(PETSC_COMM_SELF, &a, &options, &s));
  PetscCall(SolidLimit(s, &limit));
  PetscCall(Run(s, 20.0 * limit, 20.0 * limit)); /* some overlap */
  double start = Processor();
  for (int k = 0; k < repeats; k++) PetscCall(ContactSearch(s->contact, s, NULL));
  const double search = (Processor() - start) / repeats;
  PetscCall(SolidStart(s, 10.0 * repeats * limit, NULL));
  const long long before = SolidGetStats(s)->total;
  start = Processor();
  while (SolidRemaining(s)) PetscCall(SolidSubstep(s, &h));
  const double n = (double)a.nelements,
               substep = (Processor() - start) / (double)(SolidGetStats(s)->total - before);
  printf("%7d elements, %6d bodies: search %.3f, substep %.4f microseconds per element\n", a.nelements,
         a.nbodies, 1e6 * search / n, 1e6 * substep / n);
  PetscCall(ModelDestroy(&a));
  return SolidDestroy(&s);
}

int main(int argc, char **argv)
{
  const int side[] = {11, 20, 35, 63, 112};
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  for (int k = 0; k < 5; k++) PetscCall(Measure(side[k]));
  return PetscFinalize();
}
