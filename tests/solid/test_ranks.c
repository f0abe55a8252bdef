// ranks: 1 2 3
/* The same motion on any number of ranks, to round-off: three bodies of which two collide, one of six-node triangles, and one is a single
 * element pair that leaves ranks without elements of it, walls, a spring, a load, and a step that is redone to the last
 * bit. */
#include "tests/solid/build.h"

enum { STEPS = 40 };

static void Bodies(Model *a)
{
  BodySetup setup = BodyAtRest(MaterialOf(1000.0, 1.0e6, 0.3, 0.1));
  setup.velocity[0] = 1.0;
  setup.angular_velocity = 2.0;
  AddDisc(a, -0.105, 0.15, 0.1, 0.03, &setup);
  setup.velocity[0] = -1.0;
  setup.six_node = 1;
  AddRectangle(a, 0.1, 0.15, 0.18, 0.2, 0.2, 0.06, 1, &setup);
  setup.six_node = 0;
  setup.velocity[0] = 0.0;
  AddRectangle(a, 0.5, 0.05, 0.1, 0.05, 0.5, 0.1, 0, &setup);
}

/* A load that every rank computes for its own facets: shared nodes get their parts from several ranks. */
static void Load(const SolidView *v, int step, double load[])
{
  memset(load, 0, 2 * (size_t)v->nnodes * sizeof *load);
  for (int k = 0; k < v->nfacets; k++)
    for (int i = 0; i < 2; i++) {
      load[2 * v->facet[2 * k + i]] += sin(0.3 * step + v->rest[2 * v->facet[2 * k] + 1]);
      load[2 * v->facet[2 * k + i] + 1] += 0.5 * cos(v->rest[2 * v->facet[2 * k]]);
    }
}

static PetscErrorCode Step(Solid s, int step)
{
  SolidView v = ViewOf(s, NULL, NULL);
  double *load = malloc((2 * (size_t)v.nnodes + 1) * sizeof *load);
  Load(&v, step, load);
  PetscCall(RunStep(s, 1e-3, load));
  free(load);
  return 0;
}

/* x and v, by global number, of the nodes that comm has */
static PetscErrorCode Simulate(MPI_Comm comm, int redo, double *all, int nnodes, int *searches)
{
  const SolidSetup options = {.gravity = {0.0, -9.81},
                              .courant = 0.8,
                              .walls = PETSC_TRUE,
                              .lower = {-0.5, 0.0},
                              .upper = {0.6, 1.0},
                              .nsprings = 2,
                              .spring = {{.end = {{.element = 7, .weight = {0.2, 0.3, 0.5}}},
                                          .anchored = 1,
                                          .anchor = {-0.3, 0.4},
                                          .stiffness = 1e4,
                                          .length = 0.1},
                                         {.end = {{.element = 3, .weight = {0.2, 0.3, 0.5}},
                                                  {.element = 60, .weight = {0.4, 0.4, 0.2}}},
                                          .stiffness = 1e3,
                                          .damping = 1.0,
                                          .length = 0.3}}};
  Model a = {0};
  Solid s;
  Bodies(&a);
  CHECK(a.nnodes == nnodes, "%d nodes", a.nnodes);
  PetscCall(SolidCreate(comm, &a, &options, &s));
  for (int k = 0; k < STEPS; k++) {
    if (redo) {
      PetscCall(SolidState(s, 1));
      PetscCall(Step(s, k + 7)); /* a try with another load */
      PetscCall(SolidState(s, 0));
    }
    PetscCall(Step(s, k));
  }
  SolidView v = ViewOf(s, NULL, NULL);
  for (int k = 0; k < 4 * nnodes; k++) all[k] = NAN;
  for (int n = 0; n < v.nnodes; n++)
    for (int c = 0; c < 2; c++) {
      all[4 * v.gid[n] + c] = v.x[2 * n + c];
      all[4 * v.gid[n] + 2 + c] = v.v[2 * n + c];
    }
  BodyState b[3];
  PetscCall(SolidBodies(s, 3, b));
  CHECK(b[0].v[0] < 0.0 && b[1].v[0] > 0.0, "the bodies have not met: %g %g", b[0].v[0], b[1].v[0]);
  CHECK(b[2].v[1] > -0.3, "the third has not met the floor: %g", b[2].v[1]);
  *searches = SolidGetStats(s)->searches;
  PetscCall(ModelDestroy(&a));
  return SolidDestroy(&s);
}

/* More ranks than elements: two triangles. */
static PetscErrorCode Tiny(void)
{
  const BodySetup setup = BodyAtRest(MaterialOf(1000.0, 1.0e6, 0.3, 0.0));
  const SolidSetup options = {.gravity = {0.0, -9.81}, .courant = 0.8};
  Model a = {0};
  BodyState b;
  Solid s;
  AddRectangle(&a, 0.0, 0.0, 0.1, 0.1, 0.0, 0.1, 0, &setup);
  PetscCall(SolidCreate(PETSC_COMM_WORLD, &a, &options, &s));
  PetscCall(Run(s, 0.1, 0.01));
  PetscCall(SolidBodies(s, 1, &b));
  CHECK(fabs(b.v[1] + 0.981) < 1e-12, "falls with %g", b.v[1]);
  PetscCall(ModelDestroy(&a));
  return SolidDestroy(&s);
}

int main(int argc, char **argv)
{
  Model a = {0};
  int searches, serial_searches;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  Bodies(&a);
  const int n = 4 * a.nnodes;
  double *serial = malloc((size_t)n * sizeof *serial), *mine = malloc((size_t)n * sizeof *mine);
  double *redone = malloc((size_t)n * sizeof *redone), largest = 0.0;
  PetscCall(Simulate(PETSC_COMM_SELF, 0, serial, a.nnodes, &serial_searches));
  PetscCall(Simulate(PETSC_COMM_WORLD, 0, mine, a.nnodes, &searches));
  PetscCall(Simulate(PETSC_COMM_WORLD, 1, redone, a.nnodes, &searches));
  for (int k = 0; k < n; k++) {
    if (isnan(mine[k])) continue;
    const double scale = k % 4 < 2 ? 0.1 : 1.0;
    largest = fmax(largest, fabs(mine[k] - serial[k]) / scale);
    CHECK(mine[k] == redone[k], "node %d: %.17g, redone %.17g", k / 4, mine[k], redone[k]);
  }
  if (getenv("VERBOSE")) printf("largest difference %.2e, %d searches\n", largest, serial_searches);
  CHECK(largest < 1e-9, "differs from one rank by %g", largest);
  PetscCall(CopiesAgree(mine, n, 0));
  PetscCall(Tiny());
  free(serial);
  free(mine);
  free(redone);
  PetscCall(ModelDestroy(&a));
  return PetscFinalize();
}
