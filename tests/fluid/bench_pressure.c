/* Iterations and time of the pressure's solve while an interface moves through the mesh by half an element a step:
 * a disc (-shape disc) or a flat layer (-shape flat) of -contrast times the density around it, -h the size; -still: without
 * moving, the density being set in each step all the same; -constant: without moving, the density set once.
 * bench_pressure -h 0.02 -contrast 1000 -steps 20 */
#include "tests/fluid/moving_layer.h"
#include <time.h>

typedef struct {
  Layer layer;
  PetscBool still, constant;
  int steps;
} Bench;

/* s: on the clock, and the processor's on the busiest rank */
enum { CLOCK, PROCESSOR, NTIMES };

typedef struct {
  double first[NTIMES], step[NTIMES]; /* set-up and first step; the shortest later one */
  int iterations, most;               /* of the later steps */
} Cost;

static void Start(double time[NTIMES])
{
  time[CLOCK] = MPI_Wtime();
  time[PROCESSOR] = (double)clock() / CLOCKS_PER_SEC;
}

static void Stop(double time[NTIMES])
{
  time[CLOCK] = MPI_Wtime() - time[CLOCK];
  time[PROCESSOR] = (double)clock() / CLOCKS_PER_SEC - time[PROCESSOR];
  MPI_Allreduce(MPI_IN_PLACE, time, NTIMES, MPI_DOUBLE, MPI_MAX, PETSC_COMM_WORLD);
}

static PetscErrorCode Step(const FluidDomain *d, const Bench *b, int k, ProjectionSolver s,
                           SolidCoupling none, double rho[], Vec u, Cost *cost)
{
  const ProjectionStep step = {0.0, DT, rho, b->constant ? 0 : k + 1, none, NULL, PETSC_FALSE, NULL, NULL};
  double time[NTIMES];
  Vec phi;
  SolverReport report;
  PetscFunctionBeginUser;
  for (int e = 0; e < d->mesh->ne; e++)
    rho[e] = LayerDensity(&b->layer, d, e, b->constant || b->still ? 0 : k);
  PetscCall(LayerFall(d->mesh, u));
  Start(time);
  PetscCall(ProjectionSolverSolve(s, &step, u, &phi, &report));
  PetscCall(ProjectionSolverSubtract(s, &step, u));
  Stop(time);
  for (int c = 0; c < NTIMES; c++)
    if (k == 0)
      cost->first[c] += time[c];
    else
      cost->step[c] = fmin(cost->step[c], time[c]);
  if (k == 0) PetscFunctionReturn(0);
  cost->iterations += report.iterations;
  cost->most = PetscMax(cost->most, report.iterations);
  PetscFunctionReturn(0);
}

static PetscErrorCode Run(const FluidDomain *d, const Bench *b)
{
  ProjectionSolver s;
  SolidCoupling none;
  Vec u, p;
  double *rho;
  Cost cost = {.step = {HUGE_VAL, HUGE_VAL}};
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(d->mesh->ne, &rho));
  PetscCall(LayerVectors(d, &u, &p));
  PetscCall(SolidCouplingCreate(d->mesh->ne, &none));
  Start(cost.first);
  PetscCall(ProjectionSolverCreate(d, p, PETSC_FALSE, &s));
  Stop(cost.first);
  for (int k = 0; k <= b->steps; k++) PetscCall(Step(d, b, k, s, none, rho, u, &cost));
  PetscCall(PetscPrintf(
      d->mesh->comm,
      "triangles %6d  contrast %4g  iterations %5.1f (at most %d)  set-up and first step %7.1f ms (processor "
      "%7.1f)  step %6.1f ms (%6.1f)\n",
      (int)d->mesh->nglobal, b->layer.contrast, (double)cost.iterations / b->steps, cost.most,
      1e3 * cost.first[CLOCK], 1e3 * cost.first[PROCESSOR], 1e3 * cost.step[CLOCK],
      1e3 * cost.step[PROCESSOR]));
  PetscCall(ProjectionSolverDestroy(&s));
  PetscCall(SolidCouplingDestroy(&none));
  PetscCall(VecDestroy(&u));
  PetscCall(VecDestroy(&p));
  PetscCall(PetscFree(rho));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  Bench bench = {{.h = 0.02, .contrast = 1000.0}, .steps = 20};
  PetscInt steps = 20;
  char shape[8] = "disc";
  PetscBool open = PETSC_FALSE;
  FluidDomain domain;
  Mesh *mesh;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(PetscOptionsGetReal(NULL, NULL, "-h", &bench.layer.h, NULL));
  PetscCall(PetscOptionsGetReal(NULL, NULL, "-contrast", &bench.layer.contrast, NULL));
  PetscCall(PetscOptionsGetInt(NULL, NULL, "-steps", &steps, NULL));
  PetscCall(PetscOptionsGetString(NULL, NULL, "-shape", shape, sizeof shape, NULL));
  PetscCall(PetscOptionsGetBool(NULL, NULL, "-open", &open, NULL));
  PetscCall(PetscOptionsGetBool(NULL, NULL, "-still", &bench.still, NULL));
  PetscCall(PetscOptionsGetBool(NULL, NULL, "-constant", &bench.constant, NULL));
  bench.layer.flat = (PetscBool)!strcmp(shape, "flat");
  bench.steps = (int)steps;
  PetscCall(LayerDomain(bench.layer.h, open, &mesh, &domain));
  PetscCall(Run(&domain, &bench));
  PetscCall(DomainDestroy(&domain));
  PetscCall(MeshDestroy(&mesh));
  PetscCall(PetscFinalize());
  return 0;
}
