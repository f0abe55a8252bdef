#include "fluid/momentum/continuous_space.h"
#include "fluid/discretization/assembly.h"
#include "fluid/discretization/ghosted.h"
#include "fluid/discretization/solver_options.h"

enum { FACTOR, MULTIGRID, NSOLVERS };

struct ContinuousSpace_s {
  const Mesh *mesh; /* borrowed */
  int *node;        /* [ne][3] local P1 nodes: owned vertices first, then those of other ranks */
  Mat matrix;
  Assembly assembly;
  PC pc[NSOLVERS]; /* made when used first */
  PC used;
  Vec residual, correction; /* ghosted, of one component */
};

/* Vectors, and local nodes of the elements. */
static PetscErrorCode CreateNodes(ContinuousSpace s)
{
  const Mesh *m = s->mesh;
  PetscInt nghosts = 0, *ghosts;
  int *local;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(m->nv, &local, m->nv, &ghosts));
  for (int v = 0; v < m->nv; v++) local[v] = -1;
  for (int k = 0; k < 3 * m->ne; k++) {
    int *node = &local[m->vertex[k]];
    const PetscInt gid = m->vgid[m->vertex[k]], own = gid - m->vstart;
    if (*node < 0 && own >= 0 && own < m->nv_owned) *node = (int)own;
    if (*node < 0) {
      *node = m->nv_owned + (int)nghosts;
      ghosts[nghosts++] = gid;
    }
    s->node[k] = *node;
  }
  PetscCall(VecCreateGhost(m->comm, m->nv_owned, PETSC_DETERMINE, nghosts, ghosts, &s->residual));
  PetscCall(VecDuplicate(s->residual, &s->correction));
  PetscCall(PetscFree2(local, ghosts));
  PetscFunctionReturn(0);
}

/* An entry of the matrix for each entry of each block. */
static PetscErrorCode CreateMatrix(ContinuousSpace s)
{
  const Mesh *m = s->mesh;
  PetscInt *row, *column;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(9 * m->ne, &row, 9 * m->ne, &column));
  for (int e = 0; e < m->ne; e++)
    for (int k = 0; k < 9; k++) {
      row[9 * e + k] = m->vgid[m->vertex[3 * e + k % 3]];
      column[9 * e + k] = m->vgid[m->vertex[3 * e + k / 3]];
    }
  PetscCall(AssemblyCreate(m->comm, m->nv_owned, 9 * m->ne, row, column, &s->assembly, &s->matrix));
  PetscCall(PetscFree2(row, column));
  PetscFunctionReturn(0);
}

PetscErrorCode ContinuousSpaceCreate(const Mesh *mesh, ContinuousSpace *space)
{
  ContinuousSpace s;
  PetscFunctionBeginUser;
  PetscCall(PetscNew(&s));
  s->mesh = mesh;
  PetscCall(PetscMalloc1(3 * mesh->ne, &s->node));
  PetscCall(CreateNodes(s));
  PetscCall(CreateMatrix(s));
  *space = s;
  PetscFunctionReturn(0);
}

PetscErrorCode ContinuousSpaceDestroy(ContinuousSpace *space)
{
  ContinuousSpace s = *space;
  PetscFunctionBeginUser;
  if (!s) PetscFunctionReturn(0);
  for (int k = 0; k < NSOLVERS; k++) PetscCall(PCDestroy(&s->pc[k]));
  PetscCall(AssemblyDestroy(&s->assembly));
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
  PetscCall(AssemblySum(s->assembly, block[0], s->matrix));
  if (!s->pc[kind]) PetscCall(CreateSolver(s, kind));
  s->used = s->pc[kind];
  PetscCall(PCSetUp(s->used));
  PetscFunctionReturn(0);
}

static PetscErrorCode Restrict(ContinuousSpace s, int component, const double r[])
{
  PetscScalar *v;
  PetscFunctionBeginUser;
  PetscCall(GhostedGetArrayZero(s->residual, &v));
  for (int e = 0; e < s->mesh->ne; e++)
    for (int i = 0; i < 3; i++) v[s->node[3 * e + i]] += r[6 * e + 3 * component + i];
  PetscCall(GhostedRestoreArray(s->residual, &v));
  PetscCall(GhostedSum(s->residual));
  PetscFunctionReturn(0);
}

static PetscErrorCode Extend(ContinuousSpace s, int component, SingleVector z[])
{
  const PetscScalar *v;
  PetscFunctionBeginUser;
  PetscCall(GhostedUpdate(s->correction));
  PetscCall(GhostedGetArrayRead(s->correction, &v));
  for (int e = 0; e < s->mesh->ne; e++)
    for (int i = 0; i < 4; i++) z[e][4 * component + i] = i < 3 ? (float)v[s->node[3 * e + i]] : 0.0f;
  PetscCall(GhostedRestoreArrayRead(s->correction, &v));
  PetscFunctionReturn(0);
}

PetscErrorCode ContinuousSpaceCorrect(ContinuousSpace s, const double r[], SingleVector z[])
{
  PetscFunctionBeginUser;
  for (int c = 0; c < 2; c++) {
    PetscCall(Restrict(s, c, r));
    PetscCall(PCApply(s->used, s->residual, s->correction));
    PetscCall(Extend(s, c, z));
  }
  PetscFunctionReturn(0);
}
