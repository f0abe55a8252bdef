#include "fluid/pressure_preconditioner.h"
#include "fluid/solver_options.h"
#include "fluid/vertices.h"
#include <limits.h>
#include <math.h>

#define FACTOR_MAX 40000 /* vertices times ranks, from which on multigrid is cheaper than a factor */
#define CHANGE_MAX 4.0   /* of an element, as a factor: what an old coarse solver is good for */

struct PressurePreconditioner_s {
  const Mesh *mesh; /* borrowed */
  Mat matrix;       /* borrowed: A */
  Mat extension;    /* E */
  Mat coarse;       /* A1 */
  PetscInt nfixed;  /* owned vertices whose row of A1 is the identity's */
  PetscBool pinned; /* this rank has the vertex that makes A1 definite in a closed domain */
  KSP solver;       /* of A1 */
  Vec residual, r1, z1;
  int setup;  /* iterations of CG that cost as much as the set-up of a coarse solver */
  int fresh;  /* iterations of the first solve with the coarse solver; -1: it has not been used yet */
  int excess; /* iterations above that since then */
  double *coefficient; /* [ne] sum of the diagonal of an element's part of A1, when the solver was set up */
};

static PetscErrorCode CreateExtension(PressurePreconditioner p, const char is_fixed[], PetscInt owned,
                                      const double number[])
{
  const Mesh *m = p->mesh;
  const double one = 1.0, half[2] = {0.5, 0.5};
  PetscFunctionBeginUser;
  PetscCall(MatCreateAIJ(m->comm, m->np2_owned, owned, PETSC_DETERMINE, PETSC_DETERMINE, 2, NULL, 2, NULL,
                         &p->extension));
  for (int e = 0; e < m->ne; e++)
    for (int i = 0; i < 3; i++) {
      const int *node = m->p2 + 6 * e, ends[2] = {node[(i + 1) % 3], node[(i + 2) % 3]};
      const PetscInt vertex = is_fixed[node[i]] ? -1 : (PetscInt)number[node[i]];
      const PetscInt end[2] = {is_fixed[ends[0]] ? -1 : (PetscInt)number[ends[0]],
                               is_fixed[ends[1]] ? -1 : (PetscInt)number[ends[1]]};
      PetscCall(MatSetValues(p->extension, 1, m->p2gid + node[i], 1, &vertex, &one, INSERT_VALUES));
      PetscCall(MatSetValues(p->extension, 1, m->p2gid + node[3 + i], 2, end, half, INSERT_VALUES));
    }
  PetscCall(MatAssemblyBegin(p->extension, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(p->extension, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(0);
}

/* An entry for each entry of the elements' blocks, then the rows of fixed vertices and the pinned one. */
static PetscErrorCode CreateCoarse(PressurePreconditioner p, const char is_fixed[], PetscInt owned,
                                   const double number[])
{
  const Mesh *m = p->mesh;
  PetscInt *row, *column, n = 9 * m->ne;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(n + owned + 1, &row, n + owned + 1, &column));
  for (int e = 0; e < m->ne; e++)
    for (int k = 0; k < 9; k++) {
      const int i = m->p2[6 * e + k / 3], j = m->p2[6 * e + k % 3];
      row[9 * e + k] = is_fixed[i] || is_fixed[j] ? -1 : (PetscInt)number[i];
      column[9 * e + k] = (PetscInt)number[j];
    }
  for (int k = 0; k < m->np2_owned; k++)
    if (is_fixed[k] && number[k] >= 0.0) row[n] = column[n] = (PetscInt)number[k], n++;
  p->nfixed = n - 9 * m->ne;
  if (p->pinned) row[n] = column[n] = 0, n++;
  PetscCall(MatCreate(m->comm, &p->coarse));
  PetscCall(MatSetSizes(p->coarse, owned, owned, PETSC_DETERMINE, PETSC_DETERMINE));
  PetscCall(MatSetType(p->coarse, MATAIJ));
  PetscCall(MatSetPreallocationCOO(p->coarse, n, row, column));
  PetscCall(MatSetOption(p->coarse, MAT_SPD, PETSC_TRUE));
  PetscCall(PetscFree2(row, column));
  PetscFunctionReturn(0);
}

static PetscErrorCode CreateSolver(PressurePreconditioner p)
{
  PetscInt size;
  PetscMPIInt ranks;
  PC pc;
  PetscFunctionBeginUser;
  PetscCall(MatGetSize(p->coarse, &size, NULL));
  PetscCallMPI(MPI_Comm_size(p->mesh->comm, &ranks));
  p->setup = (int)PetscMin(sqrt((double)size) / 25.0, 6.0);
  PetscCall(SolverCreateDirect(p->mesh->comm, "pressure_coarse_", KSPPREONLY, &p->solver));
#if defined(PETSC_HAVE_HYPRE)
  if (size * ranks > FACTOR_MAX) { /* multigrid is distributed, a factor is not */
    PetscCall(KSPGetPC(p->solver, &pc));
    PetscCall(PCSetType(pc, PCHYPRE));
    PetscCall(PCHYPRESetType(pc, "boomeramg"));
  }
#endif
  PetscCall(KSPSetOperators(p->solver, p->coarse, p->coarse));
  PetscCall(KSPSetFromOptions(p->solver));
  PetscFunctionReturn(0);
}

/* PCSHELL */
static PetscErrorCode Apply(PC shell, Vec r, Vec z)
{
  PressurePreconditioner p;
  PetscFunctionBeginUser;
  PetscCall(PCShellGetContext(shell, &p));
  PetscCall(MatSOR(p->matrix, r, 1.0, (MatSORType)(SOR_LOCAL_FORWARD_SWEEP | SOR_ZERO_INITIAL_GUESS), 0.0, 1,
                   1, z));
  PetscCall(MatMult(p->matrix, z, p->residual));
  PetscCall(VecAYPX(p->residual, -1.0, r));
  PetscCall(MatMultTranspose(p->extension, p->residual, p->r1));
  PetscCall(KSPSolve(p->solver, p->r1, p->z1));
  PetscCall(MatMultAdd(p->extension, p->z1, z, z));
  PetscCall(MatSOR(p->matrix, r, 1.0, SOR_LOCAL_BACKWARD_SWEEP, 0.0, 1, 1, z));
  PetscFunctionReturn(0);
}

static PetscErrorCode UseShell(PressurePreconditioner p, KSP ksp)
{
  PC shell;
  PetscFunctionBeginUser;
  PetscCall(KSPGetOperators(ksp, &p->matrix, NULL));
  PetscCall(KSPGetPC(ksp, &shell));
  PetscCall(PCSetType(shell, PCSHELL));
  PetscCall(PCShellSetName(shell, "relaxation and linear functions"));
  PetscCall(PCShellSetContext(shell, p));
  PetscCall(PCShellSetApply(shell, Apply));
  PetscFunctionReturn(0);
}

PetscErrorCode PressurePreconditionerCreate(const Mesh *mesh, const char is_fixed[], PetscBool closed,
                                            KSP ksp, PressurePreconditioner *preconditioner)
{
  PressurePreconditioner p;
  PetscInt owned;
  double *number;
  PetscFunctionBeginUser;
  PetscCall(PetscNew(&p));
  p->mesh = mesh;
  p->fresh = -1;
  p->excess = INT_MAX;
  PetscCall(PetscMalloc1(mesh->ne, &p->coefficient));
  PetscCall(PetscMalloc1(mesh->np2, &number));
  PetscCall(VerticesNumber(mesh, &owned, number));
  for (int k = 0; k < mesh->np2_owned && closed; k++) p->pinned |= number[k] == 0.0;
  PetscCall(UseShell(p, ksp));
  PetscCall(CreateExtension(p, is_fixed, owned, number));
  PetscCall(CreateCoarse(p, is_fixed, owned, number));
  PetscCall(MatCreateVecs(p->extension, &p->r1, &p->residual));
  PetscCall(VecDuplicate(p->r1, &p->z1));
  PetscCall(CreateSolver(p));
  PetscCall(PetscFree(number));
  *preconditioner = p;
  PetscFunctionReturn(0);
}

PetscErrorCode PressurePreconditionerDestroy(PressurePreconditioner *preconditioner)
{
  PressurePreconditioner p = *preconditioner;
  PetscFunctionBeginUser;
  if (!p) PetscFunctionReturn(0);
  PetscCall(KSPDestroy(&p->solver));
  PetscCall(MatDestroy(&p->extension));
  PetscCall(MatDestroy(&p->coarse));
  PetscCall(VecDestroy(&p->residual));
  PetscCall(VecDestroy(&p->r1));
  PetscCall(VecDestroy(&p->z1));
  PetscCall(PetscFree(p->coefficient));
  PetscCall(PetscFree(*preconditioner));
  PetscFunctionReturn(0);
}

/* b1 = E^T b E on one element */
static void Coarsen(const double b[36], double b1[9])
{
  double half[6][3];
  for (int q = 0; q < 6; q++)
    for (int j = 0; j < 3; j++)
      half[q][j] = b[6 * q + j] + 0.5 * (b[6 * q + 3 + (j + 1) % 3] + b[6 * q + 3 + (j + 2) % 3]);
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      b1[3 * i + j] = half[i][j] + 0.5 * (half[3 + (i + 1) % 3][j] + half[3 + (i + 2) % 3][j]);
}

/* The largest factor by which an element's coefficient has changed since the coarse solver was set up. */
static PetscErrorCode LargestChange(PressurePreconditioner p, const double coarse[][9], double *change)
{
  PetscFunctionBeginUser;
  *change = 1.0;
  for (int e = 0; e < p->mesh->ne; e++) {
    const double ratio = (coarse[e][0] + coarse[e][4] + coarse[e][8]) / p->coefficient[e];
    *change = PetscMax(*change, PetscMax(ratio, 1.0 / ratio));
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, change, 1, MPI_DOUBLE, MPI_MAX, p->mesh->comm));
  PetscFunctionReturn(0);
}

/* A1 from its elements' parts, followed by the values of single rows. */
static PetscErrorCode SetCoarse(PressurePreconditioner p, double coarse[][9])
{
  const int ne = p->mesh->ne;
  double *single = coarse[ne];
  PetscFunctionBeginUser;
  for (int k = 0; k < p->nfixed; k++) single[k] = 1.0;
  if (p->pinned) single[p->nfixed] = coarse[0][0];
  for (int e = 0; e < ne; e++) p->coefficient[e] = coarse[e][0] + coarse[e][4] + coarse[e][8];
  PetscCall(MatSetValuesCOO(p->coarse, coarse[0], INSERT_VALUES));
  p->fresh = -1;
  p->excess = 0;
  PetscFunctionReturn(0);
}

PetscErrorCode PressurePreconditionerUpdate(PressurePreconditioner p, const double block[][36])
{
  const int ne = p->mesh->ne;
  double(*coarse)[9], change = HUGE_VAL;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(ne + p->nfixed / 9 + 1, &coarse));
  for (int e = 0; e < ne; e++) Coarsen(block[e], coarse[e]);
  if (p->excess <= p->setup) PetscCall(LargestChange(p, (const double(*)[9])coarse, &change));
  if (change > CHANGE_MAX) PetscCall(SetCoarse(p, coarse));
  PetscCall(PetscFree(coarse));
  PetscFunctionReturn(0);
}

PetscErrorCode PressurePreconditionerCount(PressurePreconditioner p, int iterations)
{
  PetscFunctionBeginUser;
  if (p->fresh < 0) p->fresh = iterations;
  p->excess += iterations - p->fresh;
  PetscFunctionReturn(0);
}
