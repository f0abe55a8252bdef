#include "coupler/coupling_iteration.h"
#include "coupler/bulk_motion.h"

/* Of the shell's thickness: places that differ by less at a step's end are the same. */
#define NOTHING 1e-4

PetscErrorCode CouplingIterationCreate(MPI_Comm comm, int most, double tolerance, double thickness,
                                       CouplingIteration *t)
{
  PetscFunctionBeginUser;
  *t = (CouplingIteration){
      .comm = comm, .most = most, .tolerance = tolerance, .thickness = thickness, .n = -1};
  PetscCall(QuasiNewtonCreate(comm, &t->acceleration));
  PetscFunctionReturn(0);
}

static PetscErrorCode FreeNodes(CouplingIteration *t)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree5(t->start, t->met, t->end, t->rate, t->mobility));
  PetscFunctionReturn(0);
}

PetscErrorCode CouplingIterationDestroy(CouplingIteration *t)
{
  PetscFunctionBeginUser;
  PetscCall(FreeNodes(t));
  PetscCall(QuasiNewtonDestroy(&t->acceleration));
  PetscFunctionReturn(0);
}

/* Room for the solid's nodes; those of another mesh have no past. */
static PetscErrorCode Resize(CouplingIteration *t, const ServerSolid *solid)
{
  const size_t n = (size_t)solid->nnodes;

  PetscFunctionBeginUser;
  if (!solid->changed && t->n >= 0) PetscFunctionReturn(0);
  PetscCall(FreeNodes(t));
  PetscCall(PetscMalloc5(2 * n, &t->start, 2 * n, &t->met, 2 * n, &t->end, 2 * n, &t->rate, n, &t->mobility));
  t->n = solid->nnodes;
  t->has_rate = PETSC_FALSE;
  PetscCall(QuasiNewtonBegin(t->acceleration, -1));
  PetscFunctionReturn(0);
}

/* Root mean square of end - start, over the nodes that take part; start NULL: 0. */
static PetscErrorCode Rms(const CouplingIteration *t, const double start[], double *rms)
{
  double sum[2] = {0.0, 0.0};

  PetscFunctionBeginUser;
  for (int i = 0; i < t->n; i++) {
    if (t->mobility[i] > 0.0) continue;
    for (int k = 2 * i; k < 2 * i + 2; k++) sum[0] += PetscSqr(t->end[k] - (start ? start[k] : 0.0));
    sum[1] += 1.0;
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sum, 2, MPI_DOUBLE, MPI_SUM, t->comm));
  *rms = sum[1] > 0.0 ? sqrt(sum[0] / sum[1]) : 0.0;
  PetscFunctionReturn(0);
}

PetscErrorCode CouplingIterationBegin(CouplingIteration *t, const ServerSolid *solid, double dt,
                                      const double **u)
{
  const size_t n = (size_t)solid->nnodes;

  PetscFunctionBeginUser;
  PetscCall(Resize(t, solid));
  PetscCall(PetscArraycpy(t->start, solid->u, 2 * n));
  PetscCall(PetscArraycpy(t->mobility, solid->mobility, n));
  for (size_t k = 0; k < 2 * n; k++) t->met[k] = t->start[k] + (t->has_rate ? dt * t->rate[k] : 0.0);
  t->dt = dt;
  PetscCall(QuasiNewtonBegin(t->acceleration, 2 * solid->nnodes));
  *u = t->met;
  PetscFunctionReturn(0);
}

PetscErrorCode CouplingIterationHasConverged(CouplingIteration *t, int tries, const ServerSolid *solid,
                                             PetscBool *agree)
{
  double size;

  PetscFunctionBeginUser;
  *agree = PETSC_TRUE;
  if (t->most == 1 || solid->lost) PetscFunctionReturn(0);
  PetscCall(PetscArraycpy(t->end, t->met, 2 * (size_t)t->n));
  PetscCall(BulkMotionOnStart(solid, solid->u, t->n, t->end));
  for (int k = 0; k < 2 * t->n; k++) t->end[k] = t->mobility[k / 2] > 0.0 ? t->met[k] : t->end[k];
  PetscCall(Rms(t, t->met, &t->difference));
  PetscCall(Rms(t, NULL, &size));
  /* not so for NaN */
  *agree =
      t->difference <= fmax(t->tolerance * size, NOTHING * t->thickness / t->dt) ? PETSC_TRUE : PETSC_FALSE;
  if (solid->changed && tries == t->most) *agree = PETSC_TRUE;
  PetscFunctionReturn(0);
}

PetscErrorCode CouplingIterationNext(CouplingIteration *t, const double **u)
{
  double *next;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(2 * (size_t)t->n, &next));
  PetscCall(QuasiNewtonNext(t->acceleration, t->met, t->end, next));
  PetscCall(PetscArraycpy(t->met, next, 2 * (size_t)t->n));
  PetscCall(PetscFree(next));
  *u = t->met;
  PetscFunctionReturn(0);
}

PetscErrorCode CouplingIterationEnd(CouplingIteration *t)
{
  PetscFunctionBeginUser;
  if (t->most == 1) PetscFunctionReturn(0);
  t->has_rate = PETSC_TRUE;
  for (int k = 0; k < 2 * t->n; k++) t->rate[k] = (t->end[k] - t->start[k]) / t->dt;
  PetscFunctionReturn(0);
}
