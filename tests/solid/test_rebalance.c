// ranks: 1 2 3
/* Elements change ranks while bodies slide, have a prescribed motion and break: the answer is that of one rank to
 * what contact and cracks make of round-off (a run from positions that differ by as much is measured beside it), a step that is redone after another try and another redistribution has the same bits, and what
 * has moved away from its rank's other bodies is dealt out anew by itself. */
#include <float.h>

#include "solid/contact/contact_impl.h"
#include "tests/solid/breaking.h"

enum { STEPS = 6, CALM, PERTURBED, SCATTERED, REDONE };

typedef struct {
  double *all; /* [nids][4] x and v by global number, NAN for nodes that this rank has not */
  FractureState f;
  BodyState body[4];
  int pieces;
} Answer;

static PetscErrorCode CollectAnswer(Solid s, int nids, Answer *out)
{
  const SolidView v = ViewOf(s, NULL, NULL);
  int *fragment = malloc(((size_t)v.nelements + 1) * sizeof *fragment);
  out->all = malloc(4 * (size_t)nids * sizeof *out->all);
  for (int k = 0; k < 4 * nids; k++) out->all[k] = NAN;
  for (int n = 0; n < v.nnodes; n++)
    for (int c = 0; c < 2; c++) {
      out->all[4 * v.gid[n] + c] = v.x[2 * n + c];
      out->all[4 * v.gid[n] + 2 + c] = v.v[2 * n + c];
    }
  PetscCall(SolidBodies(s, 4, out->body));
  PetscCall(SolidFracture(s, &out->f));
  PetscCall(SolidFragments(s, fragment, &out->pieces));
  free(fragment);
  return 0;
}

static PetscErrorCode Simulate(MPI_Comm comm, int how, int nids, Answer *out)
{
  const SolidSetup options = {.courant = 0.8, .rebalance = 1e9};
  Model a = {0};
  Solid s;
  Bodies(&a);
  for (int k = 0; k < 2 * a.nnodes && how == PERTURBED; k++) a.x[k] *= 1.0 + (k % 3 - 1) * DBL_EPSILON;
  PetscCall(SolidCreate(comm, &a, &options, &s));
  for (int k = 0; k < STEPS; k++) {
    if (how == REDONE) {
      PetscCall(SolidState(s, 1));
      PetscCall(PushStep(s, 2e7));
      PetscCall(ScatterElements(s, a.nelements, k + 3));
      if (k % 2) PetscCall(ScatterElements(s, a.nelements, k + 4));
      PetscCall(SolidState(s, 0));
    }
    PetscCall(PushStep(s, 1e6));
    if (how > PERTURBED) PetscCall(ScatterElements(s, a.nelements, k));
  }
  PetscCall(CollectAnswer(s, nids, out));
  PetscCall(ModelDestroy(&a));
  return SolidDestroy(&s);
}

/* Of x in parts of 0.1 m and v in parts of 10 m/s, over the nodes that b has. */
static double LargestDifference(const Answer *a, const Answer *b, int n)
{
  double largest = 0.0;
  for (int k = 0; k < n; k++)
    if (!isnan(b->all[k])) largest = fmax(largest, fabs(b->all[k] - a->all[k]) / (k % 4 < 2 ? 0.1 : 10.0));
  return largest;
}

/* bound: of the largest difference to one rank. */
static PetscErrorCode Compare(const Answer *one, const Answer *many, const Answer *redone, int n,
                              double bound)
{
  const double largest = LargestDifference(one, many, n);
  for (int k = 0; k < n; k++) {
    const double a = many->all[k], b = redone->all[k];
    CHECK(isnan(a) == isnan(b) && !(a < b || a > b), "node %d: %.17g, redone %.17g", k / 4, a, b);
    CHECK(isnan(a) || !isnan(one->all[k]), "node %d is not there on one rank", k / 4);
  }
  if (getenv("VERBOSE"))
    printf("largest difference %.2e, bound %.2e; %d broken, %d live, %d pieces\n", largest, bound,
           many->f.broken, many->f.active, many->pieces);
  CHECK(largest < bound, "differs from one rank by %g, bound %g", largest, bound);
  CHECK(one->f.broken > 20 && one->pieces > 4, "%d broken, %d pieces", one->f.broken, one->pieces);
  CHECK(one->f.broken == many->f.broken && one->f.active == many->f.active && one->pieces == many->pieces,
        "%d broken and %d", one->f.broken, many->f.broken);
  CHECK(fabs(one->f.energy / many->f.energy - 1.0) < bound && many->f.energy == redone->f.energy,
        "energy %.12g, %.12g, %.12g", one->f.energy, many->f.energy, redone->f.energy);
  for (int b = 0; b < 4; b++)
    CHECK(fabs(one->body[b].load[0] - many->body[b].load[0]) < 1e-9 * 1e5 &&
              fabs(one->body[b].kinetic - many->body[b].kinetic) <= 1e-9 * one->body[b].kinetic,
          "body %d: load %g and %g, kinetic energy %g and %g", b, one->body[b].load[0], many->body[b].load[0],
          one->body[b].kinetic, many->body[b].kinetic);
  return CopiesAgree(many->all, n, 1);
}

/* What a relative change of the first positions by DBL_EPSILON grows to is 2e-11 to 4e-11; sums in another order change every substep by as much,
 * so the bound is ten times what it has grown to. */
static PetscErrorCode Forced(void)
{
  Answer one, perturbed, many, redone;
  Model a = {0};
  Bodies(&a);
  const int nids = a.nnodes + 3 * a.nelements;
  PetscCall(Simulate(PETSC_COMM_SELF, CALM, nids, &one));
  PetscCall(Simulate(PETSC_COMM_SELF, PERTURBED, nids, &perturbed));
  PetscCall(Simulate(PETSC_COMM_WORLD, SCATTERED, nids, &many));
  PetscCall(Simulate(PETSC_COMM_WORLD, REDONE, nids, &redone));
  const double grown = LargestDifference(&one, &perturbed, 4 * nids);
  CHECK(grown > 0.0 && grown < 1e-9, "a perturbation by round-off grows to %g", grown);
  PetscCall(Compare(&one, &many, &redone, 4 * nids, 10.0 * grown));
  free(one.all);
  free(perturbed.all);
  free(many.all);
  free(redone.all);
  return ModelDestroy(&a);
}

/* --- by itself ---------------------------------------------------------------------------------------- */

/* Two rows of blocks, the upper sliding by half its length over the lower.  *travelling: targets that travel
 * in a substep at the end. */
static PetscErrorCode Slide(MPI_Comm comm, double rebalance, BodyState state[], int n, int *travelling,
                            int *rebalanced)
{
  const SolidSetup options = {.gravity = {0.0, -10.0}, .courant = 0.8, .rebalance = rebalance};
  BodySetup setup = BodyAtRest(MaterialOf(1000.0, 1e6, 0.3, 0.3));
  Model a = {0};
  Solid s;
  setup.material.friction = 0.02;
  for (int k = 0; k < n; k++) {
    const int upper = k >= n / 2;
    setup.fixed = !upper;
    setup.velocity[0] = 4.0 * upper;
    AddRectangle(&a, 0.101 * (k % (n / 2)), 0.1001 * upper, 0.1, 0.1, 0.0, 0.025, 0, &setup);
  }
  PetscCall(SolidCreate(comm, &a, &options, &s));
  for (int k = 0; k < 20; k++) {
    PetscCall(RunStep(s, 2.5e-3, NULL));
    PetscCall(SolidRebalance(s));
  }
  PetscCall(SolidBodies(s, n, state));
  *travelling = s->contact->halo ? HaloTraffic(s->contact->halo) : 0;
  if (s->size > 1) PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, travelling, 1, MPI_INT, MPI_SUM, comm));
  *rebalanced = SolidGetStats(s)->rebalanced;
  PetscCall(ModelDestroy(&a));
  return SolidDestroy(&s);
}

static PetscErrorCode Automatic(void)
{
  enum { N = 8 };
  BodyState one[N], off[N], on[N];
  PetscMPIInt size;
  int travelling[3], rebalanced[3];
  MPI_Comm_size(PETSC_COMM_WORLD, &size);
  PetscCall(Slide(PETSC_COMM_SELF, 3.0, one, N, &travelling[0], &rebalanced[0]));
  PetscCall(Slide(PETSC_COMM_WORLD, 0.0, off, N, &travelling[1], &rebalanced[1]));
  PetscCall(Slide(PETSC_COMM_WORLD, 3.0, on, N, &travelling[2], &rebalanced[2]));
  if (getenv("VERBOSE"))
    printf("%d targets travel, %d after %d redistributions\n", travelling[1], travelling[2], rebalanced[2]);
  CHECK(rebalanced[1] == 0 && (size == 1 || rebalanced[2] > 0), "%d redistributions", rebalanced[2]);
  CHECK(size == 1 || travelling[2] < travelling[1], "%d targets travel, %d without redistribution",
        travelling[2], travelling[1]);
  for (int b = 0; b < N; b++)
    for (int c = 0; c < 2; c++)
      CHECK(fabs(one[b].x[c] - on[b].x[c]) < 1e-11 && fabs(one[b].v[c] - on[b].v[c]) < 1e-10,
            "body %d: x differs by %g, v by %g", b, one[b].x[c] - on[b].x[c], one[b].v[c] - on[b].v[c]);
  CHECK(one[N - 1].x[0] > 0.17 + 0.101 * (N / 2 - 1), "the last block is at %g", one[N - 1].x[0]);
  return 0;
}

int main(int argc, char **argv)
{
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(Forced());
  PetscCall(Automatic());
  return PetscFinalize();
}
