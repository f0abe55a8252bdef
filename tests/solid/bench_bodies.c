/* Cost against the number of bodies: walls of touching blocks of 8 elements, 1e3 to 1e5 bodies.  In
 * microseconds of the clock per body: to read shapes into the model, to make the solid of it
 * (distribution, joints, contact), a search, a substep, all that is once a step (bodies' states, interface
 * velocities, the check of the balance), and a redistribution; memory in kB a body of the rank that has most.
 *
 *     [mpirun -n 2] bench_bodies [blocks along a side ...] */
#include "common/link/resources.h"
#include "solid/solid_impl.h"
#include "tests/solid/build.h"
#include <time.h>

/* s */
static double Processor(void)
{
  return (double)clock() / CLOCKS_PER_SEC;
}

static void Build(Model *a, int side)
{
  BodySetup setup = BodyAtRest(MaterialOf(1000.0, 1.0e6, 0.3, 0.2));
  setup.material.friction = 0.3;
  setup.material.contact_damping = 0.2;
  (void)snprintf(setup.material.name, sizeof setup.material.name, "stone");
  for (int k = 0; k < side * side; k++)
    AddRectangle(a, (k % side + 0.5) * 0.1, (k / side + 0.5) * 0.1, 0.1, 0.1, 0.0, 0.05, 0, &setup);
}

static PetscErrorCode Substeps(Solid s, int n, double *seconds)
{
  double limit, h;
  PetscCall(SolidLimit(s, &limit));
  PetscCall(SolidStart(s, 0.7 * n * limit, NULL));
  const long long before = SolidGetStats(s)->total;
  const double start = Processor();
  while (SolidRemaining(s)) PetscCall(SolidSubstep(s, &h));
  *seconds = (Processor() - start) / (double)(SolidGetStats(s)->total - before);
  return 0;
}

static PetscErrorCode OncePerStep(Solid s, double *seconds)
{
  const double start = Processor();
  InterfaceMotion interface;
  BodyState state[8];
  PetscCall(SolidBodies(s, 8, state));
  PetscCall(SolidUpdateInterfaceMotion(s, &interface));
  PetscCall(SolidRebalance(s));
  *seconds = Processor() - start;
  return 0;
}

static PetscErrorCode Redistribute(Solid s, double *seconds)
{
  const double start = Processor();
  s->setup.rebalance = -1.0; /* at once */
  PetscCall(SolidRebalance(s));
  *seconds = Processor() - start;
  return 0;
}

static PetscErrorCode Measure(int side)
{
  const SolidSetup options = {.gravity = {0.0, -9.81},
                              .courant = 0.8,
                              .rebalance = 1e9,
                              .walls = PETSC_TRUE,
                              .lower = {0.0, 0.0},
                              .upper = {0.1 * side, 0.1 * side + 1.0}};
  const double n = (double)side * side, memory = 1024.0 * PeakMemory();
  double t[6], grown;
  Model a = {0};
  Solid s;
  t[0] = Processor();
  Build(&a, side);
  t[0] = Processor() - t[0];
  t[1] = Processor();
  PetscCall(SolidCreate(PETSC_COMM_WORLD, &a, &options, &s));
  t[1] = Processor() - t[1];
  PetscCall(Substeps(s, 20, &t[3])); /* some overlap */
  t[2] = Processor();
  PetscCall(ContactSearch(s->contact, s, NULL));
  t[2] = Processor() - t[2];
  PetscCall(Substeps(s, 10 + (int)(1e5 / n), &t[3]));
  PetscCall(OncePerStep(s, &t[4]));
  PetscCall(Redistribute(s, &t[5]));
  grown = 1024.0 * PeakMemory() - memory;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &grown, 1, MPI_DOUBLE, MPI_MAX, PETSC_COMM_WORLD));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%7d %9.2f %8.2f %8.2f %8.3f %8.3f %8.2f %8.2f\n", side * side,
                        1e6 * t[0] / n, 1e6 * t[1] / n, 1e6 * t[2] / n, 1e6 * t[3] / n, 1e6 * t[4] / n,
                        1e6 * t[5] / n, grown / n));
  PetscCall(ModelDestroy(&a));
  return SolidDestroy(&s);
}

int main(int argc, char **argv)
{
  const int standard[] = {32, 100, 316};
  PetscCall(PetscInitialize(NULL, NULL, NULL, NULL));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD,
                        " bodies     model   create   search  substep     step   redist       kB\n"));
  for (int k = 0; k < (argc > 1 ? argc - 1 : 3); k++)
    PetscCall(Measure(argc > 1 ? atoi(argv[k + 1]) : standard[k]));
  return PetscFinalize();
}
