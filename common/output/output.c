/* Layout of <name>.h5:
 *
 *   /snapshot/000000                 attribute time, s
 *             /<grid>/points         [n][2] m
 *                    /cells          [ne][nodes_per_cell] indices of points
 *                    /node/<field>   [n], [n][3] or [n][6], attribute unit; rounded to 31 significant bits
 *                    /cell/<field>   [ne], ...
 *
 * Every snapshot is complete in itself: points and cells that have not changed are links to the earlier ones.
 */
#include "common/output/folder.h"
#include "common/output/output_impl.h"
#include "common/output/time_reached.h"
#include <string.h>

/* Snapshots after which what HDF5 keeps of them in memory is let go: time and memory stay flat. */
enum { REOPEN = 32 };

static PetscErrorCode BeginFile(Output o, const char *path)
{
  PetscFunctionBeginUser;
  PetscCall(Hdf5Create(o->comm, path, HDF5_SNAPSHOTS, &o->file));
  PetscCall(Hdf5Group(o->file, "/snapshot"));
  PetscCall(Hdf5Flush(o->file));
  PetscFunctionReturn(0);
}

/* Takes away the snapshots that were made after the checkpoint. */
static PetscErrorCode CutLater(Output o)
{
  char later[PATH];
  PetscFunctionBeginUser;
  for (long long k = o->nsnapshot;; k++) {
    snprintf(later, sizeof later, "/snapshot/%06lld", k);
    if (!Hdf5Has(o->file, later)) break;
    PetscCall(Hdf5Remove(o->file, later));
  }
  o->later = PETSC_FALSE;
  PetscFunctionReturn(0);
}

PetscErrorCode OutputCreate(MPI_Comm comm, const char *folder, const char *name, double every, double end,
                            Checkpoint from, Output *out)
{
  Output o;
  char path[PETSC_MAX_PATH_LEN];
  double snapshots = 0.0;
  PetscFunctionBeginUser;
  PetscCall(FolderMake(comm, folder));
  PetscCall(PetscNew(&o));
  PetscCallMPI(MPI_Comm_dup(comm, &o->comm));
  PetscCallMPI(MPI_Comm_rank(comm, &o->rank));
  o->every = every;
  o->end = end;
  if (from) PetscCall(CheckpointGetNumber(from, "output last", &o->last));
  if (from) o->next = TimeNext(o->last, every); /* that of this run */
  snprintf(path, sizeof path, "%s/%s.h5", folder, name);
  PetscCall(PetscStrncpy(o->path, path, sizeof o->path));
  if (FolderGoesOn(comm, folder, path, from)) {
    PetscCall(CheckpointGetNumber(from, "output snapshots", &snapshots));
    o->nsnapshot = (long long)snapshots;
    PetscCall(Hdf5Open(o->comm, path, PETSC_TRUE, &o->file));
    o->later = PETSC_TRUE;
  } else {
    PetscCall(BeginFile(o, path));
  }
  PetscCall(AgreeWithRoot(comm, o->rank == 0 ? XdmfCreate(folder, name, o->nsnapshot, &o->xdmf) : 0));
  *out = o;
  PetscFunctionReturn(0);
}

PetscErrorCode OutputText(Output o, const char *name, const char *text)
{
  PetscFunctionBeginUser;
  if (!Hdf5HasAttribute(o->file, "/", name)) PetscCall(Hdf5Text(o->file, "/", name, text));
  PetscFunctionReturn(0);
}

PetscErrorCode OutputSave(Output o, Checkpoint to)
{
  PetscFunctionBeginUser;
  PetscCheck(!o->open, o->comm, PETSC_ERR_ORDER, "OutputSave: the last snapshot has no OutputEnd");
  PetscCall(CheckpointPutNumber(to, "output last", o->last));
  PetscCall(CheckpointPutNumber(to, "output snapshots", (double)o->nsnapshot));
  PetscFunctionReturn(0);
}

PetscBool OutputDue(Output o, double t)
{
  return (PetscBool)TimeReached(t, PetscMin(o->next, o->end));
}

PetscErrorCode OutputBegin(Output o, double t)
{
  char path[PATH];
  PetscFunctionBeginUser;
  PetscCheck(!o->open, o->comm, PETSC_ERR_ORDER, "OutputBegin: the last snapshot has no OutputEnd");
  o->open = PETSC_TRUE;
  o->last = t;
  o->next = TimeNext(t, o->every);
  o->current = -1;
  if (o->later) PetscCall(CutLater(o));
  snprintf(path, sizeof path, "/snapshot/%06lld", o->nsnapshot);
  PetscCall(Hdf5Group(o->file, path));
  PetscCall(Hdf5Attribute(o->file, path, "time", t));
  if (o->rank == 0) PetscCall(XdmfBegin(o->xdmf, t));
  PetscFunctionReturn(0);
}

PetscErrorCode OutputEnd(Output o)
{
  PetscFunctionBeginUser;
  PetscCheck(o->open, o->comm, PETSC_ERR_ORDER, "OutputEnd without OutputBegin");
  PetscCall(Hdf5Flush(o->file)); /* the index comes after what it points to */
  PetscCall(AgreeWithRoot(o->comm, o->rank == 0 ? XdmfEnd(o->xdmf) : 0));
  o->nsnapshot++;
  o->open = PETSC_FALSE;
  if (o->nsnapshot % REOPEN == 0) {
    PetscCall(Hdf5Close(&o->file));
    PetscCall(Hdf5Open(o->comm, o->path, PETSC_TRUE, &o->file));
  }
  PetscFunctionReturn(0);
}

PetscErrorCode OutputDestroy(Output *out)
{
  PetscFunctionBeginUser;
  if (!*out) PetscFunctionReturn(0);
  PetscCall(Hdf5Close(&(*out)->file));
  PetscCall(XdmfDestroy(&(*out)->xdmf));
  PetscCallMPI(MPI_Comm_free(&(*out)->comm));
  PetscCall(PetscFree(*out));
  PetscFunctionReturn(0);
}
