/* What ranks gain: a substep of the same solid on one rank and on all of them, in turns, the fastest of many.
 * On a machine that is busy with other things two ranks seldom run at once, and each waits for the other; so
 * next to the clock this tells the processor time outside MPI of the rank that works most, plus the shortest
 * time that a substep has spent within MPI: what the clock would show if both had a core to themselves.
 *
 *     mpirun -n 2 bench_ranks [elastic | heap | joints | active ...]
 *
 * elastic: one block; heap: blocks of 8 elements that touch, with friction; joints: a block with all edges
 * joints, intact, and one with active ones. */
#include "tests/solid/crack.h"
#include <time.h>

enum { TRIES = 10 };

/* --- time within MPI: its calls that the solid makes in a substep, by MPI's own profiling names ------- */

static double in_mpi[2]; /* s: of the processor, of the clock */

static double Processor(void)
{
  struct timespec t;
  (void)clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

#define TIMED(call)                                                                                          \
  const double processor = Processor(), start = MPI_Wtime();                                                 \
  const int code = call;                                                                                     \
  in_mpi[0] += Processor() - processor;                                                                      \
  in_mpi[1] += MPI_Wtime() - start;                                                                          \
  return code

int(MPI_Waitall)(int n, MPI_Request request[], MPI_Status status[])
{
  TIMED(PMPI_Waitall(n, request, status));
}

int(MPI_Isend)(const void *from, int n, MPI_Datatype type, int to, int tag, MPI_Comm comm,
               MPI_Request *request)
{
  TIMED(PMPI_Isend(from, n, type, to, tag, comm, request));
}

int(MPI_Irecv)(void *to, int n, MPI_Datatype type, int from, int tag, MPI_Comm comm, MPI_Request *request)
{
  TIMED(PMPI_Irecv(to, n, type, from, tag, comm, request));
}

int(MPI_Allreduce)(const void *from, void *to, int n, MPI_Datatype type, MPI_Op op, MPI_Comm comm)
{
  TIMED(PMPI_Allreduce(from, to, n, type, op, comm));
}

/* --- the solids --------------------------------------------------------------------------------------- */

static void Elastic(Model *a)
{
  const BodySetup setup = BodyAtRest(MaterialOf(1000.0, 1e6, 0.3, 0.2));
  AddRectangle(a, 0.0, 0.0, 1.0, 1.0, 0.3, 0.0045, 1, &setup);
}

static void Heap(Model *a)
{
  enum { SIDE = 112 };
  BodySetup setup = BodyAtRest(MaterialOf(1000.0, 1e6, 0.3, 0.2));
  setup.material.friction = 0.3;
  setup.material.contact_damping = 0.2;
  (void)snprintf(setup.material.name, sizeof setup.material.name, "stone");
  for (int k = 0; k < SIDE * SIDE; k++) {
    const double shift = 0.03 * (k / SIDE % 2);
    AddRectangle(a, (k % SIDE + 0.5) * 0.1 + shift, (k / SIDE + 0.5) * 0.1, 0.1, 0.1, 0.0, 0.05, 0, &setup);
  }
}

static void Joined(Model *a, double stretch)
{
  BodySetup setup = BodyAtRest(RockOf(3e6, 3e6, 1e4, 0.0));
  setup.joints.all = 1;
  setup.stretch[0] = setup.stretch[1] = stretch;
  AddRectangle(a, 0.0, 0.0, 1.0, 1.0, 0.3, 0.006, 0, &setup);
}

static void Intact(Model *a)
{
  Joined(a, 1.0);
}

static void Active(Model *a)
{
  Joined(a, 1.0 + 4e-4);
}

typedef struct {
  Solid s;
  int elements, substeps;
  double clock, busy, talk; /* s per substep, the least: by the clock, outside MPI, within MPI */
} Runner;

static PetscErrorCode RunnerCreate(MPI_Comm comm, void (*bodies)(Model *), Runner *r)
{
  const SolidSetup options = {.gravity = {0.0, -9.81}, .courant = 0.5};
  Model a = {0};
  double limit;
  bodies(&a);
  *r = (Runner){
      .elements = a.nelements, .substeps = 40, .clock = HUGE_VAL, .busy = HUGE_VAL, .talk = HUGE_VAL};
  PetscCall(SolidCreate(comm, &a, &options, &r->s));
  PetscCall(SolidLimit(r->s, &limit));
  PetscCall(Run(r->s, 4.0 * limit, 4.0 * limit)); /* some overlap, and joints activate */
  return ModelDestroy(&a);
}

/* The fastest substeps by each of the clocks. */
static PetscErrorCode Try(Runner *r)
{
  double limit, h;
  PetscCall(SolidLimit(r->s, &limit));
  PetscCall(SolidStart(r->s, 0.499 * limit * r->substeps, NULL));
  PetscCall(SolidSubstep(r->s, &h)); /* whose forces SolidStart has computed */
  while (SolidRemaining(r->s)) {
    const double start = MPI_Wtime(), busy = Processor() - in_mpi[0], talk = in_mpi[1];
    PetscCall(SolidSubstep(r->s, &h));
    r->clock = fmin(r->clock, MPI_Wtime() - start);
    r->busy = fmin(r->busy, Processor() - in_mpi[0] - busy);
    r->talk = fmin(r->talk, in_mpi[1] - talk);
  }
  return 0;
}

/* Waits without taking the processor from the one that is measured. */
static PetscErrorCode Wait(void)
{
  const struct timespec nap = {0, 2000000};
  MPI_Request request;
  int done = 0;
  PetscCallMPI(MPI_Ibarrier(PETSC_COMM_WORLD, &request));
  while (!done) {
    PetscCallMPI(MPI_Test(&request, &done, MPI_STATUS_IGNORE));
    if (!done) (void)nanosleep(&nap, NULL);
  }
  return 0;
}

static PetscErrorCode Measure(const char *name, void (*bodies)(Model *), int rank, int size)
{
  Runner one, all;
  PetscCall(RunnerCreate(PETSC_COMM_WORLD, bodies, &all));
  if (rank == 0) PetscCall(RunnerCreate(PETSC_COMM_SELF, bodies, &one));
  for (int k = 0; k < TRIES; k++) {
    PetscCall(Wait());
    if (rank == 0) PetscCall(Try(&one));
    PetscCall(Wait());
    PetscCall(Try(&all));
  }
  PetscCallMPI(PMPI_Allreduce(MPI_IN_PLACE, &all.busy, 1, MPI_DOUBLE, MPI_MAX, PETSC_COMM_WORLD));
  PetscCallMPI(PMPI_Allreduce(MPI_IN_PLACE, &all.talk, 1, MPI_DOUBLE, MPI_MIN, PETSC_COMM_WORLD));
  if (rank == 0)
    printf("%-8s %7d elements  %8.3g %8.3g %5.2f     %8.3g %8.3g %8.3g %5.2f\n", name, one.elements,
           1e3 * one.clock, 1e3 * all.clock, one.clock / all.clock, 1e3 * one.busy, 1e3 * all.busy,
           1e3 * all.talk, one.busy / (all.busy + all.talk));
  if (rank == 0) PetscCall(SolidDestroy(&one.s));
  return SolidDestroy(&all.s);
}

int main(int argc, char **argv)
{
  static const struct {
    const char *name;
    void (*bodies)(Model *);
  } CASES[] = {{"elastic", Elastic}, {"heap", Heap}, {"joints", Intact}, {"active", Active}};
  PetscMPIInt rank, size;
  PetscCall(PetscInitialize(NULL, NULL, NULL, NULL));
  MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
  MPI_Comm_size(PETSC_COMM_WORLD, &size);
  if (rank == 0)
    printf(
        "ms a substep                one   on %d times (clock)     one   on %d   in MPI times (processor)\n",
        size, size);
  for (int k = 0; k < 4; k++) {
    int wanted = argc == 1;
    for (int i = 1; i < argc; i++) wanted |= !strcmp(argv[i], CASES[k].name);
    if (wanted) PetscCall(Measure(CASES[k].name, CASES[k].bodies, rank, size));
  }
  return PetscFinalize();
}
