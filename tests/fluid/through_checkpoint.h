/* The state of one fluid to another on the same mesh by a checkpoint, as a run that resumes has it. */
#ifndef TEST_FLUID_THROUGH_CHECKPOINT_H
#define TEST_FLUID_THROUGH_CHECKPOINT_H
#include "fluid/flow/fluid.h"
#include "tests/remove_folder.h"
#include <unistd.h>

/* Collective over mesh->comm. */
static inline PetscErrorCode ThroughCheckpoint(Fluid from, Mesh *mesh, Fluid to)
{
  char folder[64];
  Checkpoint c;
  PetscMPIInt rank;
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(mesh->comm, &rank));
  snprintf(folder, sizeof folder, "/tmp/coracle_through_%d", (int)getpid());
  PetscCallMPI(MPI_Bcast(folder, sizeof folder, MPI_CHAR, 0, mesh->comm));
  if (rank == 0) PetscCall(PetscMkdir(folder));
  PetscCallMPI(MPI_Barrier(mesh->comm));
  PetscCall(CheckpointCreate(mesh->comm, folder, "fluid", &c));
  PetscCall(FluidSave(from, c));
  PetscCall(CheckpointClose(&c));
  PetscCall(CheckpointOpen(mesh->comm, folder, "fluid", &c));
  PetscCall(FluidLoad(to, mesh->egid, c));
  PetscCall(CheckpointClose(&c));
  PetscCallMPI(MPI_Barrier(mesh->comm));
  if (rank == 0) RemoveFolder(folder);
  PetscFunctionReturn(0);
}
#endif
