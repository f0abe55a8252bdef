// ranks: 1 2 3
/* A flow under a lid, beside an open side under pressure, on a mesh that adapts, also to a solid that is faster and faster, resumes from
 * checkpoints as if nothing had happened: to the last bit where a run repeats itself, which PETSc's sums over
 * three ranks or more do not (they are made as messages arrive); to the solvers' tolerance on any ranks. */
#include "common/mesh/mesh_checkpoint.h"
#include "common/supermesh/geometry.h"
#include "tests/fluid/adapting.h"
#include "tests/fluid/exact.h"
#include "tests/remove_folder.h"
#include <string.h>
#include <unistd.h>

#define DT 0.005
#define LAST 14
static const int SAVED[3] = {5, 8, 10}; /* after so many steps */
/* The mesh adapts at first, when it is time, and when the solid leaves its band. */
static const unsigned ADAPTS = 1u << 1 | 1u << 8 | 1u << 13;
static char folder[256];

typedef struct {
  Mesh *mesh;
  Fluid fluid;
  Adaptation adaptation;
  PetscBool new_mesh;
  unsigned adapted; /* bit k: in the k-th step */
} RunState;

static PetscErrorCode Create(Mesh *mesh, RunState *m)
{
  const AdaptationSetup adaptation = {.size_min = 0.02,
                                      .corner_size = 0.02,
                                      .size_max = 0.3,
                                      .velocity_error = 0.02,
                                      .growth = 1.5,
                                      .anisotropy = 5.0,
                                      .elements_max = 1e5,
                                      .every = 7};
  Boundary boundary[4] = {0};
  const FluidSetup fluid = {
      .theta = 0.5, .rho = RHO, .mu = MU, .cfl = 0.5, .dt_max = 1.0, .boundary = boundary};
  const int top = MeshTagIndex(mesh, "top"), right = MeshTagIndex(mesh, "right");
  PetscFunctionBeginUser;
  CHECK(mesh->ntags == 4 && top >= 0 && right >= 0, "%d boundaries", mesh->ntags);
  boundary[top].velocity[0] = 1.0;
  boundary[top].rise = 0.06;
  boundary[right].kind = BOUNDARY_OPEN;
  boundary[right].pressure = 0.3;
  memset(m, 0, sizeof *m);
  m->mesh = mesh;
  PetscCall(FluidCreate(mesh, &fluid, &m->fluid));
  PetscCall(AdaptationCreate(&adaptation, &m->adaptation));
  PetscFunctionReturn(0);
}

static PetscErrorCode Destroy(RunState *m)
{
  PetscFunctionBeginUser;
  PetscCall(AdaptationDestroy(&m->adaptation));
  PetscCall(FluidDestroy(&m->fluid));
  PetscCall(MeshDestroy(&m->mesh));
  PetscFunctionReturn(0);
}

/* A piece of shell that exerts no force; only the mesh adaptation uses it.  At rest at first. */
static PetscErrorCode SetSolid(RunState *m)
{
  const double x[2] = {0.6123, 0.4371}, speed = 30.0 * FluidGetStats(m->fluid)->t;
  CoracleCoupling k = {.flags = CORACLE_HAS_SHELL, .shell = 0.1, .velocity = {speed, 0.0}};
  int n = 0;
  PetscFunctionBeginUser;
  for (int e = 0; e < m->mesh->ne; e++) {
    const double *v[3];
    for (int i = 0; i < 3; i++) v[i] = m->mesh->x + 2 * m->mesh->vertex[3 * e + i];
    if (GeometryTurn(v[0], v[1], x) < 0.0 || GeometryTurn(v[1], v[2], x) < 0.0 ||
        GeometryTurn(v[2], v[0], x) < 0.0)
      continue;
    k.element = e;
    n = 1;
  }
  PetscCall(FluidSetCoupling(m->fluid, n, &k));
  PetscFunctionReturn(0);
}

static PetscErrorCode Step(RunState *m)
{
  PetscFunctionBeginUser;
  PetscCall(SetSolid(m));
  PetscCall(AdaptingStep(m->adaptation, DT, FluidTransfer, &m->mesh, &m->fluid, &m->new_mesh));
  if (m->new_mesh) m->adapted |= 1u << (int)(FluidGetStats(m->fluid)->t / DT + 0.5);
  PetscFunctionReturn(0);
}

/* --- checkpoints ---------------------------------------------------------------------------------------- */

static PetscErrorCode Open(MPI_Comm comm, int step, PetscBool write, Checkpoint *c)
{
  char name[32];
  PetscFunctionBeginUser;
  snprintf(name, sizeof name, "step_%d", step);
  PetscCall((write ? CheckpointCreate : CheckpointOpen)(comm, folder, name, c));
  PetscFunctionReturn(0);
}

static PetscErrorCode Save(const RunState *m, int step)
{
  Checkpoint to;
  PetscFunctionBeginUser;
  PetscCall(Open(m->mesh->comm, step, PETSC_TRUE, &to));
  PetscCall(MeshSave(m->mesh, to));
  PetscCall(FluidSave(m->fluid, to));
  PetscCall(AdaptationSave(m->adaptation, to));
  PetscCall(CheckpointPutNumber(to, "new mesh", m->new_mesh));
  PetscCall(CheckpointClose(&to));
  PetscFunctionReturn(0);
}

/* *row: NULL, or where to leave the rows of the elements. */
static PetscErrorCode Load(MPI_Comm comm, int step, RunState *m, PetscInt **row)
{
  Checkpoint from;
  Mesh *mesh;
  PetscInt *rows;
  double new_mesh;
  PetscFunctionBeginUser;
  PetscCall(Open(comm, step, PETSC_FALSE, &from));
  PetscCall(MeshLoad(comm, from, &mesh, &rows));
  PetscCall(Create(mesh, m));
  PetscCall(FluidLoad(m->fluid, rows, from));
  PetscCall(AdaptationLoad(m->adaptation, from));
  PetscCall(CheckpointGetNumber(from, "new mesh", &new_mesh));
  m->new_mesh = new_mesh != 0.0;
  PetscCall(CheckpointClose(&from));
  if (row)
    *row = rows;
  else
    PetscCall(PetscFree(rows));
  PetscFunctionReturn(0);
}

/* --- comparisons ---------------------------------------------------------------------------------------- */

#define SAME(a, b, n) (!memcmp(a, b, (size_t)(n) * sizeof *(a)))

static void CheckSame(const RunState *a, const RunState *b, int step)
{
  const Mesh *m = a->mesh, *n = b->mesh;
  CHECK(m->ne == n->ne && m->nv == n->nv, "from step %d: %d triangles instead of %d", step, n->ne, m->ne);
  CHECK(SAME(m->x, n->x, 2 * m->nv) && SAME(m->vertex, n->vertex, 3 * m->ne), "from step %d: the mesh", step);
  CHECK(SAME(FluidVelocity(a->fluid), FluidVelocity(b->fluid), 6 * m->ne), "from step %d: velocity", step);
  CHECK(SAME(FluidPressure(a->fluid), FluidPressure(b->fluid), FluidPressureSpace(a->fluid)->n),
        "from step %d: pressure", step);
  CHECK(FluidGetStats(a->fluid)->t == FluidGetStats(b->fluid)->t, "from step %d: time", step);
}

/* Largest difference by largest value. */
static PetscErrorCode Difference(MPI_Comm comm, int n, const double a[], const double b[], double *relative)
{
  double largest[2] = {0.0};
  PetscFunctionBeginUser;
  for (int k = 0; k < n; k++) {
    largest[0] = fmax(largest[0], fabs(a[k] - b[k]));
    largest[1] = fmax(largest[1], fabs(a[k]));
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, largest, 2, MPI_DOUBLE, MPI_MAX, comm));
  *relative = largest[0] / largest[1];
  PetscFunctionReturn(0);
}

/* The ranks of comm go on where all have saved, to where all have saved again on the same mesh. */
static PetscErrorCode CheckAgrees(MPI_Comm comm, int from, int to)
{
  RunState m;
  Checkpoint later;
  PetscInt *row;
  double *u, *p, *mine, du, dp;
  PetscFunctionBeginUser;
  PetscCall(Load(comm, from, &m, &row));
  for (int step = from; step < to; step++) PetscCall(Step(&m));
  CHECK(!m.adapted, "new meshes in steps %x", m.adapted);
  const int n = 6 * m.mesh->ne;
  PetscCall(PetscMalloc3(n, &u, n, &p, n, &mine));
  PetscCall(Open(comm, to, PETSC_FALSE, &later));
  PetscCall(MeshLoadDoubles(m.mesh, row, later, "velocity", 6, u));
  PetscCall(MeshLoadDoubles(m.mesh, row, later, "pressure", 6, p));
  PetscCall(CheckpointClose(&later));
  for (int k = 0; k < n; k++) mine[k] = FluidPressure(m.fluid)[FluidPressureSpace(m.fluid)->node[k]];
  PetscCall(Difference(comm, n, u, FluidVelocity(m.fluid), &du));
  PetscCall(Difference(comm, n, p, mine, &dp));
  CHECK(du < 1e-9 && dp < 1e-9, "after step %d differs by %g in velocity, %g in pressure", to, du, dp);
  PetscCall(PetscFree3(u, p, mine));
  PetscCall(PetscFree(row));
  PetscCall(Destroy(&m));
  PetscFunctionReturn(0);
}

/* As many ranks as have saved; `repeats`: a run repeats itself. */
static PetscErrorCode CheckTogether(PetscBool repeats, const RunState *uninterrupted, int step,
                                    const FluidStats *then)
{
  RunState m;
  PetscFunctionBeginUser;
  PetscCall(Load(PETSC_COMM_WORLD, step, &m, NULL));
  CHECK(SAME(then->seconds, FluidGetStats(m.fluid)->seconds, 6), "seconds after step %d", step);
  const double dt = FluidTimeStep(m.fluid);
  CHECK(m.mesh->ne == 0 || (dt > 0.0 && dt < 1.0), "step %d proposes a step of %g s", step, dt);
  for (int k = step; k < LAST; k++) PetscCall(Step(&m));
  CHECK(m.adapted == ADAPTS >> (step + 1) << (step + 1), "from step %d: new meshes in steps %x", step,
        m.adapted);
  if (repeats) CheckSame(uninterrupted, &m, step);
  PetscCall(Destroy(&m));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  FluidStats then[3];
  RunState m;
  Mesh *mesh;
  Exact exact = {0.0};
  PetscMPIInt rank, size;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(PetscOptionsSetValue(NULL, "-momentum_ksp_rtol", "1e-12"));
  PetscCallMPI(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  PetscCallMPI(MPI_Comm_size(PETSC_COMM_WORLD, &size));
  snprintf(folder, sizeof folder, "/tmp/coracle_fluid_%d", (int)getpid());
  PetscCallMPI(MPI_Bcast(folder, sizeof folder, MPI_CHAR, 0, PETSC_COMM_WORLD));
  if (rank == 0) PetscCall(PetscMkdir(folder));
  PetscCall(SquareMesh(0.1, &mesh));
  PetscCall(Create(mesh, &m));
  PetscCall(FluidSetInitial(m.fluid, 0.0, ExactVelocity, NULL, &exact));
  for (int step = 1, saved = 0; step <= LAST; step++) {
    PetscCall(Step(&m));
    if (saved == 3 || step != SAVED[saved]) continue;
    then[saved++] = *FluidGetStats(m.fluid);
    PetscCall(Save(&m, step));
  }
  CHECK(m.adapted == ADAPTS, "new meshes in steps %x", m.adapted);
  for (int k = 0; k < 3; k++) PetscCall(CheckTogether(size <= 2, &m, SAVED[k], &then[k]));
  PetscCall(CheckAgrees(PETSC_COMM_WORLD, SAVED[1], SAVED[2]));
  if (rank == 0) PetscCall(CheckAgrees(PETSC_COMM_SELF, SAVED[1], SAVED[2]));
  PetscCall(Destroy(&m));
  PetscCallMPI(MPI_Barrier(PETSC_COMM_WORLD));
  if (rank == 0) RemoveFolder(folder);
  PetscCall(PetscFinalize());
  return 0;
}
