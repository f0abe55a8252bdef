/* The state of the fluid in a checkpoint and out of it: tables with a row an element, in the order of the
 * elements' global numbers, as in mesh_checkpoint.h. */
#include "common/mesh/mesh_checkpoint.h"
#include "fluid/discretization/ghosted.h"
#include "fluid/flow/fluid_impl.h"

#define PHASES ((int)(sizeof((FluidStats *)NULL)->seconds / sizeof(double)))

static PetscErrorCode SaveVelocity(Vec velocity, int ne, const char *name, Checkpoint to)
{
  const PetscScalar *u;
  PetscFunctionBeginUser;
  PetscCall(VecGetArrayRead(velocity, &u));
  PetscCall(CheckpointPutDoubles(to, name, ne, 6, u));
  PetscCall(VecRestoreArrayRead(velocity, &u));
  PetscFunctionReturn(0);
}

static PetscErrorCode LoadVelocity(Fluid f, const PetscInt row[], Checkpoint from, const char *name,
                                   Vec velocity)
{
  PetscScalar *u;
  PetscFunctionBeginUser;
  PetscCall(VecGetArrayWrite(velocity, &u));
  PetscCall(MeshLoadDoubles(f->domain.mesh, row, from, name, 6, u));
  PetscCall(VecRestoreArrayWrite(velocity, &u));
  PetscFunctionReturn(0);
}

static PetscErrorCode SavePressure(Fluid f, Vec pressure, const char *name, Checkpoint to)
{
  const Mesh *m = f->domain.mesh;
  const PetscScalar *p;
  double *nodes;
  PetscFunctionBeginUser;
  PetscCall(GhostedGetArrayRead(pressure, &p));
  PetscCall(PetscMalloc1(6 * m->ne, &nodes));
  for (int k = 0; k < 6 * m->ne; k++) nodes[k] = p[f->domain.p2->node[k]];
  PetscCall(CheckpointPutDoubles(to, name, m->ne, 6, nodes));
  PetscCall(GhostedRestoreArrayRead(pressure, &p));
  PetscCall(PetscFree(nodes));
  PetscFunctionReturn(0);
}

/* Elements of this rank have all of its nodes, also those of other ranks. */
static PetscErrorCode LoadPressure(Fluid f, const PetscInt row[], Checkpoint from, const char *name,
                                   Vec pressure)
{
  const Mesh *m = f->domain.mesh;
  double *nodes;
  PetscScalar *p;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(6 * m->ne, &nodes));
  PetscCall(MeshLoadDoubles(m, row, from, name, 6, nodes));
  PetscCall(GhostedGetArray(pressure, &p));
  for (int k = 0; k < 6 * m->ne; k++) p[f->domain.p2->node[k]] = nodes[k];
  PetscCall(GhostedRestoreArray(pressure, &p));
  PetscCall(PetscFree(nodes));
  PetscFunctionReturn(0);
}

/* At the end of the last step and at the start of the next one (adaptation comes between them). */
static PetscErrorCode SaveMomentum(Fluid f, Checkpoint to)
{
  PetscMPIInt rank;
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(f->domain.mesh->comm, &rank));
  PetscCall(CheckpointPutDoubles(to, "momentum", rank ? 0 : 1, 2, f->budget.momentum));
  PetscCall(CheckpointPutDoubles(to, "starting momentum", rank ? 0 : 1, 2, f->budget_start));
  PetscFunctionReturn(0);
}

PetscErrorCode FluidSave(Fluid f, Checkpoint to)
{
  PetscFunctionBeginUser;
  PetscCall(CheckpointPutNumber(to, "time", f->t));
  PetscCall(CheckpointPutNumber(to, "previous step", f->dt_previous));
  PetscCall(CheckpointPutNumber(to, "damped steps", f->damped));
  PetscCall(CheckpointPutNumber(to, "number of phases", f->setup.phases.n));
  PetscCall(SaveMomentum(f, to));
  PetscCall(SaveVelocity(f->u, f->domain.mesh->ne, "velocity", to));
  PetscCall(SaveVelocity(f->u_previous, f->domain.mesh->ne, "previous velocity", to));
  PetscCall(SavePressure(f, f->p, "pressure", to));
  if (f->phases) {
    PetscCall(SavePressure(f, f->dynamic, "dynamic pressure", to));
    PetscCall(PhaseTransportSave(f->phases, to));
    PetscCall(SaveVelocity(f->bulk, f->domain.mesh->ne, "bulk velocity", to));
    PetscCall(SaveVelocity(f->bulk_previous, f->domain.mesh->ne, "previous bulk velocity", to));
  }
  PetscCall(CheckpointPutDoubles(to, "seconds", 1, PHASES, f->stats.seconds));
  PetscFunctionReturn(0);
}

/* Each rank resumes its own; ranks that the saved run did not have take those of its last one. */
static PetscErrorCode LoadSeconds(Fluid f, Checkpoint from)
{
  long long ranks;
  PetscMPIInt rank;
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(f->domain.mesh->comm, &rank));
  PetscCall(CheckpointRows(from, "seconds", &ranks));
  PetscCall(CheckpointGetDoubles(from, "seconds", PetscMin(rank, ranks - 1), 1, PHASES, f->stats.seconds));
  PetscFunctionReturn(0);
}

static PetscErrorCode CheckPhases(Fluid f, Checkpoint from)
{
  double n;
  PetscFunctionBeginUser;
  PetscCall(CheckpointGetNumber(from, "number of phases", &n));
  PetscCheck((int)n == f->setup.phases.n, PETSC_COMM_SELF, PETSC_ERR_FILE_UNEXPECTED,
             "fluid.phases: expected %d, as in %s/fluid.h5 (0: one fluid), found %d", (int)n,
             CheckpointFolder(from), f->setup.phases.n);
  PetscFunctionReturn(0);
}

PetscErrorCode FluidLoad(Fluid f, const PetscInt row[], Checkpoint from)
{
  double damped;
  PetscFunctionBeginUser;
  PetscCall(CheckPhases(f, from));
  PetscCall(CheckpointGetNumber(from, "time", &f->t));
  PetscCall(CheckpointGetNumber(from, "previous step", &f->dt_previous));
  PetscCall(CheckpointGetNumber(from, "damped steps", &damped));
  f->damped = (int)damped;
  GravityOver(&f->setup.gravity_table, f->t - f->dt_previous, f->dt_previous, f->setup.gravity);
  PetscCall(CheckpointGetDoubles(from, "momentum", 0, 1, 2, f->budget.momentum));
  PetscCall(CheckpointGetDoubles(from, "starting momentum", 0, 1, 2, f->budget_start));
  PetscCall(LoadVelocity(f, row, from, "velocity", f->u));
  PetscCall(LoadVelocity(f, row, from, "previous velocity", f->u_previous));
  PetscCall(LoadPressure(f, row, from, "pressure", f->p));
  if (f->phases) {
    PetscCall(LoadPressure(f, row, from, "dynamic pressure", f->dynamic));
    PetscCall(PhaseTransportLoad(f->phases, row, from));
    if (f->setup.gravity_table.nrows) PetscCall(PhaseTransportSetGravity(f->phases, f->setup.gravity));
    PetscCall(LoadVelocity(f, row, from, "bulk velocity", f->bulk));
    PetscCall(LoadVelocity(f, row, from, "previous bulk velocity", f->bulk_previous));
    PetscCall(FluidPhasesChanged(f));
  }
  /* steps leave it as it is: what the case says of it now counts */
  PetscCall(FluidSetOpenPressure(f, f->t));
  PetscCall(LoadSeconds(f, from));
  PetscCall(VecCopy(f->u, f->u_projected)); /* of which the next step is proposed */
  f->stats.t = f->t;
  PetscFunctionReturn(0);
}
