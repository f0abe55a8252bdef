/* Bodies that slide, have a prescribed motion and break, for the tests of what changes ranks and of what is saved. */
#ifndef TESTS_SOLID_BREAKING_H
#define TESTS_SOLID_BREAKING_H
#include "tests/solid/crack.h"

static inline Material Rough(void)
{
  Material m = RockOf(3e6, 9e6, 20.0, 0.1);
  m.friction = 0.5;
  m.internal_friction = 0.3;
  m.contact_damping = 0.1;
  return m;
}

/* Two that break each other, one on a plate that is driven faster and faster, and one that slides on a held
 * one. */
static inline void Bodies(Model *a)
{
  static const double ROWS[6] = {0.0, 3.0, 0.0, 1e-4, 4.0, 0.5};
  static const BoundaryMotion PUSHED = {"bottom", {.prescribed = {1, 1}, .nrows = 2, .row = ROWS}};
  const double box[1][4] = {{0.0, -1.0, 0.06, 1.0}};
  BodySetup left = BodyAtRest(Rough()), right = left, sliding = left, reaction = left;
  left.joints.all = 1;
  left.velocity[0] = 4.0;
  right.velocity[0] = -8.0;
  right.joints = (JointSetup){.nboxes = 1, .box = box};
  right.nprescribed = 1;
  right.prescribed = &PUSHED;
  sliding.velocity[0] = 5.0;
  sliding.velocity[1] = -1.0;
  sliding.joints.all = 1;
  reaction.fixed = 1;
  AddDisc(a, -0.0505, 0.0, 0.05, 0.012, &left);
  AddRectangle(a, 0.0505, 0.01, 0.1, 0.08, 0.0, 0.012, 1, &right);
  AddRectangle(a, 0.3, 0.0301, 0.1, 0.02, 0.0, 0.01, 1, &sliding);
  AddRectangle(a, 0.3, 0.01, 0.2, 0.02, 0.0, 0.01, 1, &reaction);
}

/* Elements far and near, some ranks with none in the first step. */
static inline PetscErrorCode ScatterElements(Solid s, int nelements, int step)
{
  PetscMPIInt size;
  int *part = malloc((size_t)nelements * sizeof *part);
  const int subdomain = ViewOf(s, NULL, NULL).partition;
  MPI_Comm_size(PETSC_COMM_WORLD, &size);
  for (int e = 0; e < nelements; e++) part[e] = step == 0 ? size - 1 : (e / (1 + step % 5) + step) % size;
  PetscCall(SolidRedistribute(s, part));
  CHECK(size == 1 || ViewOf(s, NULL, NULL).partition != subdomain, "the partition is still %d", subdomain);
  free(part);
  return 0;
}
#endif
