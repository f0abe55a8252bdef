#include "common/mesh/part.h"

/* Rank 0 has all triangles, the others none. */
static PetscErrorCode Whole(const MeshSerial *serial, MeshPart *part)
{
  PetscFunctionBeginUser;
  part->serial = *serial; /* borrowed */
  PetscCall(PetscMalloc1(serial->nv, &part->gid));
  for (int v = 0; v < serial->nv; v++) part->gid[v] = v;
  PetscFunctionReturn(0);
}

static PetscErrorCode HandOut(MPI_Comm comm, int size, const MeshPart *whole, Mesh **mesh)
{
  MeshPart own;
  PetscErrorCode failed;
  int *target;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(whole->serial.ne, &target));
  failed = MeshPartPartition(comm, whole, size, NULL, target);
  if (!failed) {
    PetscCall(MeshPartMigrate(comm, whole, target, 0, NULL, &own, NULL));
    failed = MeshBuild(comm, &own, mesh);
    PetscCall(MeshPartDestroy(&own));
  }
  PetscCall(PetscFree(target));
  PetscFunctionReturn(failed);
}

PetscErrorCode MeshDistribute(MPI_Comm comm, const MeshSerial *serial, Mesh **mesh)
{
  MeshPart whole = {0};
  PetscErrorCode failed;
  int rank, size;
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  PetscCallMPI(MPI_Comm_size(comm, &size));
  if (rank == 0) PetscCall(Whole(serial, &whole));
  failed = size == 1 ? MeshBuild(comm, &whole, mesh) : HandOut(comm, size, &whole, mesh);
  PetscCall(PetscFree(whole.gid));
  PetscFunctionReturn(failed);
}
