#include "fluid/weighted_projection.h"

enum { N = 3 }; /* velocity unknowns of an element and component */

struct WeightedProjection_s {
  const FluidDomain *domain; /* borrowed */
  SolidCoupling solid;       /* borrowed: of the current step */
  double dt;
  double (*response)[N][N]; /* [entries of solid] W^-1 M, the same for both components */
};

PetscErrorCode WeightedProjectionCreate(const FluidDomain *domain, WeightedProjection *w)
{
  PetscFunctionBeginUser;
  PetscCall(PetscNew(w));
  (*w)->domain = domain;
  PetscFunctionReturn(0);
}

PetscErrorCode WeightedProjectionDestroy(WeightedProjection *w)
{
  PetscFunctionBeginUser;
  if (!*w) PetscFunctionReturn(0);
  PetscCall(PetscFree((*w)->response));
  PetscCall(PetscFree(*w));
  PetscFunctionReturn(0);
}

static void MassMatrix(double area, double m[N][N])
{
  for (int i = 0; i < N; i++)
    for (int j = 0; j < N; j++) m[i][j] = area / 12.0 * (i == j ? 2.0 : 1.0);
}

/* w = L L^T in its lower triangle; false if it is not positive definite */
static PetscBool Factor(double w[N][N])
{
  for (int j = 0; j < N; j++) {
    for (int k = 0; k < j; k++) w[j][j] -= w[j][k] * w[j][k];
    if (!(w[j][j] > 0.0)) return PETSC_FALSE;
    w[j][j] = sqrt(w[j][j]);
    for (int i = j + 1; i < N; i++) {
      for (int k = 0; k < j; k++) w[i][j] -= w[i][k] * w[j][k];
      w[i][j] /= w[j][j];
    }
  }
  return PETSC_TRUE;
}

/* x -> (L L^T)^-1 x for the columns of x */
static void SolveColumns(const double l[N][N], double x[N][N])
{
  for (int i = 0; i < N; i++) {
    for (int k = 0; k < i; k++)
      for (int c = 0; c < N; c++) x[i][c] -= l[i][k] * x[k][c];
    for (int c = 0; c < N; c++) x[i][c] *= 1.0 / l[i][i];
  }
  for (int i = N - 1; i >= 0; i--) {
    for (int k = i + 1; k < N; k++)
      for (int c = 0; c < N; c++) x[i][c] -= l[k][i] * x[k][c];
    for (int c = 0; c < N; c++) x[i][c] *= 1.0 / l[i][i];
  }
}

/* x -> W^-1 x for the columns of x */
static PetscErrorCode DivideColumns(double area, double rho_dt, const double inertia[N][N], double x[N][N])
{
  double w[N][N];
  PetscFunctionBeginUser;
  MassMatrix(area, w);
  for (int i = 0; i < N; i++)
    for (int j = 0; j < N; j++) w[i][j] = rho_dt * w[i][j] + inertia[i][j];
  PetscCheck(Factor(w), PETSC_COMM_SELF, PETSC_ERR_NOT_CONVERGED,
             "the implicit inertia of the solid is not positive on a fluid element");
  SolveColumns((const double(*)[N])w, x);
  PetscFunctionReturn(0);
}

PetscErrorCode WeightedProjectionSolve(double area, double rho_dt, const double inertia[N][N], double v[6])
{
  double columns[N][N] = {{0.0}};
  PetscFunctionBeginUser;
  for (int i = 0; i < 2 * N; i++) columns[i % N][i / N] = v[i];
  PetscCall(DivideColumns(area, rho_dt, inertia, columns));
  for (int i = 0; i < 2 * N; i++) v[i] = columns[i % N][i / N];
  PetscFunctionReturn(0);
}

static PetscBool IsWeighted(const CoracleCoupling *k)
{
  return k && k->flags & CORACLE_HAS_INERTIA ? PETSC_TRUE : PETSC_FALSE;
}

PetscErrorCode WeightedProjectionPrepare(WeightedProjection w, const WeightedProjectionStep *s,
                                         PetscBool *active)
{
  int n, any = 0;
  const CoracleCoupling *entry = SolidCouplingEntries(s->solid, &n);
  PetscFunctionBeginUser;
  for (int k = 0; k < n; k++) any |= IsWeighted(entry + k);
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &any, 1, MPI_INT, MPI_LOR, w->domain->mesh->comm));
  *active = (PetscBool)any;
  w->solid = s->solid;
  w->dt = s->dt;
  PetscCall(PetscFree(w->response));
  PetscCall(PetscMalloc1(n, &w->response));
  for (int k = 0; k < n && s->inertia; k++) {
    const int e = entry[k].element;
    const double area = w->domain->geometry[e].area;
    if (!IsWeighted(entry + k)) continue;
    MassMatrix(area, w->response[k]);
    PetscCall(DivideColumns(area, s->rho[e] / s->dt, entry[k].implicit_inertia, w->response[k]));
  }
  PetscFunctionReturn(0);
}

/* The response where element e has implicit inertia, else NULL. */
static const double (*ResponseAt(WeightedProjection w, int e))[N]
{
  return IsWeighted(SolidCouplingAt(w->solid, e))
             ? (const double(*)[N])w->response[SolidCouplingIndex(w->solid, e)]
             : NULL;
}

PetscBool WeightedProjectionBlock(WeightedProjection w, int e, double block[6][6])
{
  const ElementGeometry *g = w->domain->geometry + e;
  const double(*response)[N] = ResponseAt(w, e);
  if (!response) return PETSC_FALSE;
  for (int r = 0; r < 6; r++) {
    double basis[6] = {0}, grad[3][2], moved[2][3];
    basis[r] = 1.0;
    P2Gradient(g->g, basis, grad);
    for (int c = 0; c < 2; c++) {
      double u[3] = {0};
      for (int i = 0; i < 9; i++) u[i / 3] += response[i / 3][i % 3] * grad[i % 3][c];
      P1MassApply(g->area / w->dt, u, moved[c]);
    }
    for (int q = 0; q < 6; q++) block[r][q] = 0.0;
    P2GradientTranspose(g->g, (const double(*)[3])moved, block[r]);
  }
  return PETSC_TRUE;
}

PetscBool WeightedProjectionVelocity(WeightedProjection w, int e, const double grad[3][2], double u[6])
{
  const double(*response)[N] = ResponseAt(w, e);
  if (!response) return PETSC_FALSE;
  for (int c = 0; c < 2; c++)
    for (int i = 0; i < N; i++)
      for (int j = 0; j < N; j++) u[3 * c + i] -= response[i][j] * grad[j][c];
  return PETSC_TRUE;
}
