/* What lies stays: a block on the floor and a stack of three come to rest and keep their potential energy; a
 * small heap of blocks that fall on each other comes to rest (hundreds: test_rest 300).  A corner that strikes is damped, and a
 * body of which a part is held, on what is held or prescribed too.  How a
 * disc rebounds follows from its material's damping ratio, on any mesh. */
#include "tests/solid/build.h"

static const double G = 9.81;

static Material Stone(double youngs_modulus)
{
  Material m = MaterialOf(2000.0, youngs_modulus, 0.25, 0.3);
  m.friction = 0.5;
  m.contact_damping = 0.5;
  return m;
}

/* Sum m g y of all bodies, J/m, and the largest speed of a mass centre. */
static PetscErrorCode Potential(Solid s, int n, double *energy, double *speed)
{
  BodyState *b = malloc((size_t)n * sizeof *b);
  PetscCall(SolidBodies(s, n, b));
  *energy = *speed = 0.0;
  for (int k = 0; k < n; k++) {
    *energy += b[k].mass * G * b[k].x[1];
    *speed = fmax(*speed, hypot(b[k].v[0], b[k].v[1]));
  }
  free(b);
  return 0;
}

/* Stiff, so that the column's own bending dies out too. */
static PetscErrorCode Stack(int n)
{
  const SolidSetup options = {
      .gravity = {0.0, -G}, .courant = 0.8, .walls = PETSC_TRUE, .lower = {-1.0, 0.0}, .upper = {1.0, 2.0}};
  const BodySetup setup = BodyAtRest(Stone(2.0e7));
  Model a = {0};
  Solid s;
  double before, now, speed, weight = 0.0;
  for (int k = 0; k < n; k++) AddRectangle(&a, 0.003 * k, 0.05 + 0.1 * k, 0.2, 0.1, 0.0, 0.05, 1, &setup);
  PetscCall(SolidCreate(PETSC_COMM_WORLD, &a, &options, &s));
  PetscCall(Run(s, 2.0, 0.02));
  PetscCall(Potential(s, n, &before, &speed));
  for (int k = 0; k < 10; k++) {
    PetscCall(Run(s, 0.1, 0.02));
    PetscCall(Potential(s, n, &now, &speed));
    weight = n * 2000.0 * 0.02 * G;
    CHECK(fabs(now - before) < 1e-8 * weight, "%d blocks: potential energy rises by %g J/m at rest", n,
          now - before);
    CHECK(speed < 1e-7, "%d blocks: speed %g at rest", n, speed);
  }
  if (getenv("VERBOSE"))
    printf("%d blocks: speed %.1e, height %+.1e in a second\n", n, speed, (now - before) / weight);
  PetscCall(ModelDestroy(&a));
  return SolidDestroy(&s);
}

/* Blocks in rows, each a little turned and shifted, fall into a box.  After `time` none is faster than 1 mm/s
 * and none has left, and the kinetic energy has only a trace left. */
static PetscErrorCode Heap(int n, double time)
{
  const int columns = n > 100 ? 10 : 4, rows = (n + columns - 1) / columns;
  const double size = 0.05, pitch = 0.075, width = columns * pitch * 1.25;
  const SolidSetup options = {.gravity = {0.0, -G},
                              .courant = 0.8,
                              .walls = PETSC_TRUE,
                              .lower = {0.0, 0.0},
                              .upper = {width, (rows + 2) * pitch + 0.2}};
  const BodySetup setup = BodyAtRest(Stone(2.0e6));
  Model a = {0};
  Solid s;
  double before, after, speed;
  for (int k = 0; k < n; k++) {
    const int row = k / columns, column = k % columns;
    AddRectangle(&a, (column + 0.7 + 0.5 * (row % 2)) * pitch, (row + 0.6) * pitch, size, size,
                 0.4 * sin(12.9898 * k), 0.5 * size, 0, &setup);
  }
  PetscCall(SolidCreate(PETSC_COMM_WORLD, &a, &options, &s));
  const double start = MPI_Wtime();
  PetscCall(Potential(s, n, &before, &speed));
  PetscCall(Run(s, time, 0.01));
  PetscCall(Potential(s, n, &after, &speed));
  if (getenv("VERBOSE"))
    printf(
        "%d blocks: fastest %.1e m/s after %g s, potential energy %.4g -> %.4g J/m, %lld substeps, %.1f s\n",
        n, speed, time, before, after, SolidGetStats(s)->total, MPI_Wtime() - start);
  CHECK(speed < 1e-3, "a block of the heap still moves with %g m/s", speed);
  CHECK(after < 0.9 * before, "potential energy %g of %g: nothing has fallen", after, before);
  const double full = n * size * size / width; /* height of the heap without holes */
  CHECK(after > 0.5 * full * n * 2000.0 * size * size * G, "the heap lies too low: %g J/m", after);
  PetscCall(ModelDestroy(&a));
  return SolidDestroy(&s);
}

/* The one body of a, which comes to a wall with `speed`, m/s: what part of it it has after time, s.  Destroys a. */
static PetscErrorCode Strike(Model *a, double speed, double time, double *restitution)
{
  const SolidSetup options = {.courant = 0.8, .walls = PETSC_TRUE, .lower = {-1.0, 0.0}, .upper = {1.0, 2.0}};
  Solid s;
  double energy;
  PetscCall(SolidCreate(PETSC_COMM_WORLD, a, &options, &s));
  PetscCall(Run(s, time, 0.001));
  PetscCall(Potential(s, 1, &energy, restitution));
  *restitution /= speed;
  PetscCall(ModelDestroy(a));
  return SolidDestroy(&s);
}

/* A block of 45 degrees strikes a wall with a corner: what part of its speed it leaves with. */
static PetscErrorCode Corner(double damping, double *restitution)
{
  const double speed = 0.2;
  Material stone = Stone(1.0e8);
  Model a = {0};
  stone.damping = 0.0;
  stone.friction = 0.0;
  stone.contact_damping = damping;
  BodySetup setup = BodyAtRest(stone);
  setup.velocity[1] = -speed;
  AddRectangle(&a, 0.0, 0.0568, 0.08, 0.08, 0.25 * M_PI, 0.02, 0, &setup);
  return Strike(&a, speed, 0.05, restitution);
}

/* The damping is that of a body, not of the edges beside its corner (which left 0.96 and 0.88 of the speed). */
static PetscErrorCode Corners(void)
{
  double elastic, damped, most;
  PetscCall(Corner(0.0, &elastic));
  PetscCall(Corner(0.3, &damped));
  PetscCall(Corner(1.0, &most));
  if (getenv("VERBOSE"))
    printf("a corner leaves with %.3f, %.3f, %.3f of its speed\n", elastic, damped, most);
  CHECK(fabs(elastic - 1.0) < 0.02 && damped > 0.5 && damped < 0.8 && most < 0.6,
        "a corner leaves with %g, %g, %g of its speed, for damping 0, 0.3, 1", elastic, damped, most);
  return 0;
}

/* A block strikes a plate that is held so: its velocity after. */
static PetscErrorCode OnPlate(int fixed, double release, double *rebound)
{
  const SolidSetup options = {.courant = 0.8};
  const double still[3] = {0.0, 0.0, 0.0};
  const BoundaryMotion motion = {NULL, {.prescribed = {1, 1}, .nrows = 1, .row = still, .release = release}};
  Material rigid = {.density = 2000.0, .penalty = 1e6, .contact_damping = 0.3, .rigid = 1};
  BodySetup block = BodyAtRest(rigid);
  BodyState state;
  Model a = {0};
  Solid s;
  rigid.density = 1.0;
  BodySetup plate = BodyAtRest(rigid);
  block.velocity[1] = -1.0;
  plate.fixed = fixed;
  plate.nprescribed = release >= 0.0;
  plate.prescribed = &motion;
  AddRectangle(&a, 0.0, 0.11, 0.2, 0.2, 0.0, 0.05, 0, &block);
  AddRectangle(&a, 0.0, -0.05, 0.4, 0.1, 0.0, 0.05, 0, &plate);
  PetscCall(SolidCreate(PETSC_COMM_WORLD, &a, &options, &s));
  PetscCall(Run(s, 0.05, 0.001));
  PetscCall(SolidBodies(s, 1, &state));
  *rebound = state.v[1];
  PetscCall(ModelDestroy(&a));
  return SolidDestroy(&s);
}

/* A prescribed plate is as heavy as a fixed one, till it is released. */
static PetscErrorCode Plates(void)
{
  double fixed, prescribed, released, loose;
  PetscCall(OnPlate(1, -1.0, &fixed));
  PetscCall(OnPlate(0, 0.0, &prescribed));
  PetscCall(OnPlate(0, 0.005, &released));
  PetscCall(OnPlate(0, -1.0, &loose));
  if (getenv("VERBOSE"))
    printf("a block leaves a fixed plate with %.4f m/s, a prescribed one %.4f, has %.4f and %.4f after a "
           "loose one\n",
           fixed, prescribed, released, loose);
  CHECK(fixed > 0.3 && fixed < 0.5 && fabs(prescribed - fixed) < 1e-9,
        "a block leaves a fixed plate with %g m/s, a prescribed one with %g m/s", fixed, prescribed);
  CHECK(loose < -0.99 && fabs(released - loose) < 1e-9,
        "after a plate that is let go %g m/s, a loose one %g m/s", released, loose);
  return 0;
}

/* A beam that is held at its left strikes another one, held at its right, or a wall: the energy that is left. */
static PetscErrorCode Clamped(int wall, double damping, double *energy)
{
  static const char *const END[2] = {"left", "right"};
  const SolidSetup options = {
      .courant = 0.8, .walls = (PetscBool)wall, .lower = {-1.0, -0.07}, .upper = {1.0, 1.0}};
  Material soft = MaterialOf(2000.0, 1.0e8, 0.25, 0.0);
  Model a = {0};
  Solid s;
  soft.penalty = 1e7;
  soft.contact_damping = damping;
  BodySetup beam = BodyAtRest(soft);
  beam.nfixed = 1;
  for (int k = 0; k < (wall ? 1 : 2); k++) {
    beam.fixed_name = &END[k];
    beam.velocity[1] = k ? 0.0 : -2.0;
    AddRectangle(&a, 0.2 * k, -0.12 * k, 1.0, 0.1, 0.0, 0.05, 0, &beam);
  }
  PetscCall(SolidCreate(PETSC_COMM_WORLD, &a, &options, &s));
  PetscCall(Run(s, 0.1, 0.001));
  PetscCall(TotalEnergy(s, wall ? 1 : 2, energy));
  PetscCall(ModelDestroy(&a));
  return SolidDestroy(&s);
}

static PetscErrorCode Clamps(void)
{
  double elastic, damped;
  for (int wall = 0; wall < 2; wall++) {
    PetscCall(Clamped(wall, 0.0, &elastic));
    PetscCall(Clamped(wall, 0.5, &damped));
    if (getenv("VERBOSE"))
      printf("clamped beams, wall %d: %.4g J/m, damped %.4g J/m\n", wall, elastic, damped);
    CHECK(damped < 0.98 * elastic, "a clamped beam on a %s has %g J/m with damping, %g J/m without",
          wall ? "wall" : "beam", damped, elastic);
  }
  return 0;
}

/* A disc strikes a wall without gravity: what part of its speed it leaves with.  Its own deformation carries the rebound, half a
 * period of 45 Hz long. */
static PetscErrorCode Rebound(double size, double ratio, double *restitution)
{
  const double radius = 0.1, speed = 1.4;
  Material stone = MaterialOf(2600.0, 1.0e7, 0.2, 0.0);
  Model a = {0};
  stone.damping_ratio = ratio;
  stone.damping_frequency = 45.0;
  BodySetup setup = BodyAtRest(stone);
  setup.velocity[1] = -speed;
  AddDisc(&a, 0.0, 1.02 * radius, radius, size, &setup);
  return Strike(&a, speed, 0.03, restitution);
}

/* As an oscillator that leaves after half a period: exp(-pi xi), 0.73, give or take how far a strike on a disc is from one. */
static PetscErrorCode Rebounds(void)
{
  double elastic, coarse, fine;
  PetscCall(Rebound(0.03, 0.0, &elastic));
  PetscCall(Rebound(0.03, 0.1, &coarse));
  PetscCall(Rebound(0.015, 0.1, &fine));
  if (getenv("VERBOSE"))
    printf("a disc leaves with %.3f of its speed, damped %.3f, %.3f on a finer mesh\n", elastic, coarse,
           fine);
  CHECK(elastic > 0.96 && elastic < 1.01, "a disc without damping leaves with %g of its speed", elastic);
  CHECK(fabs(coarse / exp(-0.1 * M_PI) - 1.0) < 0.1 && fabs(fine / exp(-0.1 * M_PI) - 1.0) < 0.1 &&
            fabs(fine / coarse - 1.0) < 0.07,
        "a disc of damping ratio 0.1 leaves with %g of its speed, %g on a finer mesh", coarse, fine);
  return 0;
}

int main(int argc, char **argv)
{
  const int n = argc > 1 ? atoi(argv[1]) : 0;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  if (n > 0) {
    PetscCall(Heap(n, 6.0));
  } else {
    PetscCall(Corners());
    PetscCall(Plates());
    PetscCall(Clamps());
    PetscCall(Rebounds());
    PetscCall(Stack(1));
    PetscCall(Stack(3));
    PetscCall(Heap(20, 2.0));
  }
  return PetscFinalize();
}
