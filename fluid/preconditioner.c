#include "fluid/preconditioner.h"
#include "fluid/continuous_space.h"

typedef float SingleBlocks[4][9];

struct Preconditioner_s {
  MomentumOperator *op; /* borrowed */
  SingleBlocks *block;  /* [ne + 1] S in single precision, block[e][0] inverted; the last is only read over */
  ContinuousSpace coarse;
  PetscBool corrects; /* in the current step */
  Vec work;           /* z with its ghosts */
};

/* z_e = S_ee^-1 (r_e - sum of S_en z_n over neighbours n below `below`) */
static inline void Relax(const Preconditioner p, int e, int below, const double r[], double z[])
{
  const int *neighbor = p->op->domain->mesh->neighbor + 3 * e;
  ElementVector rest, solved = {{{0}, {0}}};
  double value[6];
  ElementVectorLoad(r + 6 * e, &rest);
  for (int i = 0; i < 3; i++)
    if (neighbor[i] >= 0 && neighbor[i] < below)
      ScalarBlockSubtractSingle(p->block[e][1 + i], z + 6 * neighbor[i], &rest);
  ElementVectorStore(&rest, value);
  ScalarBlockAddSingle(p->block[e][0], value, &solved);
  ElementVectorStore(&solved, z + 6 * e);
}

static PetscErrorCode UpdateGhosts(Preconditioner p)
{
  PetscFunctionBeginUser;
  if (p->op->alone) PetscFunctionReturn(0);
  PetscCall(VecGhostUpdateBegin(p->work, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecGhostUpdateEnd(p->work, INSERT_VALUES, SCATTER_FORWARD));
  PetscFunctionReturn(0);
}

/* r[ne][2][3], z[ne + ng][2][3]: the array of p->work. */
static PetscErrorCode Precondition(Preconditioner p, const double r[], double z[])
{
  const Mesh *m = p->op->domain->mesh;
  PetscFunctionBeginUser;
  if (p->corrects) {
    PetscCall(PetscArrayzero(z, 6 * m->ne));
    PetscCall(ContinuousSpaceCorrect(p->coarse, r, z));
    PetscCall(UpdateGhosts(p));
  }
  for (int e = 0; e < m->ne; e++) Relax(p, e, p->corrects ? m->ne + m->ng : e, r, z);
  PetscCall(UpdateGhosts(p));
  for (int e = m->ne - 1; e >= 0; e--) Relax(p, e, m->ne + m->ng, r, z);
  PetscFunctionReturn(0);
}

/* PCSHELL.  On one rank z itself takes the place of p->work. */
static PetscErrorCode Apply(PC shell, Vec r, Vec z)
{
  Preconditioner p;
  const PetscScalar *from;
  PetscScalar *to;
  Vec local = z;
  PetscFunctionBeginUser;
  PetscCall(PCShellGetContext(shell, &p));
  PetscCall(VecGetArrayRead(r, &from));
  if (!p->op->alone) PetscCall(VecGhostGetLocalForm(p->work, &local));
  PetscCall(VecGetArray(local, &to));
  double *array = to; /* stays where it is while ghosts are updated */
  PetscCall(VecRestoreArray(local, &to));
  PetscCall(Precondition(p, from, array));
  PetscCall(VecRestoreArrayRead(r, &from));
  if (p->op->alone) PetscFunctionReturn(0);
  PetscCall(VecGhostRestoreLocalForm(p->work, &local));
  PetscCall(VecCopy(p->work, z));
  PetscFunctionReturn(0);
}

PetscErrorCode PreconditionerCreate(MomentumOperator *op, KSP ksp, Preconditioner *preconditioner)
{
  const Mesh *m = op->domain->mesh;
  Preconditioner p;
  PC shell;
  PetscFunctionBeginUser;
  PetscCall(PetscNew(&p));
  p->op = op;
  PetscCall(PetscMalloc1(m->ne + 1, &p->block));
  PetscCall(VecDuplicate(op->ghosted, &p->work));
  PetscCall(KSPGetPC(ksp, &shell));
  PetscCall(PCSetType(shell, PCSHELL));
  PetscCall(PCShellSetName(shell, "relaxation and continuous functions"));
  PetscCall(PCShellSetContext(shell, p));
  PetscCall(PCShellSetApply(shell, Apply));
  *preconditioner = p;
  PetscFunctionReturn(0);
}

/* The scalar operator in single precision, its diagonal blocks inverted. */
static void CopyBlocks(Preconditioner p)
{
  const Mesh *m = p->op->domain->mesh;
  for (int e = 0; e < m->ne; e++) {
    const double(*from)[9] = (const double(*)[9])p->op->block[e];
    double inverse[9];
    ScalarBlockInvert(from[0], inverse);
    for (int k = 0; k < 9; k++) p->block[e][0][k] = (float)inverse[k];
    for (int i = 1; i < 4; i++)
      for (int k = 0; k < 9 && m->neighbor[3 * e + i - 1] >= 0; k++) p->block[e][i][k] = (float)from[i][k];
  }
}

PetscErrorCode PreconditionerUpdate(Preconditioner p)
{
  const Mesh *m = p->op->domain->mesh;
  double diffusion = p->op->diffusion;
  PetscFunctionBeginUser;
  CopyBlocks(p);
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &diffusion, 1, MPI_DOUBLE, MPI_MAX, m->comm));
  p->corrects = (PetscBool)(diffusion >= DIFFUSION_COARSE);
  if (!p->corrects) PetscFunctionReturn(0);
  if (!p->coarse) PetscCall(ContinuousSpaceCreate(m, &p->coarse));
  PetscCall(ContinuousSpaceUpdate(p->coarse, (PetscBool)(diffusion >= DIFFUSION_MULTIGRID),
                                  (const double(*)[9])p->op->volume));
  PetscFunctionReturn(0);
}

PetscErrorCode PreconditionerDestroy(Preconditioner *preconditioner)
{
  Preconditioner p = *preconditioner;
  PetscFunctionBeginUser;
  if (!p) PetscFunctionReturn(0);
  PetscCall(ContinuousSpaceDestroy(&p->coarse));
  PetscCall(VecDestroy(&p->work));
  PetscCall(PetscFree(p->block));
  PetscCall(PetscFree(*preconditioner));
  PetscFunctionReturn(0);
}
