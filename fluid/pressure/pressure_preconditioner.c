#include "fluid/pressure/pressure_preconditioner.h"
#include "fluid/discretization/ghosted.h"
#include "fluid/pressure/coarse_correction.h"
#include "fluid/pressure/patch_correction.h"
#include "fluid/pressure/relaxation.h"

/* Of elements: patches are made of those above the first when there is one above the second.  (2 in place of 1.2: up to 38 iterations in place of 16 in
 * tests/fluid/test_pressure_solver.c.  A skin of a fiftieth of the fluid's density has 5, and the iteration less would not pay for its patches.) */
#define UNEVEN 1.2
#define VERY_UNEVEN 10.0

struct PressurePreconditioner_s {
  const FluidDomain *domain; /* borrowed */
  Relaxation relaxation;
  PatchCorrection patches;
  CoarseCorrection coarse;
  Vec balanced; /* in a closed domain: r without its sum */
};

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
  Vec residual = NULL, change;
  PetscFunctionBeginUser;
  PetscCall(PCShellGetContext(shell, &p));
  PetscCall(Balance(p, shell, &r));
  PetscCall(RelaxationForward(p->relaxation, r, z, &residual));
  if (PatchCorrectionActive(p->patches)) PetscCall(PatchCorrectionFirst(p->patches, residual, z));
  PetscCall(CoarseCorrectionApply(p->coarse, residual, &change));
  PetscCall(VecAXPY(z, 1.0, change));
  if (PatchCorrectionActive(p->patches)) PetscCall(PatchCorrectionSecond(p->patches, change, residual, z));
  PetscCall(RelaxationBackward(p->relaxation, r, z));
  PetscFunctionReturn(0);
}

static PetscErrorCode UseShell(PressurePreconditioner p, KSP ksp, PetscBool closed)
{
  Mat matrix;
  PC shell;
  PetscFunctionBeginUser;
  PetscCall(KSPGetOperators(ksp, &matrix, NULL));
  PetscCall(RelaxationCreate(matrix, &p->relaxation));
  PetscCall(PatchCorrectionCreate(matrix, &p->patches));
  if (closed) PetscCall(MatCreateVecs(matrix, &p->balanced, NULL));
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
  PetscCall(UseShell(p, ksp, closed));
  PetscCall(CoarseCorrectionCreate(domain, is_fixed, closed, &p->coarse));
  *preconditioner = p;
  PetscFunctionReturn(0);
}

PetscErrorCode PressurePreconditionerDestroy(PressurePreconditioner *preconditioner)
{
  PressurePreconditioner p = *preconditioner;
  PetscFunctionBeginUser;
  if (!p) PetscFunctionReturn(0);
  PetscCall(CoarseCorrectionDestroy(&p->coarse));
  PetscCall(RelaxationDestroy(&p->relaxation));
  PetscCall(PatchCorrectionDestroy(&p->patches));
  PetscCall(VecDestroy(&p->balanced));
  PetscCall(PetscFree(*preconditioner));
  PetscFunctionReturn(0);
}

/* mark, ghosted: 1 in the nodes of uneven elements of any rank */
static PetscErrorCode MarkPatches(PressurePreconditioner p, const double unevenness[], Vec mark)
{
  const FluidDomain *d = p->domain;
  PetscScalar *v;
  PetscFunctionBeginUser;
  PetscCall(GhostedGetArrayZero(mark, &v));
  for (int e = 0; e < d->mesh->ne; e++)
    for (int q = 0; q < 6 && unevenness[e] > UNEVEN; q++) v[d->p2->node[6 * e + q]] = 1.0;
  PetscCall(GhostedRestoreArray(mark, &v));
  PetscCall(GhostedSum(mark));
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
  PetscFunctionBeginUser;
  PetscCall(CoarseCorrectionUpdate(p->coarse, block));
  PetscCall(RelaxationUpdate(p->relaxation));
  PetscCall(UpdatePatches(p, unevenness));
  PetscFunctionReturn(0);
}

void PressurePreconditionerCount(PressurePreconditioner p, int iterations)
{
  CoarseCorrectionCount(p->coarse, iterations);
}
