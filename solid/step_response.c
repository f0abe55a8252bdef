#include "solid/springs.h"
#include "solid/step_response_impl.h"

/* Of the conjugate gradients: after so many the result, then smoothed less, is taken as it is. */
enum { MAX_ITERATIONS = 1000 };
#define RATIO 1.1 /* of successive c0 */

static PetscErrorCode Create(Solid s, StepResponse *response)
{
  const size_t n = (size_t)s->nnodes, ne = (size_t)s->elements.n, nsix = (size_t)s->elements.nsix;
  const size_t most = (size_t)JointsActive(s->joints);
  StepResponse a;
  double unused[8][8];
  PetscFunctionBeginUser;
  PetscCall(PetscNew(&a));
  a->nnodes = s->nnodes;
  a->nelements = s->elements.n;
  a->nsix = s->elements.nsix;
  PetscCall(PetscMalloc4(3 * ne, &a->element, 4 * most, &a->joint, n + 1, &a->start, 9 * ne, &a->slot));
  PetscCall(PetscMalloc2(6 * nsix, &a->six, 36 * nsix, &a->six_slot));
  PetscCall(PetscMalloc5(n, &a->part, n, &a->owned, n, &a->diagonal, n, &a->weight, n, &a->turn));
  PetscCall(PetscCalloc1(2 * n, &a->held));
  PetscCall(PetscMalloc4(2 * n, &a->r, 2 * n, &a->z, 2 * n, &a->p, 2 * n, &a->q));
  PetscCall(PetscArraycpy(a->element, s->element, 3 * ne));
  for (int k = 0; k < 6 * a->nsix; k++)
    a->six[k] = s->element[3 * (s->elements.six_first[k / 6] + k % 3) + k % 6 / 3];
  for (int k = 0; k < JointsActive(s->joints); k++)
    a->njoints += JointsStiffness(s->joints, s, k, a->joint + 4 * a->njoints, unused);
  PetscCall(StepMatrixCreate(a));
  PetscCall(StepFactorCreate(a));
  *response = a;
  PetscFunctionReturn(0);
}

PetscErrorCode StepResponseDestroy(StepResponse *response)
{
  StepResponse a = *response;
  PetscFunctionBeginUser;
  if (!a) PetscFunctionReturn(0);
  PetscCall(PCDestroy(&a->factor));
  PetscCall(MatDestroy(&a->matrix));
  PetscCall(VecDestroy(&a->right));
  PetscCall(VecDestroy(&a->left));
  PetscCall(PetscFree4(a->element, a->joint, a->start, a->slot));
  PetscCall(PetscFree2(a->six, a->six_slot));
  PetscCall(PetscFree5(a->part, a->owned, a->diagonal, a->weight, a->turn));
  PetscCall(PetscFree4(a->r, a->z, a->p, a->q));
  PetscCall(PetscFree(a->held));
  PetscCall(PetscFree(a->column));
  PetscCall(PetscFree(a->block));
  PetscCall(PetscFree(*response));
  PetscFunctionReturn(0);
}

/* The pattern fits the elements as they are, and neither then nor now a joint is active. */
static PetscErrorCode IsPresent(const StepResponse a, Solid s, PetscBool *present)
{
  PetscFunctionBeginUser;
  *present =
      a && a->nnodes == s->nnodes && !a->njoints && !JointsActive(s->joints) ? PETSC_TRUE : PETSC_FALSE;
  if (*present) PetscCall(PetscArraycmp(a->element, s->element, 3 * (size_t)a->nelements, present));
  PetscFunctionReturn(0);
}

/* Owners, and by how many ranks nodes are shared. */
static PetscErrorCode CountRanks(StepResponse a, Solid s)
{
  PetscFunctionBeginUser;
  for (int i = 0; i < a->nnodes; i++) {
    a->owned[i] = SolidOwns(s, i) ? 1.0 : 0.0;
    a->part[i] = 1.0;
  }
  PetscCall(CopiesSum(s->copies, 1, a->part));
  for (int i = 0; i < a->nnodes; i++) a->part[i] = 1.0 / a->part[i];
  PetscFunctionReturn(0);
}

/* Another set of what is held makes the factor at rest another. */
static PetscErrorCode FindHeld(StepResponse a, Solid s)
{
  const size_t n = 2 * (size_t)a->nnodes;
  PetscBool same;
  char *before;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(n, &before));
  PetscCall(PetscArraycpy(before, a->held, n));
  for (int k = 0; k < 2 * a->nnodes; k++) a->held[k] = s->inverse_mass[k / 2] == 0.0;
  for (int k = 0; k < s->nprescribed; k++) {
    const PrescribedMotion *d = &s->motion[s->prescribed[k].motion];
    for (int c = 0; c < 2 && PrescribedActs(d, s->stats.t); c++)
      if (d->prescribed[c]) a->held[2 * s->prescribed[k].node + c] = 1;
  }
  PetscCall(PetscArraycmp(before, a->held, n, &same));
  if (!same) a->c0 = 0.0;
  PetscCall(PetscFree(before));
  PetscFunctionReturn(0);
}

PetscBool StepResponseHolds(Solid s, int k)
{
  return (PetscBool)s->response->held[k];
}

/* The factor at rest, unless there is one. */
static PetscErrorCode FactorAtRest(StepResponse a, Solid s)
{
  const double c0 = pow(RATIO, round(log(a->c) / log(RATIO)));
  PetscFunctionBeginUser;
  if (a->c0 == c0) PetscFunctionReturn(0);
  a->c0 = c0;
  PetscCall(StepMatrixAssemble(a, s, s->rest));
  PetscCall(StepFactorUpdate(a, s, c0));
  PetscFunctionReturn(0);
}

PetscErrorCode StepResponseUpdate(Solid s)
{
  PetscBool present;
  PetscFunctionBeginUser;
  PetscCall(IsPresent(s->response, s, &present));
  if (!present) {
    PetscCall(StepResponseDestroy(&s->response));
    PetscCall(Create(s, &s->response));
  }
  const StepResponse a = s->response;
  PetscCall(CountRanks(a, s));
  PetscCall(FindHeld(a, s));
  a->c = 0.25 * s->dt * s->dt;
  if (a->c == 0.0) PetscFunctionReturn(0);
  if (!a->njoints) PetscCall(FactorAtRest(a, s));
  PetscCall(StepMatrixAssemble(a, s, s->x));
  PetscCall(StepMatrixAddJoints(a, s));
  PetscCall(SpringsStiffness(s, a->spring));
  if (a->njoints) PetscCall(StepFactorUpdate(a, s, a->c));
  PetscCall(StepFactorWeigh(a, s));
  StepFactorTurn(a, s, a->njoints ? PETSC_FALSE : PETSC_TRUE);
  PetscFunctionReturn(0);
}

/* sum over the nodes of a.b, and of a.b times weight[nnodes] */
static PetscErrorCode Dot(StepResponse r, Solid s, const double a[], const double b[], const double weight[],
                          double *dot)
{
  double sum = 0.0;
  PetscFunctionBeginUser;
  for (int i = 0; i < r->nnodes; i++)
    sum += r->owned[i] * (weight ? weight[i] : 1.0) * (a[2 * i] * b[2 * i] + a[2 * i + 1] * b[2 * i + 1]);
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, s->comm));
  *dot = sum;
  PetscFunctionReturn(0);
}

/* From d itself: exact at once where it is a rigid motion. */
PetscErrorCode StepResponseApply(Solid s, double tolerance, double d[])
{
  const StepResponse a = s->response;
  const int n = 2 * a->nnodes;
  double *r = a->r, *z = a->z, *p = a->p, *q = a->q, rz, next, pq, rr, size;
  PetscFunctionBeginUser;
  if (a->c == 0.0) PetscFunctionReturn(0);
  PetscCall(StepMatrixMultiply(a, s, d, r));
  for (int k = 0; k < n; k++) r[k] *= -a->c;
  PetscCall(Dot(a, s, d, d, s->mass, &size));
  PetscCall(Dot(a, s, r, r, s->inverse_mass, &rr));
  PetscCall(PetscArrayzero(p, n));
  rz = 1.0;
  for (int i = 0; i < MAX_ITERATIONS && rr > tolerance * tolerance * size; i++) {
    PetscCall(StepFactorApply(a, s, r, z));
    PetscCall(Dot(a, s, r, z, NULL, &next));
    for (int k = 0; k < n; k++) p[k] = z[k] + next / rz * p[k];
    rz = next;
    PetscCall(StepMatrixMultiply(a, s, p, q));
    for (int k = 0; k < n; k++) q[k] = a->c * q[k] + s->mass[k / 2] * p[k];
    PetscCall(Dot(a, s, p, q, NULL, &pq));
    for (int k = 0; k < n; k++) {
      d[k] += rz / pq * p[k];
      r[k] -= rz / pq * q[k];
    }
    PetscCall(Dot(a, s, r, r, s->inverse_mass, &rr));
    s->stats.response_iterations++;
  }
  PetscFunctionReturn(0);
}
