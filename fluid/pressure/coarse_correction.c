#include "fluid/pressure/coarse_correction.h"
#include "fluid/discretization/assembly.h"
#include "fluid/discretization/solver_options.h"
#include <limits.h>
#include <math.h>

#define FACTOR_MAX 25000 /* vertices times ranks, from which on multigrid is cheaper than a factor */
#define CHANGE_MAX 4.0   /* of an element, as a factor: what an old solver is good for */

struct CoarseCorrection_s {
  const FluidDomain *domain; /* borrowed */
  Mat extension;             /* E */
  Mat matrix;                /* A1 */
  Assembly assembly;         /* of A1 */
  PetscInt nfixed;           /* owned vertices whose row of A1 is the identity's */
  PetscBool pinned;          /* this rank has the vertex that makes A1 definite in a closed domain */
  KSP solver;                /* of A1 */
  Vec r1, z1, change;        /* in P1; E z1 */
  int setup;                 /* iterations of CG that cost as much as the set-up of a solver */
  int fresh;                 /* least iterations with the solver; -1: it has not been used yet */
  int excess;                /* iterations above that since then */
  double *coefficient; /* [ne] sum of the diagonal of an element's part of A1, when the solver was set up */
};

static PetscErrorCode CreateExtension(CoarseCorrection c, const char is_fixed[])
{
  const Mesh *m = c->domain->mesh;
  const P2Space *p2 = c->domain->p2;
  const double one = 1.0, half[2] = {0.5, 0.5};
  PetscFunctionBeginUser;
  PetscCall(MatCreateAIJ(m->comm, p2->nowned, m->nv_owned, PETSC_DETERMINE, PETSC_DETERMINE, 2, NULL, 2, NULL,
                         &c->extension));
  for (int e = 0; e < m->ne; e++) {
    const int *node = p2->node + 6 * e;
    PetscInt vertex[3];
    for (int i = 0; i < 3; i++) vertex[i] = is_fixed[node[i]] ? -1 : m->vgid[m->vertex[3 * e + i]];
    for (int i = 0; i < 3; i++) {
      const PetscInt end[2] = {vertex[(i + 1) % 3], vertex[(i + 2) % 3]};
      PetscCall(MatSetValues(c->extension, 1, p2->gid + node[i], 1, vertex + i, &one, INSERT_VALUES));
      PetscCall(MatSetValues(c->extension, 1, p2->gid + node[3 + i], 2, end, half, INSERT_VALUES));
    }
  }
  PetscCall(MatAssemblyBegin(c->extension, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(c->extension, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(0);
}

/* row = column: the owned vertices that are fixed; *n is raised by their number. */
static PetscErrorCode ListFixed(CoarseCorrection c, const char is_fixed[], PetscInt *n, PetscInt row[],
                                PetscInt column[])
{
  const Mesh *m = c->domain->mesh;
  char *met;
  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(m->nv_owned, &met));
  for (int k = 0; k < 3 * m->ne; k++) {
    const PetscInt gid = m->vgid[m->vertex[k]], own = gid - m->vstart;
    if (own < 0 || own >= m->nv_owned || met[own]) continue;
    met[own] = 1;
    if (is_fixed[c->domain->p2->node[6 * (k / 3) + k % 3]]) row[*n] = column[*n] = gid, ++*n;
  }
  PetscCall(PetscFree(met));
  PetscFunctionReturn(0);
}

/* An entry for each entry of the elements' blocks, then the rows of fixed vertices and the pinned one. */
static PetscErrorCode CreateMatrix(CoarseCorrection c, const char is_fixed[])
{
  const Mesh *m = c->domain->mesh;
  PetscInt *row, *column, n = 9 * m->ne;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(n + m->nv_owned + 1, &row, n + m->nv_owned + 1, &column));
  for (int e = 0; e < m->ne; e++)
    for (int k = 0; k < 9; k++) {
      const int *node = c->domain->p2->node + 6 * e, i = k / 3, j = k % 3;
      row[9 * e + k] = is_fixed[node[i]] || is_fixed[node[j]] ? -1 : m->vgid[m->vertex[3 * e + i]];
      column[9 * e + k] = m->vgid[m->vertex[3 * e + j]];
    }
  PetscCall(ListFixed(c, is_fixed, &n, row, column));
  c->nfixed = n - 9 * m->ne;
  if (c->pinned) row[n] = column[n] = 0, n++;
  PetscCall(AssemblyCreate(m->comm, m->nv_owned, n, row, column, &c->assembly, &c->matrix));
  PetscCall(MatSetOption(c->matrix, MAT_SPD, PETSC_TRUE));
  PetscCall(PetscFree2(row, column));
  PetscFunctionReturn(0);
}

static PetscErrorCode CreateSolver(CoarseCorrection c)
{
  PetscInt size;
  PetscMPIInt ranks;
  PC pc;
  PetscFunctionBeginUser;
  PetscCall(MatGetSize(c->matrix, &size, NULL));
  PetscCallMPI(MPI_Comm_size(c->domain->mesh->comm, &ranks));
  c->setup = (int)PetscMin(sqrt((double)size) / 25.0, 6.0);
  PetscCall(SolverCreateDirect(c->domain->mesh->comm, "pressure_coarse_", KSPPREONLY, &c->solver));
#if defined(PETSC_HAVE_HYPRE)
  if (size > FACTOR_MAX / ranks) { /* multigrid is distributed, a factor is not */
    PetscCall(KSPGetPC(c->solver, &pc));
    PetscCall(PCSetType(pc, PCHYPRE));
    PetscCall(PCHYPRESetType(pc, "boomeramg"));
    PetscCall(SolverDefaultOption("pressure_coarse_", "pc_hypre_boomeramg_relax_type_down", "SOR/Jacobi"));
    PetscCall(
        SolverDefaultOption("pressure_coarse_", "pc_hypre_boomeramg_relax_type_up", "backward-SOR/Jacobi"));
  }
#endif
  PetscCall(KSPSetOperators(c->solver, c->matrix, c->matrix));
  PetscCall(KSPSetFromOptions(c->solver));
  PetscFunctionReturn(0);
}

PetscErrorCode CoarseCorrectionCreate(const FluidDomain *domain, const char is_fixed[], PetscBool closed,
                                      CoarseCorrection *correction)
{
  CoarseCorrection c;
  PetscFunctionBeginUser;
  PetscCall(PetscNew(&c));
  c->domain = domain;
  c->fresh = -1;
  c->excess = INT_MAX;
  PetscCall(PetscMalloc1(domain->mesh->ne, &c->coefficient));
  c->pinned = (PetscBool)(closed && domain->mesh->nv_owned > 0 && domain->mesh->vstart == 0);
  PetscCall(CreateExtension(c, is_fixed));
  PetscCall(CreateMatrix(c, is_fixed));
  PetscCall(MatCreateVecs(c->extension, &c->r1, &c->change));
  PetscCall(VecDuplicate(c->r1, &c->z1));
  PetscCall(CreateSolver(c));
  *correction = c;
  PetscFunctionReturn(0);
}

PetscErrorCode CoarseCorrectionDestroy(CoarseCorrection *correction)
{
  CoarseCorrection c = *correction;
  PetscFunctionBeginUser;
  if (!c) PetscFunctionReturn(0);
  PetscCall(KSPDestroy(&c->solver));
  PetscCall(MatDestroy(&c->extension));
  PetscCall(AssemblyDestroy(&c->assembly));
  PetscCall(MatDestroy(&c->matrix));
  PetscCall(VecDestroy(&c->r1));
  PetscCall(VecDestroy(&c->z1));
  PetscCall(VecDestroy(&c->change));
  PetscCall(PetscFree(c->coefficient));
  PetscCall(PetscFree(*correction));
  PetscFunctionReturn(0);
}

PetscErrorCode CoarseCorrectionApply(CoarseCorrection c, Vec residual, Vec *change)
{
  PetscFunctionBeginUser;
  PetscCall(MatMultTranspose(c->extension, residual, c->r1));
  PetscCall(KSPSolve(c->solver, c->r1, c->z1));
  PetscCall(MatMult(c->extension, c->z1, c->change));
  *change = c->change;
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
static PetscErrorCode LargestChange(CoarseCorrection c, const double coarse[][9], double *change)
{
  PetscFunctionBeginUser;
  *change = 1.0;
  for (int e = 0; e < c->domain->mesh->ne; e++) {
    const double ratio = (coarse[e][0] + coarse[e][4] + coarse[e][8]) / c->coefficient[e];
    *change = PetscMax(*change, PetscMax(ratio, 1.0 / ratio));
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, change, 1, MPI_DOUBLE, MPI_MAX, c->domain->mesh->comm));
  PetscFunctionReturn(0);
}

/* A1 from its elements' parts, followed by the values of single rows. */
static PetscErrorCode SetMatrix(CoarseCorrection c, double coarse[][9])
{
  const int ne = c->domain->mesh->ne;
  double *single = coarse[ne];
  PetscFunctionBeginUser;
  for (int k = 0; k < c->nfixed; k++) single[k] = 1.0;
  if (c->pinned) single[c->nfixed] = coarse[0][0];
  for (int e = 0; e < ne; e++) c->coefficient[e] = coarse[e][0] + coarse[e][4] + coarse[e][8];
  PetscCall(AssemblySum(c->assembly, coarse[0], c->matrix));
  c->fresh = -1;
  c->excess = 0;
  PetscFunctionReturn(0);
}

PetscErrorCode CoarseCorrectionUpdate(CoarseCorrection c, const double block[][36])
{
  const int ne = c->domain->mesh->ne;
  double(*coarse)[9], change = HUGE_VAL;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(ne + c->nfixed / 9 + 1, &coarse));
  for (int e = 0; e < ne; e++) Coarsen(block[e], coarse[e]);
  if (c->excess <= c->setup) PetscCall(LargestChange(c, (const double(*)[9])coarse, &change));
  if (change > CHANGE_MAX) PetscCall(SetMatrix(c, coarse));
  PetscCall(PetscFree(coarse));
  PetscFunctionReturn(0);
}

void CoarseCorrectionCount(CoarseCorrection c, int iterations)
{
  if (c->fresh < 0 || iterations < c->fresh) c->fresh = iterations;
  c->excess += iterations - c->fresh;
}
