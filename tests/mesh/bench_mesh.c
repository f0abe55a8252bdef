/* How long meshing, distributing and ordering take: bench_mesh [smallest size, default 0.0042]. */
#include "common/mesh/part_partition.h"
#include <math.h>
#include <stdlib.h>
#include <time.h>

typedef struct {
  double smallest;
} Strip;

/* The falling disc's box: `smallest` in the strip that it sweeps, growing by 1/4 m/m outside. */
static double SizeAt(void *context, const double x[2])
{
  const Strip *s = context;
  const double dx = fmax(fmax(1.08 - x[0], x[0] - 1.42), 0.0), dy = fmax(fmax(1.0 - x[1], x[1] - 4.95), 0.0);
  return s->smallest + 0.25 * hypot(dx, dy);
}

/* The mesh's parts cut again into as many, of processor time the most of a rank and that of rank 0. */
static PetscErrorCode Repartition(const Mesh *mesh, PetscBool clusters, const char *how)
{
  MeshPart part;
  int *target, size;
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_size(PETSC_COMM_WORLD, &size));
  PetscCall(MeshPartOf(mesh, &part));
  PetscCall(PetscMalloc1(part.serial.ne, &target));
  PetscCallMPI(MPI_Barrier(PETSC_COMM_WORLD));
  const double begin = (double)clock() / CLOCKS_PER_SEC;
  PetscCall(PartPartition(PETSC_COMM_WORLD, &part, size, NULL, clusters, target));
  double spent = (double)clock() / CLOCKS_PER_SEC - begin, largest = spent;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_DOUBLE, MPI_MAX, PETSC_COMM_WORLD));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "partition %s: %.3f s, on rank 0 %.3f s\n", how, largest, spent));
  PetscCall(PetscFree(target));
  PetscCall(MeshPartDestroy(&part));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  const double lower[2] = {0.0, 0.0}, upper[2] = {2.5, 5.5};
  Strip strip = {argc > 1 ? atof(argv[1]) : 0.0042};
  MeshSerial serial = {0};
  Mesh *mesh;
  PetscMPIInt rank;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCallMPI(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  const double t0 = MPI_Wtime();
  if (rank == 0) PetscCall(MeshBox(lower, upper, 0.06, SizeAt, &strip, &serial));
  const double t1 = MPI_Wtime();
  PetscCall(MeshDistribute(PETSC_COMM_WORLD, &serial, &mesh));
  const double t2 = MPI_Wtime();
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%d triangles, %d vertices: box %.3f s, distribution %.3f s\n",
                        (int)mesh->nglobal, (int)mesh->nv_global, t1 - t0, t2 - t1));
  PetscCall(Repartition(mesh, PETSC_FALSE, "as one graph"));
  PetscCall(Repartition(mesh, PETSC_TRUE, "by clusters"));
  PetscCall(MeshSerialDestroy(&serial));
  PetscCall(MeshDestroy(&mesh));
  return PetscFinalize();
}
