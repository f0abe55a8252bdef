// ranks: 1 2 3
/* Two bodies, of both elastic laws, break each other, one of them in a part only: the same on any number of
 * ranks, shared nodes with the same bits on all of them, and a step that is redone after other cracks to the
 * last bit. */
#include "tests/solid/crack.h"

enum { STEPS = 12 };

static void Bodies(Model *a)
{
  const double box[1][4] = {{0.0, -1.0, 0.06, 1.0}};
  BodySetup left = BodyAtRest(RockOf(3e6, 9e6, 20.0, 0.1)), right = left;
  left.joints.all = 1;
  left.velocity[0] = 4.0;
  right.material.law = 1;
  right.velocity[0] = -8.0;
  right.joints = (JointSetup){.nboxes = 1, .box = box};
  AddDisc(a, -0.0505, 0.0, 0.05, 0.012, &left);
  AddRectangle(a, 0.0505, 0.01, 0.1, 0.08, 0.0, 0.012, 1, &right);
}

/* all[nids][4]: x and v by global number, NAN for nodes that this rank has not. */
static PetscErrorCode Simulate(MPI_Comm comm, int redo, double *all, int nids, FractureState *f, int *pieces)
{
  const SolidSetup options = {.courant = 0.8};
  Model a = {0};
  Solid s;
  Bodies(&a);
  PetscCall(SolidCreate(comm, &a, &options, &s));
  for (int k = 0; k < STEPS; k++) {
    if (redo) {
      PetscCall(SolidState(s, 1));
      PetscCall(PushStep(s, 2e7));
      PetscCall(SolidState(s, 0));
    }
    PetscCall(PushStep(s, 1e6));
  }
  const SolidView v = ViewOf(s, NULL, NULL);
  for (int k = 0; k < 4 * nids; k++) all[k] = NAN;
  for (int n = 0; n < v.nnodes; n++)
    for (int c = 0; c < 2; c++) {
      CHECK(v.gid[n] < nids, "node %lld of %d", v.gid[n], nids);
      all[4 * v.gid[n] + c] = v.x[2 * n + c];
      all[4 * v.gid[n] + 2 + c] = v.v[2 * n + c];
    }
  int *fragment = malloc(((size_t)v.nelements + 1) * sizeof *fragment);
  PetscCall(SolidFracture(s, f));
  PetscCall(SolidFragments(s, fragment, pieces));
  free(fragment);
  PetscCall(ModelDestroy(&a));
  return SolidDestroy(&s);
}

int main(int argc, char **argv)
{
  Model a = {0};
  FractureState one, many, redone;
  int pieces[3];
  double largest = 0.0;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  Bodies(&a);
  const int nids = a.nnodes + 3 * a.nelements, n = 4 * nids;
  double *serial = malloc((size_t)n * sizeof *serial), *mine = malloc((size_t)n * sizeof *mine);
  double *again = malloc((size_t)n * sizeof *again);
  PetscCall(Simulate(PETSC_COMM_SELF, 0, serial, nids, &one, &pieces[0]));
  PetscCall(Simulate(PETSC_COMM_WORLD, 0, mine, nids, &many, &pieces[1]));
  PetscCall(Simulate(PETSC_COMM_WORLD, 1, again, nids, &redone, &pieces[2]));
  for (int k = 0; k < n; k++) {
    CHECK(isnan(mine[k]) == isnan(again[k]) && !(mine[k] < again[k] || mine[k] > again[k]),
          "node %d: %.17g, redone %.17g", k / 4, mine[k], again[k]);
    if (isnan(mine[k])) continue;
    CHECK(!isnan(serial[k]), "node %d is not there on one rank", k / 4);
    largest = fmax(largest, fabs(mine[k] - serial[k]) / (k % 4 < 2 ? 0.1 : 10.0));
  }
  if (getenv("VERBOSE"))
    printf("largest difference %.2e; %d broken, %d live, %d pieces, %g J/m\n", largest, many.broken,
           many.active, pieces[1], many.energy);
  CHECK(one.broken > 20 && pieces[0] > 4, "%d broken, %d pieces", one.broken, pieces[0]);
  CHECK(one.broken == many.broken && one.active == many.active && pieces[0] == pieces[1], "%d broken and %d",
        one.broken, many.broken);
  CHECK(fabs(one.energy / many.energy - 1.0) < 1e-9 && many.energy == redone.energy,
        "energy %.12g, %.12g, %.12g", one.energy, many.energy, redone.energy);
  CHECK(largest < 1e-9, "differs from one rank by %g", largest);
  PetscCall(CopiesAgree(mine, n, 1));
  free(serial);
  free(mine);
  free(again);
  PetscCall(ModelDestroy(&a));
  return PetscFinalize();
}
