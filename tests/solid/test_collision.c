// ranks: 1 2
/* Two elastic discs meet head on and obliquely without friction: momentum and angular momentum to round-off
 * at every moment, energy within 1e-3 afterwards. */
#include "tests/solid/build.h"

static PetscErrorCode Collide(double offset, double *restitution)
{
  BodySetup left = BodyAtRest(MaterialOf(1000.0, 1.0e6, 0.3, 0.0)), right = left;
  const SolidSetup options = {.courant = 0.8};
  Model a = {0};
  BodyState b[2];
  Totals before = {0}, now = {0};
  Solid s;
  double scale;
  left.velocity[0] = 0.5;
  right.velocity[0] = -0.25;
  right.material.density = 2000.0;
  AddDisc(&a, -0.105, 0.0, 0.1, 0.02, &left);
  AddDisc(&a, 0.105, offset, 0.1, 0.02, &right);
  PetscCall(SolidCreate(PETSC_COMM_WORLD, &a, &options, &s));
  PetscCall(TotalsOf(s, &before, b));
  PetscCall(SolidBodies(s, 2, b));
  scale = b[0].mass * 0.5 + b[1].mass * 0.25;
  for (int k = 0; k < 60; k++) {
    PetscCall(Run(s, 1e-3, 1e-3));
    PetscCall(TotalsOf(s, &now, b));
    for (int c = 0; c < 2; c++)
      CHECK(fabs(now.p[c] - before.p[c]) < 1e-12 * scale, "momentum %d off by %g", c, now.p[c] - before.p[c]);
    CHECK(fabs(now.spin - before.spin) < 1e-12 * scale * 0.2, "angular momentum off by %g",
          now.spin - before.spin);
  }
  PetscCall(SolidBodies(s, 2, b));
  const double distance = hypot(b[1].x[0] - b[0].x[0], b[1].x[1] - b[0].x[1]);
  CHECK(distance > 0.205, "the discs have not parted: distance %g", distance);
  const double change = now.energy / before.energy - 1.0;
  CHECK(fabs(change) < 1e-3, "energy changed by %g", change);
  *restitution = (b[1].v[0] - b[0].v[0]) / 0.75;
  if (getenv("VERBOSE"))
    printf("offset %g: energy %+.2e, restitution %.4f, substeps %lld, searches %d\n", offset, change,
           *restitution, SolidGetStats(s)->total, SolidGetStats(s)->searches);
  PetscCall(ModelDestroy(&a));
  return SolidDestroy(&s);
}

int main(int argc, char **argv)
{
  double head_on, oblique;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(Collide(0.0, &head_on));
  PetscCall(Collide(0.05, &oblique));
  CHECK(head_on > 0.9 && head_on <= 1.0, "restitution %g", head_on); /* a few per cent go into vibration */
  CHECK(oblique > 0.5 && oblique < head_on, "restitution along x %g", oblique);
  return PetscFinalize();
}
