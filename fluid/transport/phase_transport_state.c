/* The phases' state: to another mesh, back to the step's start, to and from a checkpoint. */
#include "common/mesh/mesh_checkpoint.h"
#include "fluid/transport/phase_transport_impl.h"

static void GetSolid(PhaseTransport t, double field[][SOLID_FIELDS])
{
  const double *solid = PhasesSolid(t->phases);
  const char *moves = PhaseTensionMoves(t->tension);
  for (int e = 0; e < t->stars->ne; e++) {
    field[e][SOLID] = solid ? solid[e] : 0.0;
    field[e][MOVING] = moves && moves[e] ? field[e][SOLID] : 0.0;
  }
}

static PetscErrorCode SetSolid(PhaseTransport t, const double field[][SOLID_FIELDS])
{
  double *alpha;
  char *moves;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(t->stars->ne, &alpha, t->stars->ne, &moves));
  for (int e = 0; e < t->stars->ne; e++) {
    alpha[e] = field[e][SOLID];
    moves[e] = field[e][MOVING] > 0.5 * field[e][SOLID];
  }
  PetscCall(PhaseTransportSetSolid(t, alpha, moves));
  PetscCall(PetscFree2(alpha, moves));
  PetscFunctionReturn(0);
}

/* The solid of `from`, on the mesh of `to`. */
static PetscErrorCode RemapSolid(PhaseTransport from, Transfer transfer, PhaseTransport to)
{
  const int nfrom = from->stars->ne, nto = to->stars->ne;
  double(*old)[SOLID_FIELDS], (*new)[SOLID_FIELDS], (*old_vertex)[SOLID_FIELDS][3],
      (*new_vertex)[SOLID_FIELDS][3];
  PetscFunctionBeginUser;
  if (!PhasesSolid(from->phases)) PetscFunctionReturn(0);
  PetscCall(PetscMalloc4(nfrom, &old, nto, &new, nfrom, &old_vertex, nto, &new_vertex));
  GetSolid(from, old);
  for (int e = 0; e < nfrom; e++)
    for (int k = 0; k < SOLID_FIELDS; k++)
      for (int i = 0; i < 3; i++) old_vertex[e][k][i] = old[e][k];
  PetscCall(TransferP1DG(transfer, SOLID_FIELDS, (const double *)old_vertex, (double *)new_vertex));
  for (int e = 0; e < nto; e++)
    for (int k = 0; k < SOLID_FIELDS; k++)
      new[e][k] = (new_vertex[e][k][0] + new_vertex[e][k][1] + new_vertex[e][k][2]) / 3.0;
  PetscCall(SetSolid(to, (const double(*)[SOLID_FIELDS]) new));
  PetscCall(PetscFree4(old, new, old_vertex, new_vertex));
  PetscFunctionReturn(0);
}

PetscErrorCode PhaseTransportRemap(PhaseTransport from, Transfer transfer, PhaseTransport to)
{
  PetscFunctionBeginUser;
  PetscCall(PhasesRemap(from->phases, transfer, to->phases));
  PetscCall(RemapSolid(from, transfer, to));
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
  GetSolid(t, t->saved_solid);
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
  if (PhasesSolid(t->phases)) PetscCall(SetSolid(t, (const double(*)[SOLID_FIELDS])t->saved_solid));
  PetscCall(PhaseTransportReconstruct(t));
  PetscFunctionReturn(0);
}

/* --- checkpoints ---------------------------------------------------------------------------------------- */

/* What a checkpoint says of a phase: its name, a letter a column, and whether it is compressible. */
enum { NAME_LENGTH = sizeof((PhaseProperties *)NULL)->name[0], DESCRIPTION = NAME_LENGTH + 1 };

static void Describe(const PhaseProperties *p, int k, long long row[DESCRIPTION])
{
  memset(row, 0, DESCRIPTION * sizeof *row);
  for (int i = 0; i < NAME_LENGTH && p->name[k][i]; i++) row[i] = (unsigned char)p->name[k][i];
  row[NAME_LENGTH] = p->state[k].pressure > 0.0;
}

static PetscErrorCode SaveDescriptions(PhaseTransport t, PetscBool first_rank, Checkpoint to)
{
  long long row[PHASES_MAX][DESCRIPTION];
  PetscFunctionBeginUser;
  for (int k = 0; k < t->properties.n; k++) Describe(&t->properties, k, row[k]);
  PetscCall(
      CheckpointPutIndices(to, "phases' names", first_rank ? t->properties.n : 0, DESCRIPTION, &row[0][0]));
  PetscFunctionReturn(0);
}

/* column[n]: of a checkpoint's tables, where the phases are.  Their order is that of the case, or of densities, which may be others now. */
static PetscErrorCode FindColumns(PhaseTransport t, Checkpoint from, int column[])
{
  const int n = t->properties.n;
  long long saved[PHASES_MAX][DESCRIPTION], own[DESCRIPTION];
  PetscFunctionBeginUser;
  PetscCall(CheckpointGetIndices(from, "phases' names", 0, n, DESCRIPTION, &saved[0][0]));
  for (int k = 0; k < n; k++) {
    const char *name = t->properties.name[k];
    Describe(&t->properties, k, own);
    int i = 0; /* its own place first: so phases without names keep theirs */
    while (i < n && memcmp(own, saved[(k + i) % n], NAME_LENGTH * sizeof *own)) i++;
    PetscCheck(i < n, PETSC_COMM_SELF, PETSC_ERR_FILE_UNEXPECTED,
               "fluid.phases: expected the names of the phases in %s/fluid.h5, where '%s' is none",
               CheckpointFolder(from), name);
    column[k] = (k + i) % n;
    PetscCheck(own[NAME_LENGTH] == saved[column[k]][NAME_LENGTH], PETSC_COMM_SELF, PETSC_ERR_FILE_UNEXPECTED,
               "fluid.phases: expected '%s' %s gas or sound_speed, as in %s/fluid.h5", name,
               saved[column[k]][NAME_LENGTH] ? "with" : "without", CheckpointFolder(from));
  }
  PetscFunctionReturn(0);
}

/* value[rows][n]: from the checkpoint's columns to the phases'. */
static void SortColumns(int rows, int n, const int column[], double value[])
{
  for (int r = 0; r < rows; r++) {
    double saved[PHASES_MAX];
    for (int k = 0; k < n; k++) saved[k] = value[r * n + k];
    for (int k = 0; k < n; k++) value[r * n + k] = saved[column[k]];
  }
}

PetscErrorCode PhaseTransportSave(PhaseTransport t, Checkpoint to)
{
  int n;
  const double *volume = PhaseTransportVolumes(t, &n);
  double(*solid)[SOLID_FIELDS];
  PetscMPIInt rank;
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(t->domain->mesh->comm, &rank));
  PetscCall(PetscMalloc1(t->stars->ne, &solid));
  PetscCall(SaveDescriptions(t, (PetscBool)(rank == 0), to));
  GetSolid(t, solid);
  PetscCall(CheckpointPutDoubles(to, "solid", t->stars->ne, SOLID_FIELDS, (const double *)solid));
  PetscCall(PetscFree(solid));
  PetscCall(CheckpointPutDoubles(to, "phases", t->stars->ne, n, volume));
  if (PhasesMasses(t->phases))
    PetscCall(CheckpointPutDoubles(to, "phases' masses", t->stars->ne, n, PhasesMasses(t->phases)));
  PetscCall(CheckpointPutDoubles(to, "initial phases", rank ? 0 : 1, n, t->budget.initial));
  PetscCall(CheckpointPutDoubles(to, "phases out", rank ? 0 : 1, n, t->budget.out));
  PetscFunctionReturn(0);
}

PetscErrorCode PhaseTransportLoad(PhaseTransport t, const PetscInt row[], Checkpoint from)
{
  const int n = t->properties.n;
  double *volume, (*solid)[SOLID_FIELDS];
  int column[PHASES_MAX];
  PetscFunctionBeginUser;
  PetscCall(FindColumns(t, from, column));
  PetscCall(PetscMalloc1(t->stars->ne, &solid));
  PetscCall(MeshLoadDoubles(t->domain->mesh, row, from, "solid", SOLID_FIELDS, (double *)solid));
  PetscCall(SetSolid(t, (const double(*)[SOLID_FIELDS])solid));
  PetscCall(PetscFree(solid));
  PetscCall(PetscMalloc1((size_t)n * (size_t)t->stars->ne, &volume));
  PetscCall(MeshLoadDoubles(t->domain->mesh, row, from, "phases", n, volume));
  SortColumns(t->stars->ne, n, column, volume);
  PetscCall(PhasesSetVolumes(t->phases, volume));
  PetscCall(PetscFree(volume));
  if (PhasesMasses(t->phases)) {
    PetscCall(MeshLoadDoubles(t->domain->mesh, row, from, "phases' masses", n, PhasesMasses(t->phases)));
    SortColumns(t->stars->ne, n, column, PhasesMasses(t->phases));
  }
  PetscCall(CheckpointGetDoubles(from, "initial phases", 0, 1, n, t->budget.initial));
  PetscCall(CheckpointGetDoubles(from, "phases out", 0, 1, n, t->budget.out));
  SortColumns(1, n, column, t->budget.initial);
  SortColumns(1, n, column, t->budget.out);
  PetscCall(PhaseTransportReconstruct(t));
  PetscFunctionReturn(0);
}
