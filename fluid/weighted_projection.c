#include "fluid/weighted_projection.h"

enum { NU = 6 }; /* velocity unknowns of an element: component, then vertex */

struct WeightedProjection_s {
  const FluidDomain *domain; /* borrowed */
  SolidCoupling solid;       /* borrowed: of the current step */
  double dt;
  double (*response)[NU][NU]; /* [entries of solid] W^-1 M */
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

static void MassMatrix(double area, double m[NU][NU])
{
  for (int i = 0; i < NU; i++)
    for (int j = 0; j < NU; j++) m[i][j] = i / 3 == j / 3 ? area / 12.0 * (i == j ? 2.0 : 1.0) : 0.0;
}

/* w = L L^T in its lower triangle; false if it is not positive definite */
static PetscBool Factor(double w[NU][NU])
{
  for (int j = 0; j < NU; j++) {
    for (int k = 0; k < j; k++) w[j][j] -= w[j][k] * w[j][k];
    if (!(w[j][j] > 0.0)) return PETSC_FALSE;
    w[j][j] = sqrt(w[j][j]);
    for (int i = j + 1; i < NU; i++) {
      for (int k = 0; k < j; k++) w[i][j] -= w[i][k] * w[j][k];
      w[i][j] /= w[j][j];
    }
  }
  return PETSC_TRUE;
}

/* x -> (L L^T)^-1 x for the columns of x */
static void SolveColumns(const double l[NU][NU], double x[NU][NU])
{
  for (int i = 0; i < NU; i++) {
    for (int k = 0; k < i; k++)
      for (int c = 0; c < NU; c++) x[i][c] -= l[i][k] * x[k][c];
    for (int c = 0; c < NU; c++) x[i][c] *= 1.0 / l[i][i];
  }
  for (int i = NU - 1; i >= 0; i--) {
    for (int k = i + 1; k < NU; k++)
      for (int c = 0; c < NU; c++) x[i][c] -= l[k][i] * x[k][c];
    for (int c = 0; c < NU; c++) x[i][c] *= 1.0 / l[i][i];
  }
}

/* response = W^-1 M */
static PetscErrorCode Response(double area, double rho_dt, const double inertia[2][3][2][3],
                               double response[NU][NU])
{
  double w[NU][NU];
  PetscFunctionBeginUser;
  MassMatrix(area, response);
  for (int i = 0; i < NU; i++)
    for (int j = 0; j < NU; j++) w[i][j] = rho_dt * response[i][j] + inertia[i / 3][i % 3][j / 3][j % 3];
  PetscCheck(Factor(w), PETSC_COMM_SELF, PETSC_ERR_NOT_CONVERGED,
             "the implicit inertia of the solid is not positive on a fluid element");
  SolveColumns((const double(*)[NU])w, response);
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
    if (IsWeighted(entry + k))
      PetscCall(Response(w->domain->geometry[e].area, s->rho[e] / s->dt, entry[k].implicit_inertia,
                         w->response[k]));
  }
  PetscFunctionReturn(0);
}

/* The response where element e has implicit inertia, else NULL. */
static const double (*ResponseAt(WeightedProjection w, int e))[NU]
{
  return IsWeighted(SolidCouplingAt(w->solid, e))
             ? (const double(*)[NU])w->response[SolidCouplingIndex(w->solid, e)]
             : NULL;
}

PetscBool WeightedProjectionBlock(WeightedProjection w, int e, double block[6][6])
{
  const ElementGeometry *g = w->domain->geometry + e;
  const double(*response)[NU] = ResponseAt(w, e);
  double half[6][NU] = {{0}}; /* transposed: of the gradients of the basis, int of grad N_q . M W^-1 */
  if (!response) return PETSC_FALSE;
  for (int j = 0; j < NU; j++) {
    double column[2][3], r[6] = {0};
    for (int c = 0; c < 2; c++) {
      const double u[3] = {response[3 * c][j], response[3 * c + 1][j], response[3 * c + 2][j]};
      P1MassApply(g->area / w->dt, u, column[c]);
    }
    P2GradientTranspose(g->g, (const double(*)[3])column, r);
    for (int q = 0; q < 6; q++) half[q][j] = r[q];
  }
  for (int q = 0; q < 6; q++) {
    for (int r = 0; r < 6; r++) block[q][r] = 0.0;
    P2GradientTranspose(g->g, (const double(*)[3])half[q], block[q]);
  }
  return PETSC_TRUE;
}

PetscBool WeightedProjectionVelocity(WeightedProjection w, int e, const double grad[3][2], double u[6])
{
  const double(*response)[NU] = ResponseAt(w, e);
  if (!response) return PETSC_FALSE;
  for (int i = 0; i < NU; i++)
    for (int j = 0; j < NU; j++) u[i] -= response[i][j] * grad[j % 3][j / 3];
  return PETSC_TRUE;
}
