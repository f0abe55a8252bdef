/* Seconds of a refinement and of the small changes that follow a ring on its way, on any number of ranks:
 * bench_parallel [size on the ring, default 0.004] [step of the ring in sizes, default 1] [steps, default 5].
 */
#include "common/mesh/part.h"
#include "fluid/adapt/adapt_parallel.h"
#include <math.h>
#include <stdlib.h>

static double Uniform(void *context, const double x[2])
{
  return *(const double *)context;
}

static PetscErrorCode Sample(const Mesh *m, double size, double center, double metric[])
{
  PetscFunctionBeginUser;
  for (int v = 0; v < m->nv; v++) {
    const double h = size + 0.2 * fabs(hypot(m->x[2 * v] - center, m->x[2 * v + 1] - 0.5) - 0.25);
    metric[3 * v] = metric[3 * v + 2] = 1.0 / (h * h);
    metric[3 * v + 1] = 0.0;
  }
  PetscFunctionReturn(0);
}

/* The mesh adapted to the ring around `center` takes the place of *mesh. */
static PetscErrorCode Step(Mesh **mesh, double size, double center)
{
  double *metric;
  Mesh *adapted;
  AdaptReport r;
  int ghosts;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(3 * (*mesh)->nv, &metric));
  PetscCall(Sample(*mesh, size, center, metric));
  PetscCallMPI(MPI_Barrier(PETSC_COMM_WORLD));
  const double t0 = MPI_Wtime();
  PetscCall(MeshAdaptParallel(*mesh, metric, &adapted, &r));
  const double t = MPI_Wtime() - t0;
  PetscCallMPI(MPI_Allreduce(&adapted->ng, &ghosts, 1, MPI_INT, MPI_SUM, PETSC_COMM_WORLD));
  PetscCall(PetscPrintf(
      PETSC_COMM_WORLD,
      "%7d -> %7d triangles, %.4f s, %8.0f/s, %2d rounds, %d splits %d collapses; %.2f %% unit in "
      "[%.2f, %.2f], worst %.2f; %d ghosts\n",
      (int)(*mesh)->nglobal, (int)adapted->nglobal, t, (double)adapted->nglobal / t, r.rounds, r.splits,
      r.collapses, 100.0 * r.edges_unit / r.edges, r.shortest, r.longest, r.quality_worst, ghosts));
  PetscCall(PetscFree(metric));
  PetscCall(MeshDestroy(mesh));
  *mesh = adapted;
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  const double lower[2] = {0.0, 0.0}, upper[2] = {1.0, 1.0};
  double size = argc > 1 ? atof(argv[1]) : 0.004, step = argc > 2 ? atof(argv[2]) : 1.0, coarse = 0.05;
  const int steps = argc > 3 ? atoi(argv[3]) : 5;
  MeshSerial box = {0};
  Mesh *mesh;
  PetscMPIInt rank;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCallMPI(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  if (!rank) PetscCall(MeshBox(lower, upper, coarse, Uniform, &coarse, &box));
  PetscCall(MeshDistribute(PETSC_COMM_WORLD, &box, &mesh));
  PetscCall(MeshSerialDestroy(&box));
  for (int k = 0; k < 3 + steps; k++) PetscCall(Step(&mesh, size, 0.5 + fmax(0, k - 2) * step * size));
  PetscCall(MeshDestroy(&mesh));
  return PetscFinalize();
}
