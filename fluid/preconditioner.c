/* When the momentum equation's preconditioner is made anew, and what keeps it useful in between. */
#include "fluid_impl.h"

/* Made anew when it is this many steps old, when dt has changed by this fraction, and when the iterations
 * that it has taken more than at first add up to what a factorisation costs. */
#define PRECONDITIONER_AGE 25
#define PRECONDITIONER_COST 9
#define PRECONDITIONER_DT 0.1
/* A row is scaled when its diagonal block has changed by more than this fraction. */
#define ROW_CHANGE 0.05

PetscErrorCode PreconditionerCreate(Fluid f)
{
  return PetscMalloc1(36 * f->mesh->ne, &f->preconditioned);
}

PetscErrorCode PreconditionerDestroy(Fluid f)
{
  return PetscFree(f->preconditioned);
}

/* a <- b a, 6 x 6, column-major */
static void MultiplyBlock(const double b[36], double a[36])
{
  double product[36] = {0};
  for (int j = 0; j < 6; j++)
    for (int k = 0; k < 6; k++)
      for (int i = 0; i < 6; i++) product[6 * j + i] += b[6 * k + i] * a[6 * j + k];
  memcpy(a, product, sizeof product);
}

/* a <- the inverse of a by Gauss and Jordan; without pivots, as the symmetric part is positive definite */
static void InvertBlock(double a[36])
{
  for (int p = 0; p < 6; p++) {
    const double inverse = 1.0 / a[7 * p];
    a[7 * p] = 1.0;
    for (int j = 0; j < 6; j++) a[6 * j + p] *= inverse;
    for (int i = 0; i < 6; i++) {
      const double factor = a[6 * p + i];
      if (i == p) continue;
      a[6 * p + i] = 0.0;
      for (int j = 0; j < 6; j++) a[6 * j + i] -= factor * a[6 * j + p];
    }
  }
}

static PetscBool BlockDiffers(const double a[36], const double b[36])
{
  double scale = 0.0, difference = 0.0;
  for (int k = 0; k < 36; k++) {
    scale = fmax(scale, fabs(a[k]));
    difference = fmax(difference, fabs(a[k] - b[k]));
  }
  return (PetscBool)(difference > ROW_CHANGE * scale);
}

/* While the preconditioner is kept the solid moves on, and its stiff terms, all in diagonal blocks, with it.
 * Rows whose block B has become B' are multiplied by B B'^-1: the preconditioner finds the blocks that it was
 * made of. */
static PetscErrorCode ScaleChangedRows(Fluid f)
{
  const Mesh *m = f->mesh;
  Mat diagonal, offdiagonal;
  const PetscInt *garray;
  PetscScalar *ad, *ao = NULL, *load;
  PetscFunctionBeginUser;
  PetscCall(MomentumParts(f, &diagonal, &offdiagonal, &garray));
  PetscCall(MatSeqBAIJGetArray(diagonal, &ad));
  if (offdiagonal) PetscCall(MatSeqBAIJGetArray(offdiagonal, &ao));
  PetscCall(VecGetArray(f->load, &load));
  for (int e = 0; e < m->ne; e++) {
    double scale[36], scaled[6] = {0};
    if (!BlockDiffers(f->preconditioned + 36 * e, ad + 36 * f->slot[4 * e])) continue;
    memcpy(scale, ad + 36 * f->slot[4 * e], sizeof scale);
    InvertBlock(scale);
    MultiplyBlock(f->preconditioned + 36 * e, scale);
    for (int i = 0; i < 4; i++) {
      const PetscInt k = f->slot[4 * e + i];
      if (i > 0 && m->neighbor[3 * e + i - 1] < 0) continue;
      MultiplyBlock(scale, k >= 0 ? ad + 36 * k : ao + 36 * (-1 - k));
    }
    for (int j = 0; j < 6; j++)
      for (int i = 0; i < 6; i++) scaled[i] += scale[6 * j + i] * load[6 * e + j];
    memcpy(load + 6 * e, scaled, sizeof scaled);
  }
  PetscCall(VecRestoreArray(f->load, &load));
  if (offdiagonal) PetscCall(MatSeqBAIJRestoreArray(offdiagonal, &ao));
  PetscCall(MatSeqBAIJRestoreArray(diagonal, &ad));
  PetscFunctionReturn(0);
}

static PetscErrorCode RememberDiagonal(Fluid f)
{
  Mat diagonal, offdiagonal;
  const PetscInt *garray;
  PetscScalar *ad;
  PetscFunctionBeginUser;
  PetscCall(MomentumParts(f, &diagonal, &offdiagonal, &garray));
  PetscCall(MatSeqBAIJGetArray(diagonal, &ad));
  for (int e = 0; e < f->mesh->ne; e++)
    memcpy(f->preconditioned + 36 * e, ad + 36 * f->slot[4 * e], 36 * sizeof *ad);
  PetscCall(MatSeqBAIJRestoreArray(diagonal, &ad));
  PetscFunctionReturn(0);
}

PetscErrorCode PreconditionerChoose(Fluid f, double dt)
{
  const PetscBool keep = f->preconditioner_age > 0 && f->preconditioner_age < PRECONDITIONER_AGE &&
                         fabs(dt - f->preconditioner_dt) < PRECONDITIONER_DT * f->preconditioner_dt &&
                         f->extra_iterations < PRECONDITIONER_COST;
  PetscFunctionBeginUser;
  PetscCall(KSPSetReusePreconditioner(f->momentum_ksp, keep));
  PetscCall(keep ? ScaleChangedRows(f) : RememberDiagonal(f));
  if (!keep) {
    f->preconditioner_age = 0;
    f->preconditioner_dt = dt;
  }
  PetscFunctionReturn(0);
}

void PreconditionerUsed(Fluid f)
{
  if (f->preconditioner_age++ == 0) {
    f->fresh_iterations = f->stats.momentum_iterations;
    f->extra_iterations = 0;
  }
  f->extra_iterations += f->stats.momentum_iterations - f->fresh_iterations;
}
