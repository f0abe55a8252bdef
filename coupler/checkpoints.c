#include "coupler/checkpoints.h"
#include "common/link/participant.h"
#include <stdio.h>

static PetscErrorCode IsRoot(const Checkpoints *k, PetscBool *root)
{
  PetscMPIInt rank;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(k->comm, &rank));
  *root = rank ? PETSC_FALSE : PETSC_TRUE;
  PetscFunctionReturn(0);
}

PetscErrorCode CheckpointsCreate(MPI_Comm comm, Server server, const CouplerCase *c, Checkpoints *k)
{
  PetscFunctionBeginUser;
  *k = (Checkpoints){.comm = comm,
                     .server = server,
                     .folder = c->run.folder,
                     .every = c->run.checkpoint,
                     .last = MPI_Wtime()};
  CheckpointFolderRun(k->run);
  PetscFunctionReturn(0);
}

PetscErrorCode CheckpointsRequest(Checkpoints *k, long long steps, double t, PetscBool end)
{
  PetscBool root;
  int due;

  PetscFunctionBeginUser;
  if (k->every <= 0.0 || k->impossible) PetscFunctionReturn(0);
  PetscCall(IsRoot(k, &root));
  due = end || MPI_Wtime() - k->last >= k->every;
  PetscCallMPI(MPI_Bcast(&due, 1, MPI_INT, 0, k->comm));
  k->rejected = PETSC_FALSE;
  if (!due) PetscFunctionReturn(0);
  snprintf(k->due, sizeof k->due, "%s/" CORACLE_CHECKPOINT ".%lld", k->folder, steps);
  if (root) PetscCall(CheckpointFolderMake(k->due, k->run, steps, t));
  PetscCallMPI(MPI_Barrier(k->comm)); /* the folder exists before a client is told to save there */
  PetscCall(ServerSave(k->server, k->due));
  PetscFunctionReturn(0);
}

void CheckpointsReject(Checkpoints *k)
{
  k->rejected = PETSC_TRUE;
}

PetscErrorCode CheckpointsFinish(Checkpoints *k)
{
  PetscBool root;

  PetscFunctionBeginUser;
  if (!k->due[0]) PetscFunctionReturn(0);
  PetscCall(IsRoot(k, &root));
  const char *unsaved = ServerUnsaved(k->server);
  k->impossible = (PetscBool)(unsaved && !k->rejected);
  if (k->impossible && root) fprintf(stderr, "coracle: note: no checkpoints: the %s saves none\n", unsaved);
  if (unsaved && root) CheckpointFolderRemove(k->due);
  if (!unsaved && root) PetscCall(CheckpointFolderPublish(k->due));
  if (!unsaved) k->last = MPI_Wtime();
  k->due[0] = 0;
  PetscFunctionReturn(0);
}
