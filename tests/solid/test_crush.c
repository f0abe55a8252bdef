/* A disc without friction and damping that smashes on a wall, with joints that open by half an edge before they break:
 * what motion and strain lose, its cracks have taken.  Pieces that could pass through the faces of joints which are
 * not broken yet would gain many times the energy of the impact when contact presses them apart.  An edge that
 * activates under pressure and breaks takes P^2 h/12 E more, which is not `fracture`: a few per cent.  Damped contact
 * of what has broken does not ask for many more substeps than contact without damping. */
#include "tests/solid/crack.h"

/* zone: E G_f/F_t^2 over the length of an edge; *substep: the longest stable one in the end. */
static PetscErrorCode Smash(double zone, double shear, double damping, double *substep)
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
  setup.material.contact_damping = damping;
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
  CHECK(last + f.energy < 1.01 * first && (damping > 0.0 || last + f.energy > 0.96 * first),
        "energy %g of %g, %g in cracks", last, first, f.energy);
  PetscCall(SolidLimit(s, substep));
  PetscCall(ModelDestroy(&a));
  return SolidDestroy(&s);
}

/* What the part of a body above y = 0.019 m at rest does to what holds its top: shear and pressure, N/m. */
static PetscErrorCode OnTop(Solid s, double *shear, double *pressure)
{
  const SolidView v = ViewOf(s, NULL, NULL);
  const double *force;
  *shear = *pressure = 0.0;
  PetscCall(SolidForces(s, &force));
  for (int n = 0; n < v.nnodes; n++) {
    if (v.rest[2 * n + 1] < 0.019) continue;
    *shear -= force[2 * n];
    *pressure += force[2 * n + 1];
  }
  return 0;
}

/* Two halves of a block, pressed together and then drawn along each other: Mohr and Coulomb's strength at the peak, and
 * their friction before their joints break and after, without a jump. */
static PetscErrorCode Sheared(void)
{
  static const double ROW[] = {0.0,    0.0, -0.01, 6e-4,   0.0,  -0.01, 8e-4, 0.0,  0.0,
                               1.0e-3, 0.0, 0.0,   1.5e-3, 0.06, 0.0,   1.0,  0.06, 0.0};
  static const char *const BOTTOM[] = {"bottom"};
  static const double BOX[1][4] = {{-1.0, -0.0101, 1.0, 0.0101}};
  const BoundaryMotion top = {"top", {.prescribed = {1, 1}, .nrows = 6, .row = ROW}};
  const SolidSetup options = {.courant = 0.8};
  const double cohesion = 2e6, friction = 0.5, width = 0.2;
  Material m = RockOf(cohesion, cohesion, 20.0, 0.3);
  m.friction = m.internal_friction = friction;
  m.contact_damping = 0.2;
  m.fracture_energy[1] = 100.0;
  BodySetup setup = BodyAtRest(m);
  Model a = {0};
  FractureState f;
  Solid s;
  double shear, pressure, peak = 0.0, held = 0.0, apart = 0.0;
  setup.joints = (JointSetup){.nboxes = 1, .box = BOX};
  setup.nfixed = 1;
  setup.fixed_name = BOTTOM;
  setup.nprescribed = 1;
  setup.prescribed = &top;
  AddRectangle(&a, 0.0, 0.0, width, 0.04, 0.0, 0.01, 0, &setup);
  PetscCall(SolidCreate(PETSC_COMM_WORLD, &a, &options, &s));
  for (int k = 0; k < 50; k++) {
    PetscCall(Run(s, 1e-4, 1e-4));
    PetscCall(OnTop(s, &shear, &pressure));
    PetscCall(SolidFracture(s, &f));
    if (getenv("VERBOSE"))
      printf("%g s: %g, %g Pa, %d broken\n", 1e-4 * (k + 1), shear / width, pressure / width, f.broken);
    peak = fmax(peak, (shear - friction * pressure) / (cohesion * width));
    if (f.broken == 0) held = shear / pressure;
    apart = shear / pressure;
  }
  CHECK(peak > 0.9 && peak < 1.02, "the joints bear %g of their cohesion", peak);
  CHECK(held > friction && held < 1.1 * friction && fabs(apart / friction - 1.0) < 0.01,
        "friction %g before they break, %g after", held, apart);
  CHECK(f.broken == 20 && fabs(f.debonded / (100.0 * width) - 1.0) < 0.01, "%d broken, %g J/m", f.broken,
        f.debonded);
  PetscCall(ModelDestroy(&a));
  return SolidDestroy(&s);
}

int main(int argc, char **argv)
{
  double undamped, damped;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(Smash(20.0, 1.0, 0.0, &damped));
  PetscCall(Smash(20.0, 3.0, 0.0, &damped));
  PetscCall(Smash(4.0, 1.0, 0.0, &undamped));
  PetscCall(Smash(4.0, 1.0, 0.3, &damped));
  if (getenv("VERBOSE"))
    printf("substeps of up to %g s in the end, %g s with damped contact\n", undamped, damped);
  /* d = 3/2 w of bodies and as much of walls, w^2 of both: 0.4 of the substep of w alone, and the elements' w counts too */
  CHECK(damped > 0.4 * undamped, "substeps of %g s with damped contact, %g s without", damped, undamped);
  PetscCall(Sheared());
  return PetscFinalize();
}
