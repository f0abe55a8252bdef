/* What a step of the fluid alone costs, by phases: seconds of the clock, and the fraction of them that the phase's bytes
 * (step_bytes.h) need at the memory's speed.  The pressure is solved by CG, as beside a moving solid.
 *
 * bench_fluid -h 0.01 -steps 20 -triad 15.9     mesh size, steps; GB/s of one core (bench_stream) times ranks */
#include "tests/fluid/exact.h"
#include "tests/fluid/step_bytes.h"
#include <time.h>

enum { ASSEMBLY, MOMENTUM, PRESSURE, NPHASES }; /* as FluidStats.seconds */

typedef struct {
  double clock, processor; /* s a step; processor: of the busiest rank, with its waiting for messages */
  double phase[NPHASES];
  double momentum, pressure; /* iterations a step */
} Cost;

static PetscErrorCode Measure(Fluid fluid, double dt, int steps, Cost *cost)
{
  const FluidStats before = *FluidGetStats(fluid);
  const double start = MPI_Wtime(), processor = (double)clock() / CLOCKS_PER_SEC;
  PetscFunctionBeginUser;
  *cost = (Cost){0};
  for (int k = 0; k < steps; k++) {
    PetscCall(FluidStep(fluid, dt));
    cost->momentum += (double)FluidGetStats(fluid)->momentum_iterations / steps;
    cost->pressure += (double)FluidGetStats(fluid)->pressure_iterations / steps;
  }
  cost->clock = (MPI_Wtime() - start) / steps;
  cost->processor = ((double)clock() / CLOCKS_PER_SEC - processor) / steps;
  for (int k = 0; k < NPHASES; k++)
    cost->phase[k] = (FluidGetStats(fluid)->seconds[k] - before.seconds[k]) / steps;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &cost->processor, 1, MPI_DOUBLE, MPI_MAX, PETSC_COMM_WORLD));
  PetscFunctionReturn(0);
}

static PetscErrorCode Print(double elements, double triad, const Cost *c)
{
  const double bytes[NPHASES] = {AssemblyBytes(elements), MomentumBytes(elements, c->momentum),
                                 PressureBytes(elements, c->pressure)};
  double part[NPHASES];
  PetscMPIInt ranks;
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_size(PETSC_COMM_WORLD, &ranks));
  for (int k = 0; k < NPHASES; k++)
    part[k] = triad > 0.0 ? bytes[k] / (1e9 * triad * ranks) / c->phase[k] : 0.0;
  PetscCall(PetscPrintf(
      PETSC_COMM_WORLD,
      "%8d triangles, ranks %d: step %.4f s (processor %.4f), %.2f us a triangle | assembly %.4f (%.2f) | "
      "momentum %.4f (%.2f), %.1f iterations | pressure %.4f (%.2f), %.1f\n",
      (int)elements, ranks, c->clock, c->processor, 1e6 * c->clock / elements, c->phase[ASSEMBLY],
      part[ASSEMBLY], c->phase[MOMENTUM], part[MOMENTUM], c->momentum, c->phase[PRESSURE], part[PRESSURE],
      c->pressure));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  double h = 0.01, mu = MU, triad = 0.0;
  PetscInt steps = 20, warm = 3;
  Exact exact = {1.0};
  Mesh *mesh;
  Fluid fluid;
  Cost cost;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(PetscOptionsGetReal(NULL, NULL, "-h", &h, NULL));
  PetscCall(PetscOptionsGetInt(NULL, NULL, "-steps", &steps, NULL));
  PetscCall(PetscOptionsGetReal(NULL, NULL, "-mu", &mu, NULL));
  PetscCall(PetscOptionsGetReal(NULL, NULL, "-triad", &triad, NULL));
  PetscCall(PetscOptionsInsertString(NULL, "-pressure_direct_max 0"));
  PetscCall(SquareMesh(h, &mesh));
  PetscCall(ExactFluid(mesh, &exact, NULL, mu, &fluid));
  for (int k = 0; k < warm; k++) PetscCall(FluidStep(fluid, 0.5 * h));
  PetscCall(Measure(fluid, 0.5 * h, (int)steps, &cost));
  PetscCall(Print((double)mesh->nglobal, triad, &cost));
  PetscCall(FluidDestroy(&fluid));
  PetscCall(MeshDestroy(&mesh));
  PetscCall(PetscFinalize());
  return 0;
}
