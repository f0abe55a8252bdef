#include "fluid/momentum/preconditioner.h"
#include "fluid/discretization/ghosted.h"
#include "fluid/momentum/continuous_space.h"

struct Preconditioner_s {
  MomentumOperator *op; /* borrowed */
  SingleBlocks
      *block;       /* [ne + 1] S_ee^-1, then -S_ee^-1 S_en of the neighbours; the last is only read over */
  const int *dense; /* [ne] the index of the element's dense block, or -1; borrowed */
  int dense_capacity;
  float (*response)[36]; /* [dense_capacity] (S_ee + D_e)^-1 S_ee, column-major */
  SingleVector *start;   /* [ne] S_ee^-1 r_e */
  SingleVector *z;       /* [ne + ng] */
  ContinuousSpace coarse;
  PetscBool corrects; /* in the current step */
  Vec ghosted;        /* z with its ghosts, where there are other ranks */
};

/* z = (S_ee + D_e)^-1 S_ee z */
static inline void Respond(const float response[36], SinglePair *z)
{
  float from[8], to[8] = {0};
  SingleStore(z, from);
  for (int j = 0; j < 6; j++)
    for (int i = 0; i < 6; i++) to[i + i / 3] += response[6 * j + i] * from[j + j / 3];
  SingleLoad(to, z);
}

/* z_e = (S_ee + D_e)^-1 (r_e - sum of S_en z_n over neighbours n below `below`).  Each neighbour has a sum of its own: the last one met is known last. */
static inline void Relax(const Preconditioner p, int e, int below)
{
  const int *neighbor = p->op->domain->mesh->neighbor + 3 * e;
  SinglePair sum[3] = {{{{0}, {0}}}, {{{0}, {0}}}, {{{0}, {0}}}}, z;
  SingleLoad(p->start[e], &z);
  for (int i = 0; i < 3; i++)
    if (neighbor[i] >= 0 && neighbor[i] < below)
      SingleBlockAdd(p->block[e][1 + i], p->z[neighbor[i]], sum + i);
  for (int c = 0; c < 2; c++) z.c[c] += (sum[0].c[c] + sum[1].c[c]) + sum[2].c[c];
  if (p->dense[e] >= 0) Respond(p->response[p->dense[e]], &z);
  SingleStore(&z, p->z[e]);
}

static inline void Start(const Preconditioner p, int e, const double r[])
{
  SingleVector from;
  SinglePair start = {{{0}, {0}}};
  SingleFromDouble(r + 6 * e, from);
  SingleBlockAdd(p->block[e][0], from, &start);
  SingleStore(&start, p->start[e]);
}

static PetscErrorCode UpdateGhosts(Preconditioner p)
{
  const Mesh *m = p->op->domain->mesh;
  PetscScalar *v;
  PetscFunctionBeginUser;
  if (p->op->alone) PetscFunctionReturn(0);
  PetscCall(VecGetArray(p->ghosted, &v));
  for (int e = 0; e < m->ne; e++) SingleToDouble(p->z[e], v + 6 * e);
  PetscCall(VecRestoreArray(p->ghosted, &v));
  PetscCall(GhostedUpdate(p->ghosted));
  PetscCall(GhostedGetArray(p->ghosted, &v));
  for (int e = m->ne; e < m->ne + m->ng; e++) SingleFromDouble(v + 6 * e, p->z[e]);
  PetscCall(GhostedRestoreArray(p->ghosted, &v));
  PetscFunctionReturn(0);
}

/* z ~ S^-1 r, both [ne][2][3] */
static PetscErrorCode Precondition(Preconditioner p, const double r[], double z[])
{
  const Mesh *m = p->op->domain->mesh;
  const int all = m->ne + m->ng;
  PetscFunctionBeginUser;
  if (p->corrects) {
    PetscCall(ContinuousSpaceCorrect(p->coarse, r, p->z));
    PetscCall(UpdateGhosts(p));
  }
  for (int e = 0; e < m->ne; e++) {
    Start(p, e, r);
    Relax(p, e, p->corrects ? all : e);
  }
  PetscCall(UpdateGhosts(p));
  for (int e = m->ne - 1; e >= 0; e--) {
    Relax(p, e, all);
    SingleToDouble(p->z[e], z + 6 * e);
  }
  PetscFunctionReturn(0);
}

/* PCSHELL. */
static PetscErrorCode Apply(PC shell, Vec r, Vec z)
{
  Preconditioner p;
  const PetscScalar *from;
  PetscScalar *to;
  PetscFunctionBeginUser;
  PetscCall(PCShellGetContext(shell, &p));
  PetscCall(VecGetArrayRead(r, &from));
  PetscCall(VecGetArrayWrite(z, &to));
  PetscCall(Precondition(p, from, to));
  PetscCall(VecRestoreArrayWrite(z, &to));
  PetscCall(VecRestoreArrayRead(r, &from));
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
  PetscCall(PetscCalloc1(m->ne + 1, &p->block));
  PetscCall(PetscMalloc2(m->ne, &p->start, m->ne + m->ng, &p->z));
  p->dense = op->dense_at;
  if (!op->alone) PetscCall(VecDuplicate(op->ghosted, &p->ghosted));
  PetscCall(KSPGetPC(ksp, &shell));
  PetscCall(PCSetType(shell, PCSHELL));
  PetscCall(PCShellSetName(shell, "relaxation and continuous functions"));
  PetscCall(PCShellSetContext(shell, p));
  PetscCall(PCShellSetApply(shell, Apply));
  *preconditioner = p;
  PetscFunctionReturn(0);
}

/* The blocks that Relax needs. */
static void SetBlocks(Preconditioner p)
{
  const Mesh *m = p->op->domain->mesh;
  for (int e = 0; e < m->ne; e++) {
    const double(*from)[9] = (const double(*)[9])p->op->block[e];
    double inverse[9];
    ScalarBlockInvert(from[0], inverse);
    for (int k = 0; k < 9; k++) p->block[e][0][k] = (float)inverse[k];
    for (int k = 0; k < 9; k++) inverse[k] = -inverse[k];
    for (int i = 1; i < 4; i++)
      if (m->neighbor[3 * e + i - 1] >= 0) SingleBlockProduct(inverse, from[i], p->block[e][i]);
  }
}

/* b -> a^-1 b of n columns of 6, a 6 x 6, column-major; a's symmetric part is positive definite, so that no pivot is 0. */
static void Eliminate(double a[36], int n, double b[])
{
  for (int k = 0; k < 6; k++) {
    const double scale = 1.0 / a[7 * k];
    for (int j = k + 1; j < 6; j++) a[6 * j + k] *= scale;
    for (int j = 0; j < n; j++) b[6 * j + k] *= scale;
    for (int i = 0; i < 6; i++) {
      const double factor = i == k ? 0.0 : a[6 * k + i];
      for (int j = k + 1; j < 6; j++) a[6 * j + i] -= factor * a[6 * j + k];
      for (int j = 0; j < n; j++) b[6 * j + i] -= factor * b[6 * j + k];
    }
  }
}

/* Of dense element k. */
static void FindResponse(Preconditioner p, int k)
{
  const int e = p->op->dense_element[k];
  const double *scalar = p->op->block[e][0];
  double a[36], response[36] = {0.0};
  memcpy(a, p->op->dense[k], sizeof a);
  for (int c = 0; c < 2; c++)
    for (int i = 0; i < 9; i++) {
      const int at = 6 * (3 * c + i / 3) + 3 * c + i % 3;
      a[at] += scalar[i];
      response[at] = scalar[i];
    }
  Eliminate(a, 6, response);
  for (int i = 0; i < 36; i++) p->response[k][i] = (float)response[i];
}

static PetscErrorCode FindResponses(Preconditioner p)
{
  PetscFunctionBeginUser;
  if (p->op->ndense > p->dense_capacity) {
    p->dense_capacity = p->op->dense_capacity;
    PetscCall(PetscFree(p->response));
    PetscCall(PetscMalloc1(p->dense_capacity, &p->response));
  }
  for (int k = 0; k < p->op->ndense; k++) FindResponse(p, k);
  PetscFunctionReturn(0);
}

void PreconditionerSolveElement(Preconditioner p, int e, const double r[6], double z[6])
{
  double a[36] = {0.0};
  if (p->dense[e] >= 0) memcpy(a, p->op->dense[p->dense[e]], sizeof a);
  for (int c = 0; c < 2; c++)
    for (int i = 0; i < 9; i++) a[6 * (3 * c + i / 3) + 3 * c + i % 3] += p->op->block[e][0][i];
  memcpy(z, r, 6 * sizeof *z);
  Eliminate(a, 1, z);
}

PetscErrorCode PreconditionerUpdate(Preconditioner p)
{
  const Mesh *m = p->op->domain->mesh;
  double diffusion = p->op->diffusion;
  PetscFunctionBeginUser;
  SetBlocks(p);
  PetscCall(FindResponses(p));
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
  PetscCall(VecDestroy(&p->ghosted));
  PetscCall(PetscFree(p->block));
  PetscCall(PetscFree(p->response));
  PetscCall(PetscFree2(p->start, p->z));
  PetscCall(PetscFree(*preconditioner));
  PetscFunctionReturn(0);
}
