#include "fluid/continuous_space.h"
#include "fluid/solver_options.h"
#include "fluid/vertices.h"

enum { FACTOR, MULTIGRID, NSOLVERS };

struct ContinuousSpace_s {
  const Mesh *mesh; /* borrowed */
  int *node;        /* [ne][3] local P1 nodes: owned first, then those of other ranks */
  Mat matrix;
  PC pc[NSOLVERS]; /* made when used first */
  PC used;
  Vec residual, correction; /* ghosted, of one component */
};

/* Vectors, and local nodes of the elements. */
static PetscErrorCode CreateNodes(ContinuousSpace s, PetscInt owned, const double number[])
{
  const Mesh *m = s->mesh;
  PetscInt nghosts = 0, *ghosts, n = 0;
  int *local;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(m->np2, &local, m->np2 - m->np2_owned, &ghosts));
  for (int k = 0; k < m->np2_owned; k++) local[k] = number[k] >= 0.0 ? (int)n++ : -1;
  for (int k = m->np2_owned; k < m->np2; k++) {
    local[k] = number[k] >= 0.0 ? (int)(owned + nghosts) : -1;
    if (number[k] >= 0.0) ghosts[nghosts++] = (PetscInt)number[k];
  }
  for (int k = 0; k < 3 * m->ne; k++) s->node[k] = local[m->p2[6 * (k / 3) + k % 3]];
  PetscCall(VecCreateGhost(m->comm, owned, PETSC_DETERMINE, nghosts, ghosts, &s->residual));
  PetscCall(VecDuplicate(s->residual, &s->correction));
  PetscCall(PetscFree2(local, ghosts));
  PetscFunctionReturn(0);
}

/* An entry of the matrix for each entry of each block. */
static PetscErrorCode CreateMatrix(ContinuousSpace s, PetscInt owned, const double number[])
{
  const Mesh *m = s->mesh;
  PetscInt *row, *column;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(9 * m->ne, &row, 9 * m->ne, &column));
  for (int e = 0; e < m->ne; e++)
    for (int k = 0; k < 9; k++) {
      row[9 * e + k] = (PetscInt)number[m->p2[6 * e + k % 3]];
      column[9 * e + k] = (PetscInt)number[m->p2[6 * e + k / 3]];
    }
  PetscCall(MatCreate(m->comm, &s->matrix));
  PetscCall(MatSetSizes(s->matrix, owned, owned, PETSC_DETERMINE, PETSC_DETERMINE));
  PetscCall(MatSetType(s->matrix, MATAIJ));
  PetscCall(MatSetPreallocationCOO(s->matrix, 9 * m->ne, row, column));
  PetscCall(PetscFree2(row, column));
  PetscFunctionReturn(0);
}

PetscErrorCode ContinuousSpaceCreate(const Mesh *mesh, ContinuousSpace *space)
{
  ContinuousSpace s;
  PetscInt owned;
  double *number;
  PetscFunctionBeginUser;
  PetscCall(PetscNew(&s));
  s->mesh = mesh;
  PetscCall(PetscMalloc1(3 * mesh->ne, &s->node));
  PetscCall(PetscMalloc1(mesh->np2, &number));
  PetscCall(VerticesNumber(mesh, &owned, number));
  PetscCall(CreateNodes(s, owned, number));
  PetscCall(CreateMatrix(s, owned, number));
  PetscCall(PetscFree(number));
  *space = s;
  PetscFunctionReturn(0);
}

PetscErrorCode ContinuousSpaceDestroy(ContinuousSpace *space)
{
  ContinuousSpace s = *space;
  PetscFunctionBeginUser;
  if (!s) PetscFunctionReturn(0);
  for (int k = 0; k < NSOLVERS; k++) PetscCall(PCDestroy(&s->pc[k]));
  PetscCall(MatDestroy(&s->matrix));
  PetscCall(VecDestroy(&s->residual));
  PetscCall(VecDestroy(&s->correction));
  PetscCall(PetscFree(s->node));
  PetscCall(PetscFree(*space));
  PetscFunctionReturn(0);
}

static PetscErrorCode CreateSolver(ContinuousSpace s, int kind)
{
  PetscMPIInt size;
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_size(s->mesh->comm, &size));
  PetscCall(PCCreate(s->mesh->comm, &s->pc[kind]));
  PetscCall(PCSetOptionsPrefix(s->pc[kind], kind == MULTIGRID ? "momentum_multigrid_" : "momentum_factor_"));
  if (kind == FACTOR)
    PetscCall(PCSetType(s->pc[kind], size == 1 ? PCILU : PCBJACOBI));
  else {
#if defined(PETSC_HAVE_HYPRE)
    PetscCall(PCSetType(s->pc[kind], PCHYPRE));
    PetscCall(PCHYPRESetType(s->pc[kind], "boomeramg"));
#else
    PetscCall(PCSetType(s->pc[kind], PCGAMG));
#endif
  }
  PetscCall(PCSetOperators(s->pc[kind], s->matrix, s->matrix));
  PetscCall(PCSetFromOptions(s->pc[kind]));
  PetscFunctionReturn(0);
}

PetscErrorCode ContinuousSpaceUpdate(ContinuousSpace s, PetscBool multigrid, const double block[][9])
{
  const int kind = multigrid ? MULTIGRID : FACTOR;
  PetscFunctionBeginUser;
  PetscCall(MatSetValuesCOO(s->matrix, block[0], INSERT_VALUES));
  if (!s->pc[kind]) PetscCall(CreateSolver(s, kind));
  s->used = s->pc[kind];
  PetscCall(PCSetUp(s->used));
  PetscFunctionReturn(0);
}

static PetscErrorCode Restrict(ContinuousSpace s, int component, const double r[])
{
  PetscScalar *v;
  Vec local;
  PetscFunctionBeginUser;
  PetscCall(VecGhostGetLocalForm(s->residual, &local));
  PetscCall(VecSet(local, 0.0));
  PetscCall(VecGetArray(local, &v));
  for (int e = 0; e < s->mesh->ne; e++)
    for (int i = 0; i < 3; i++) v[s->node[3 * e + i]] += r[6 * e + 3 * component + i];
  PetscCall(VecRestoreArray(local, &v));
  PetscCall(VecGhostRestoreLocalForm(s->residual, &local));
  PetscCall(VecGhostUpdateBegin(s->residual, ADD_VALUES, SCATTER_REVERSE));
  PetscCall(VecGhostUpdateEnd(s->residual, ADD_VALUES, SCATTER_REVERSE));
  PetscFunctionReturn(0);
}

static PetscErrorCode Extend(ContinuousSpace s, int component, double z[])
{
  const PetscScalar *v;
  Vec local;
  PetscFunctionBeginUser;
  PetscCall(VecGhostUpdateBegin(s->correction, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecGhostUpdateEnd(s->correction, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecGhostGetLocalForm(s->correction, &local));
  PetscCall(VecGetArrayRead(local, &v));
  for (int e = 0; e < s->mesh->ne; e++)
    for (int i = 0; i < 3; i++) z[6 * e + 3 * component + i] += v[s->node[3 * e + i]];
  PetscCall(VecRestoreArrayRead(local, &v));
  PetscCall(VecGhostRestoreLocalForm(s->correction, &local));
  PetscFunctionReturn(0);
}

PetscErrorCode ContinuousSpaceCorrect(ContinuousSpace s, const double r[], double z[])
{
  PetscFunctionBeginUser;
  for (int c = 0; c < 2; c++) {
    PetscCall(Restrict(s, c, r));
    PetscCall(PCApply(s->used, s->residual, s->correction));
    PetscCall(Extend(s, c, z));
  }
  PetscFunctionReturn(0);
}
