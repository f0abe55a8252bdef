#include "coupler/coupling_iteration.h"

PetscErrorCode CouplingIterationCreate(MPI_Comm comm, int max_iterations, double tolerance, double thickness,
                                       CouplingIteration *t)
{
  PetscFunctionBeginUser;
  *t = (CouplingIteration){.comm = comm,
                           .max_iterations = max_iterations,
                           .tolerance = tolerance,
                           .thickness = thickness,
                           .n = -1};
  PetscCall(QuasiNewtonCreate(comm, &t->quasi_newton));
  PetscFunctionReturn(0);
}

static PetscErrorCode FreeNodes(CouplingIteration *t)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree4(t->iterate, t->result, t->explicit_fraction, t->given));
  PetscFunctionReturn(0);
}

PetscErrorCode CouplingIterationDestroy(CouplingIteration *t)
{
  PetscFunctionBeginUser;
  PetscCall(FreeNodes(t));
  PetscCall(QuasiNewtonDestroy(&t->quasi_newton));
  PetscFunctionReturn(0);
}

/* Storage for the solid's nodes; a changed mesh has no quasi-Newton columns. */
static PetscErrorCode Resize(CouplingIteration *t, const SolidState *solid)
{
  const size_t n = (size_t)solid->nnodes;

  PetscFunctionBeginUser;
  if (!solid->changed && t->n >= 0) PetscFunctionReturn(0);
  PetscCall(FreeNodes(t));
  PetscCall(PetscMalloc4(2 * n, &t->iterate, 2 * n, &t->result, n, &t->explicit_fraction, n, &t->given));
  t->n = solid->nnodes;
  PetscCall(QuasiNewtonBegin(t->quasi_newton, -1));
  PetscFunctionReturn(0);
}

/* residual = rms(e (result - iterate)), size = rms(result), over all nodes. */
static PetscErrorCode Residual(const CouplingIteration *t, double *residual, double *size)
{
  double sum[3] = {0.0, 0.0, t->n};

  PetscFunctionBeginUser;
  for (int k = 0; k < 2 * t->n; k++) {
    sum[0] += PetscSqr(t->explicit_fraction[k / 2] * (t->result[k] - t->iterate[k]));
    sum[1] += PetscSqr(t->result[k]);
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sum, 3, MPI_DOUBLE, MPI_SUM, t->comm));
  *residual = sum[2] > 0.0 ? sqrt(sum[0] / sum[2]) : 0.0;
  *size = sum[2] > 0.0 ? sqrt(sum[1] / sum[2]) : 0.0;
  PetscFunctionReturn(0);
}

PetscErrorCode CouplingIterationBegin(CouplingIteration *t, const SolidState *solid, double dt,
                                      const double predicted[], const double explicit_fraction[],
                                      const char given[])
{
  PetscFunctionBeginUser;
  PetscCall(Resize(t, solid));
  PetscCall(PetscArraycpy(t->iterate, predicted, 2 * (size_t)t->n));
  PetscCall(PetscArraycpy(t->explicit_fraction, explicit_fraction, (size_t)t->n));
  PetscCall(PetscArraycpy(t->given, given, (size_t)t->n));
  t->dt = dt;
  if (t->failures > 1) PetscCall(QuasiNewtonBegin(t->quasi_newton, -1));
  PetscCall(QuasiNewtonBegin(t->quasi_newton, 2 * t->n));
  PetscFunctionReturn(0);
}

PetscErrorCode CouplingIterationHasConverged(CouplingIteration *t, int iteration, const SolidState *solid,
                                             PetscBool *converged)
{
  double size;

  PetscFunctionBeginUser;
  *converged = PETSC_TRUE;
  if (t->max_iterations == 1 || solid->lost) PetscFunctionReturn(0);
  PetscCall(PetscArraycpy(t->result, t->iterate, 2 * (size_t)t->n));
  PetscCall(SolidStateOnStartNodes(solid, solid->u, t->n, t->result));
  for (int k = 0; k < 2 * t->n; k++)
    if (t->given[k / 2]) t->result[k] = t->iterate[k];
  PetscCall(Residual(t, &t->residual, &size));
  /* false for NaN */
  *converged = t->residual <= fmax(t->tolerance * size, NEGLIGIBLE_DISPLACEMENT * t->thickness / t->dt)
                   ? PETSC_TRUE
                   : PETSC_FALSE;
  if (*converged || iteration == t->max_iterations) t->failures = *converged ? 0 : t->failures + 1;
  PetscFunctionReturn(0);
}

PetscErrorCode CouplingIterationNext(CouplingIteration *t, const double **u)
{
  PetscFunctionBeginUser;
  PetscCall(QuasiNewtonNext(t->quasi_newton, t->iterate, t->result, t->iterate));
  *u = t->iterate;
  PetscFunctionReturn(0);
}
