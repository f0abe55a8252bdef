#include "fluid/pressure/pressure_preconditioner.h"
#include "fluid/discretization/assembly.h"
#include "fluid/discretization/solver_options.h"
#include "fluid/pressure/patch_correction.h"
#include "fluid/pressure/relaxation.h"
#include <limits.h>
#include <math.h>

#define FACTOR_MAX 25000 /* vertices times ranks, from which on multigrid is cheaper than a factor */
#define CHANGE_MAX 4.0   /* of an element, as a factor: what an old coarse solver is good for */
/* Of elements: patches are made of those above the first when there is one above the second.  (2 in place of 1.2: up to 38 iterations in place of 16 in
 * tests/fluid/test_pressure_solver.c.  A skin of a fiftieth of the fluid's density has 5, and the iteration less would not pay for its patches.) */
#define UNEVEN 1.2
#define VERY_UNEVEN 10.0

struct PressurePreconditioner_s {
  const FluidDomain *domain; /* borrowed */
  Relaxation relaxation;
  PatchCorrection patches;
  Mat extension;       /* E */
  Mat coarse;          /* A1 */
  Assembly assembly;   /* of A1 */
  PetscInt nfixed;     /* owned vertices whose row of A1 is the identity's */
  PetscBool pinned;    /* this rank has the vertex that makes A1 definite in a closed domain */
  KSP solver;          /* of A1 */
  Vec balanced;        /* in a closed domain: r without its sum */
  Vec r1, z1, change;  /* in P1; E z1 */
  int setup;           /* iterations of CG that cost as much as the set-up of a coarse solver */
  int fresh;           /* least iterations with the coarse solver; -1: it has not been used yet */
  int excess;          /* iterations above that since then */
  double *coefficient; /* [ne] sum of the diagonal of an element's part of A1, when the solver was set up */
};

static PetscErrorCode CreateExtension(PressurePreconditioner p, const char is_fixed[])
{
  const Mesh *m = p->domain->mesh;
  const P2Space *p2 = p->domain->p2;
  const double one = 1.0, half[2] = {0.5, 0.5};
  PetscFunctionBeginUser;
  PetscCall(MatCreateAIJ(m->comm, p2->nowned, m->nv_owned, PETSC_DETERMINE, PETSC_DETERMINE, 2, NULL, 2, NULL,
                         &p->extension));
  for (int e = 0; e < m->ne; e++) {
    const int *node = p2->node + 6 * e;
    PetscInt vertex[3];
    for (int i = 0; i < 3; i++) vertex[i] = is_fixed[node[i]] ? -1 : m->vgid[m->vertex[3 * e + i]];
    for (int i = 0; i < 3; i++) {
      const PetscInt end[2] = {vertex[(i + 1) % 3], vertex[(i + 2) % 3]};
      PetscCall(MatSetValues(p->extension, 1, p2->gid + node[i], 1, vertex + i, &one, INSERT_VALUES));
      PetscCall(MatSetValues(p->extension, 1, p2->gid + node[3 + i], 2, end, half, INSERT_VALUES));
    }
  }
  PetscCall(MatAssemblyBegin(p->extension, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(p->extension, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(0);
}

/* row = column: the owned vertices that are fixed; *n is raised by their number. */
static PetscErrorCode ListFixed(PressurePreconditioner p, const char is_fixed[], PetscInt *n, PetscInt row[],
                                PetscInt column[])
{
  const Mesh *m = p->domain->mesh;
  char *met;
  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(m->nv_owned, &met));
  for (int k = 0; k < 3 * m->ne; k++) {
    const PetscInt gid = m->vgid[m->vertex[k]], own = gid - m->vstart;
    if (own < 0 || own >= m->nv_owned || met[own]) continue;
    met[own] = 1;
    if (is_fixed[p->domain->p2->node[6 * (k / 3) + k % 3]]) row[*n] = column[*n] = gid, ++*n;
  }
  PetscCall(PetscFree(met));
  PetscFunctionReturn(0);
}

/* An entry for each entry of the elements' blocks, then the rows of fixed vertices and the pinned one. */
static PetscErrorCode CreateCoarse(PressurePreconditioner p, const char is_fixed[])
{
  const Mesh *m = p->domain->mesh;
  PetscInt *row, *column, n = 9 * m->ne;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(n + m->nv_owned + 1, &row, n + m->nv_owned + 1, &column));
  for (int e = 0; e < m->ne; e++)
    for (int k = 0; k < 9; k++) {
      const int *node = p->domain->p2->node + 6 * e, i = k / 3, j = k % 3;
      row[9 * e + k] = is_fixed[node[i]] || is_fixed[node[j]] ? -1 : m->vgid[m->vertex[3 * e + i]];
      column[9 * e + k] = m->vgid[m->vertex[3 * e + j]];
    }
  PetscCall(ListFixed(p, is_fixed, &n, row, column));
  p->nfixed = n - 9 * m->ne;
  if (p->pinned) row[n] = column[n] = 0, n++;
  PetscCall(AssemblyCreate(m->comm, m->nv_owned, n, row, column, &p->assembly, &p->coarse));
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
  PetscCallMPI(MPI_Comm_size(p->domain->mesh->comm, &ranks));
  p->setup = (int)PetscMin(sqrt((double)size) / 25.0, 6.0);
  PetscCall(SolverCreateDirect(p->domain->mesh->comm, "pressure_coarse_", KSPPREONLY, &p->solver));
#if defined(PETSC_HAVE_HYPRE)
  if (size * ranks > FACTOR_MAX) { /* multigrid is distributed, a factor is not */
    PetscCall(KSPGetPC(p->solver, &pc));
    PetscCall(PCSetType(pc, PCHYPRE));
    PetscCall(PCHYPRESetType(pc, "boomeramg"));
    PetscCall(SolverDefaultOption("pressure_coarse_", "pc_hypre_boomeramg_relax_type_down", "SOR/Jacobi"));
    PetscCall(
        SolverDefaultOption("pressure_coarse_", "pc_hypre_boomeramg_relax_type_up", "backward-SOR/Jacobi"));
  }
#endif
  PetscCall(KSPSetOperators(p->solver, p->coarse, p->coarse));
  PetscCall(KSPSetFromOptions(p->solver));
  PetscFunctionReturn(0);
}

/* Constants are known to nobody in a closed domain, and the sum of r, round-off of A x, would end CG where it is as large as r itself. */
static PetscErrorCode Balance(PressurePreconditioner p, PC shell, Vec *r)
{
  Mat matrix;
  MatNullSpace constants;
  PetscFunctionBeginUser;
  if (!p->balanced) PetscFunctionReturn(0);
  PetscCall(VecCopy(*r, p->balanced));
  PetscCall(PCGetOperators(shell, &matrix, NULL));
  PetscCall(MatGetNullSpace(matrix, &constants));
  PetscCall(MatNullSpaceRemove(constants, p->balanced));
  *r = p->balanced;
  PetscFunctionReturn(0);
}

/* PCSHELL */
static PetscErrorCode Apply(PC shell, Vec r, Vec z)
{
  PressurePreconditioner p;
  Vec residual = NULL;
  PetscFunctionBeginUser;
  PetscCall(PCShellGetContext(shell, &p));
  PetscCall(Balance(p, shell, &r));
  PetscCall(RelaxationForward(p->relaxation, r, z, &residual));
  if (PatchCorrectionActive(p->patches)) PetscCall(PatchCorrectionFirst(p->patches, residual, z));
  PetscCall(MatMultTranspose(p->extension, residual, p->r1));
  PetscCall(KSPSolve(p->solver, p->r1, p->z1));
  PetscCall(MatMult(p->extension, p->z1, p->change));
  PetscCall(VecAXPY(z, 1.0, p->change));
  if (PatchCorrectionActive(p->patches)) PetscCall(PatchCorrectionSecond(p->patches, p->change, residual, z));
  PetscCall(RelaxationBackward(p->relaxation, r, z));
  PetscFunctionReturn(0);
}

static PetscErrorCode UseShell(PressurePreconditioner p, KSP ksp)
{
  Mat matrix;
  PC shell;
  PetscFunctionBeginUser;
  PetscCall(KSPGetOperators(ksp, &matrix, NULL));
  PetscCall(RelaxationCreate(matrix, &p->relaxation));
  PetscCall(PatchCorrectionCreate(matrix, &p->patches));
  PetscCall(KSPGetPC(ksp, &shell));
  PetscCall(PCSetType(shell, PCSHELL));
  PetscCall(PCShellSetName(shell, "relaxation, patches and linear functions"));
  PetscCall(PCShellSetContext(shell, p));
  PetscCall(PCShellSetApply(shell, Apply));
  PetscFunctionReturn(0);
}

PetscErrorCode PressurePreconditionerCreate(const FluidDomain *domain, const char is_fixed[],
                                            PetscBool closed, KSP ksp, PressurePreconditioner *preconditioner)
{
  PressurePreconditioner p;
  PetscFunctionBeginUser;
  PetscCall(PetscNew(&p));
  p->domain = domain;
  p->fresh = -1;
  p->excess = INT_MAX;
  PetscCall(PetscMalloc1(domain->mesh->ne, &p->coefficient));
  p->pinned = (PetscBool)(closed && domain->mesh->nv_owned > 0 && domain->mesh->vstart == 0);
  PetscCall(UseShell(p, ksp));
  PetscCall(CreateExtension(p, is_fixed));
  PetscCall(CreateCoarse(p, is_fixed));
  PetscCall(MatCreateVecs(p->extension, &p->r1, &p->change));
  if (closed) PetscCall(VecDuplicate(p->change, &p->balanced));
  PetscCall(VecDuplicate(p->r1, &p->z1));
  PetscCall(CreateSolver(p));
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
  PetscCall(AssemblyDestroy(&p->assembly));
  PetscCall(MatDestroy(&p->coarse));
  PetscCall(RelaxationDestroy(&p->relaxation));
  PetscCall(PatchCorrectionDestroy(&p->patches));
  PetscCall(VecDestroy(&p->balanced));
  PetscCall(VecDestroy(&p->r1));
  PetscCall(VecDestroy(&p->z1));
  PetscCall(VecDestroy(&p->change));
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
  for (int e = 0; e < p->domain->mesh->ne; e++) {
    const double ratio = (coarse[e][0] + coarse[e][4] + coarse[e][8]) / p->coefficient[e];
    *change = PetscMax(*change, PetscMax(ratio, 1.0 / ratio));
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, change, 1, MPI_DOUBLE, MPI_MAX, p->domain->mesh->comm));
  PetscFunctionReturn(0);
}

/* A1 from its elements' parts, followed by the values of single rows. */
static PetscErrorCode SetCoarse(PressurePreconditioner p, double coarse[][9])
{
  const int ne = p->domain->mesh->ne;
  double *single = coarse[ne];
  PetscFunctionBeginUser;
  for (int k = 0; k < p->nfixed; k++) single[k] = 1.0;
  if (p->pinned) single[p->nfixed] = coarse[0][0];
  for (int e = 0; e < ne; e++) p->coefficient[e] = coarse[e][0] + coarse[e][4] + coarse[e][8];
  PetscCall(AssemblySum(p->assembly, coarse[0], p->coarse));
  p->fresh = -1;
  p->excess = 0;
  PetscFunctionReturn(0);
}

/* mark, ghosted: 1 in the nodes of uneven elements of any rank */
static PetscErrorCode MarkPatches(PressurePreconditioner p, const double unevenness[], Vec mark)
{
  const FluidDomain *d = p->domain;
  PetscScalar *v;
  Vec local;
  PetscFunctionBeginUser;
  PetscCall(VecGhostGetLocalForm(mark, &local));
  PetscCall(VecSet(local, 0.0));
  PetscCall(VecGetArray(local, &v));
  for (int e = 0; e < d->mesh->ne; e++)
    for (int q = 0; q < 6 && unevenness[e] > UNEVEN; q++) v[d->p2->node[6 * e + q]] = 1.0;
  PetscCall(VecRestoreArray(local, &v));
  PetscCall(VecGhostRestoreLocalForm(mark, &local));
  PetscCall(VecGhostUpdateBegin(mark, ADD_VALUES, SCATTER_REVERSE));
  PetscCall(VecGhostUpdateEnd(mark, ADD_VALUES, SCATTER_REVERSE));
  PetscFunctionReturn(0);
}

/* After the relaxation's update. */
static PetscErrorCode UpdatePatches(PressurePreconditioner p, const double unevenness[])
{
  const P2Space *p2 = p->domain->p2;
  const PetscScalar *v;
  double most = 0.0;
  PetscInt *row, n = 0;
  Vec mark;
  PetscFunctionBeginUser;
  for (int e = 0; e < p->domain->mesh->ne; e++) most = PetscMax(most, unevenness[e]);
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &most, 1, MPI_DOUBLE, MPI_MAX, p->domain->mesh->comm));
  if (most <= VERY_UNEVEN) {
    PetscCall(PatchCorrectionClear(p->patches));
    PetscFunctionReturn(0);
  }
  PetscCall(VecCreateGhost(p->domain->mesh->comm, p2->nowned, PETSC_DETERMINE, p2->n - p2->nowned,
                           p2->gid + p2->nowned, &mark));
  PetscCall(MarkPatches(p, unevenness, mark));
  PetscCall(PetscMalloc1(p2->nowned, &row));
  PetscCall(VecGetArrayRead(mark, &v));
  for (int k = 0; k < p2->nowned; k++)
    if (v[k] > 0.0) row[n++] = p2->start + k;
  PetscCall(VecRestoreArrayRead(mark, &v));
  PetscCall(PatchCorrectionUpdate(p->patches, n, row, RelaxationHeld(p->relaxation)));
  PetscCall(PetscFree(row));
  PetscCall(VecDestroy(&mark));
  PetscFunctionReturn(0);
}

PetscErrorCode PressurePreconditionerUpdate(PressurePreconditioner p, const double block[][36],
                                            const double unevenness[])
{
  const int ne = p->domain->mesh->ne;
  double(*coarse)[9], change = HUGE_VAL;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(ne + p->nfixed / 9 + 1, &coarse));
  for (int e = 0; e < ne; e++) Coarsen(block[e], coarse[e]);
  if (p->excess <= p->setup) PetscCall(LargestChange(p, (const double(*)[9])coarse, &change));
  if (change > CHANGE_MAX) PetscCall(SetCoarse(p, coarse));
  PetscCall(PetscFree(coarse));
  PetscCall(RelaxationUpdate(p->relaxation));
  PetscCall(UpdatePatches(p, unevenness));
  PetscFunctionReturn(0);
}

PetscErrorCode PressurePreconditionerCount(PressurePreconditioner p, int iterations)
{
  PetscFunctionBeginUser;
  if (p->fresh < 0 || iterations < p->fresh) p->fresh = iterations;
  p->excess += iterations - p->fresh;
  PetscFunctionReturn(0);
}
