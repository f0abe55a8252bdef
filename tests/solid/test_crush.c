/* A disc without friction and damping that smashes on a wall, with joints that open by half an edge before they break:
 * what motion and strain lose, its cracks have taken.  Pieces that could pass through the faces of joints which are
 * not broken yet would gain many times the energy of the impact when contact presses them apart.  An edge that
 * activates under pressure and breaks takes P^2 h/12 E more, which is not `fracture`: a few per cent. */
#include "tests/solid/crack.h"

/* zone: E G_f/F_t^2 over the length of an edge. */
static PetscErrorCode Smash(double zone, double shear)
{
  const double modulus = 3e10, radius = 0.05, size = 0.01, tensile = modulus / 100.0;
  const SolidSetup options = {.courant = 0.4, .walls = PETSC_TRUE, .lower = {-1.0, 0.0}, .upper = {1.0, 1.0}};
  BodySetup setup =
      BodyAtRest(RockOf(tensile, shear * tensile, zone * tensile * tensile * size / modulus, 0.0));
  Model a = {0};
  FractureState f;
  Solid s;
  double first, last;
  setup.joints.all = 1;
  setup.velocity[1] = -0.05 * sqrt(modulus / 2500.0);
  AddDisc(&a, 0.0, 1.001 * radius, radius, size, &setup);
  PetscCall(SolidCreate(PETSC_COMM_WORLD, &a, &options, &s));
  PetscCall(TotalEnergy(s, 1, &first));
  PetscCall(Run(s, 3e-4, 1e-5));
  PetscCall(TotalEnergy(s, 1, &last));
  PetscCall(SolidFracture(s, &f));
  if (getenv("VERBOSE"))
    printf("zone %g, shear %g: energy %g of %g, and %g in %d broken and %d active joints: %.4f\n", zone,
           shear, last, first, f.energy, f.broken, f.active, (last + f.energy) / first);
  CHECK(f.broken > 10 && f.energy > 0.1 * first, "%d broken, %g J/m of %g", f.broken, f.energy, first);
  CHECK(last + f.energy < 1.01 * first && last + f.energy > 0.96 * first, "energy %g of %g, %g in cracks",
        last, first, f.energy);
  PetscCall(ModelDestroy(&a));
  return SolidDestroy(&s);
}

int main(int argc, char **argv)
{
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(Smash(20.0, 1.0));
  PetscCall(Smash(20.0, 3.0));
  PetscCall(Smash(4.0, 1.0));
  return PetscFinalize();
}
