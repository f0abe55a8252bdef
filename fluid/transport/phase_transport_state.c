/* The phases' state: to another mesh, back to the step's start, to and from a checkpoint. */
#include "common/mesh/mesh_checkpoint.h"
#include "fluid/transport/phase_transport_impl.h"

PetscErrorCode PhaseTransportRemap(PhaseTransport from, Transfer transfer, PhaseTransport to)
{
  PetscFunctionBeginUser;
  PetscCall(PhasesRemap(from->phases, transfer, to->phases));
  PetscCall(PhaseTensionRemap(from->tension, transfer, to->tension));
  to->budget = from->budget;
  PetscCall(PhaseTransportReconstruct(to));
  PetscFunctionReturn(0);
}

PetscErrorCode PhaseTransportSaveState(PhaseTransport t)
{
  const double *volume;
  PetscFunctionBeginUser;
  PetscCall(PhasesGetVolumes(t->phases, &volume));
  PetscCall(PetscArraycpy(t->saved, volume, (size_t)t->properties.n * (size_t)t->stars->ne));
  if (PhasesMasses(t->phases))
    PetscCall(PetscArraycpy(t->saved_mass, PhasesMasses(t->phases),
                            (size_t)t->properties.n * (size_t)t->stars->ne));
  t->saved_budget = t->budget;
  PetscFunctionReturn(0);
}

PetscErrorCode PhaseTransportRestoreState(PhaseTransport t)
{
  PetscFunctionBeginUser;
  PetscCall(PhasesSetVolumes(t->phases, t->saved));
  if (PhasesMasses(t->phases))
    PetscCall(PetscArraycpy(PhasesMasses(t->phases), t->saved_mass,
                            (size_t)t->properties.n * (size_t)t->stars->ne));
  t->budget = t->saved_budget;
  PetscCall(PhaseTransportReconstruct(t));
  PetscFunctionReturn(0);
}

PetscErrorCode PhaseTransportSave(PhaseTransport t, Checkpoint to)
{
  int n;
  const double *volume = PhaseTransportVolumes(t, &n);
  PetscMPIInt rank;
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(t->domain->mesh->comm, &rank));
  PetscCall(CheckpointPutDoubles(to, "phases", t->stars->ne, n, volume));
  if (PhasesMasses(t->phases))
    PetscCall(CheckpointPutDoubles(to, "phases' masses", t->stars->ne, n, PhasesMasses(t->phases)));
  PetscCall(CheckpointPutDoubles(to, "initial phases", rank ? 0 : 1, n, t->budget.initial));
  PetscCall(CheckpointPutDoubles(to, "phases out", rank ? 0 : 1, n, t->budget.out));
  PetscFunctionReturn(0);
}

PetscErrorCode PhaseTransportLoad(PhaseTransport t, const PetscInt row[], Checkpoint from)
{
  double *volume;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1((size_t)t->properties.n * (size_t)t->stars->ne, &volume));
  PetscCall(MeshLoadDoubles(t->domain->mesh, row, from, "phases", t->properties.n, volume));
  PetscCall(PhasesSetVolumes(t->phases, volume));
  PetscCall(PetscFree(volume));
  if (PhasesMasses(t->phases))
    PetscCall(MeshLoadDoubles(t->domain->mesh, row, from, "phases' masses", t->properties.n,
                              PhasesMasses(t->phases)));
  PetscCall(CheckpointGetDoubles(from, "initial phases", 0, 1, t->properties.n, t->budget.initial));
  PetscCall(CheckpointGetDoubles(from, "phases out", 0, 1, t->properties.n, t->budget.out));
  PetscCall(PhaseTransportReconstruct(t));
  PetscFunctionReturn(0);
}
