#include "coupler/coupling_iteration.h"

/* Part of the shell's thickness: displacements over a step that differ by less are taken as equal. */
#define NEGLIGIBLE_DISPLACEMENT 1e-4

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
  PetscCall(PetscFree5(t->start, t->iterate, t->result, t->acceleration, t->mobility));
  PetscFunctionReturn(0);
}

PetscErrorCode CouplingIterationDestroy(CouplingIteration *t)
{
  PetscFunctionBeginUser;
  PetscCall(FreeNodes(t));
  PetscCall(QuasiNewtonDestroy(&t->quasi_newton));
  PetscFunctionReturn(0);
}

/* Storage for the solid's nodes; a changed mesh has neither an acceleration nor quasi-Newton columns. */
static PetscErrorCode Resize(CouplingIteration *t, const SolidState *solid)
{
  const size_t n = (size_t)solid->nnodes;

  PetscFunctionBeginUser;
  if (!solid->changed && t->n >= 0) PetscFunctionReturn(0);
  PetscCall(FreeNodes(t));
  PetscCall(PetscMalloc5(2 * n, &t->start, 2 * n, &t->iterate, 2 * n, &t->result, 2 * n, &t->acceleration, n,
                         &t->mobility));
  t->n = solid->nnodes;
  t->has_acceleration = PETSC_FALSE;
  PetscCall(QuasiNewtonBegin(t->quasi_newton, -1));
  PetscFunctionReturn(0);
}

/* Root mean square of result - reference over the nodes that take part; reference NULL: 0. */
static PetscErrorCode Rms(const CouplingIteration *t, const double reference[], double *rms)
{
  double sum[2] = {0.0, 0.0};

  PetscFunctionBeginUser;
  for (int i = 0; i < t->n; i++) {
    if (t->mobility[i] > 0.0) continue;
    for (int k = 2 * i; k < 2 * i + 2; k++)
      sum[0] += PetscSqr(t->result[k] - (reference ? reference[k] : 0.0));
    sum[1] += 1.0;
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sum, 2, MPI_DOUBLE, MPI_SUM, t->comm));
  *rms = sum[1] > 0.0 ? sqrt(sum[0] / sum[1]) : 0.0;
  PetscFunctionReturn(0);
}

PetscErrorCode CouplingIterationBegin(CouplingIteration *t, const SolidState *solid, double dt,
                                      const double **u)
{
  const size_t n = (size_t)solid->nnodes;

  PetscFunctionBeginUser;
  PetscCall(Resize(t, solid));
  PetscCall(PetscArraycpy(t->start, solid->u, 2 * n));
  PetscCall(PetscArraycpy(t->mobility, solid->mobility, n));
  for (size_t k = 0; k < 2 * n; k++)
    t->iterate[k] = t->start[k] + (t->has_acceleration ? dt * t->acceleration[k] : 0.0);
  t->dt = dt;
  PetscCall(QuasiNewtonBegin(t->quasi_newton, 2 * solid->nnodes));
  *u = t->iterate;
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
  for (int k = 0; k < 2 * t->n; k++) t->result[k] = t->mobility[k / 2] > 0.0 ? t->iterate[k] : t->result[k];
  PetscCall(Rms(t, t->iterate, &t->residual));
  PetscCall(Rms(t, NULL, &size));
  /* false for NaN */
  *converged = t->residual <= fmax(t->tolerance * size, NEGLIGIBLE_DISPLACEMENT * t->thickness / t->dt)
                   ? PETSC_TRUE
                   : PETSC_FALSE;
  if (solid->changed && iteration == t->max_iterations) *converged = PETSC_TRUE;
  PetscFunctionReturn(0);
}

PetscErrorCode CouplingIterationNext(CouplingIteration *t, const double **u)
{
  double *next;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(2 * (size_t)t->n, &next));
  PetscCall(QuasiNewtonNext(t->quasi_newton, t->iterate, t->result, next));
  PetscCall(PetscArraycpy(t->iterate, next, 2 * (size_t)t->n));
  PetscCall(PetscFree(next));
  *u = t->iterate;
  PetscFunctionReturn(0);
}

PetscErrorCode CouplingIterationEnd(CouplingIteration *t)
{
  PetscFunctionBeginUser;
  if (t->max_iterations == 1) PetscFunctionReturn(0);
  t->has_acceleration = PETSC_TRUE;
  for (int k = 0; k < 2 * t->n; k++) t->acceleration[k] = (t->result[k] - t->start[k]) / t->dt;
  PetscFunctionReturn(0);
}
