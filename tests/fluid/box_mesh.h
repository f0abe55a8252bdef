/* Boxes of elements of one size. */
#ifndef TEST_FLUID_BOX_MESH_H
#define TEST_FLUID_BOX_MESH_H
#include "common/mesh/mesh.h"

static inline double Uniform(void *context, const double x[2])
{
  return *(double *)context;
}

/* Collective over PETSC_COMM_WORLD: [0, width] x [0, 1]. */
static inline PetscErrorCode BoxMesh(double width, double h, Mesh **mesh)
{
  const double lower[2] = {0.0, 0.0}, upper[2] = {width, 1.0};
  PetscMPIInt rank;
  MeshSerial serial = {0};
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  if (rank == 0) PetscCall(MeshBox(lower, upper, h, Uniform, &h, &serial));
  PetscCall(MeshDistribute(PETSC_COMM_WORLD, &serial, mesh));
  PetscCall(MeshSerialDestroy(&serial));
  PetscFunctionReturn(0);
}

static inline PetscErrorCode SquareMesh(double h, Mesh **mesh)
{
  return BoxMesh(1.0, h, mesh);
}
#endif
