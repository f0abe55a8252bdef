#include "fluid/weighted_projection.h"
#include "fluid/solver_options.h"

#define ITERATIONS_MAX 8 /* with an old factor, before it is made anew */
enum { NU = 6 };         /* velocity unknowns of an element: component, then vertex */

struct WeightedProjection_s {
  const FluidDomain *domain; /* borrowed */
  SolidCoupling solid;       /* borrowed: of the current step */
  Mat matrix, factored;      /* now, and when it was factored last */
  KSP ksp;
  int iterations;             /* of the last solve */
  double (*response)[NU][NU]; /* [entries of solid] W^-1 M */
};

PetscErrorCode WeightedProjectionCreate(const FluidDomain *domain, WeightedProjection *w)
{
  PetscFunctionBeginUser;
  PetscCall(PetscNew(w));
  (*w)->domain = domain;
  PetscFunctionReturn(0);
}

/* When implicit inertia appears for the first time. */
static PetscErrorCode CreateSolver(WeightedProjection w, Mat laplacian)
{
  PetscFunctionBeginUser;
  PetscCall(SolverCreateDirect(w->domain->mesh->comm, "pressure_weighted_", KSPCG, &w->ksp));
  PetscCall(KSPSetTolerances(w->ksp, 1e-7, 1e-50, 1e5, 500));
  PetscCall(KSPSetFromOptions(w->ksp));
  PetscCall(MatDuplicate(laplacian, MAT_COPY_VALUES, &w->matrix));
  PetscCall(MatSetOption(w->matrix, MAT_SPD, PETSC_TRUE));
  w->iterations = ITERATIONS_MAX + 1;
  PetscFunctionReturn(0);
}

PetscErrorCode WeightedProjectionDestroy(WeightedProjection *w)
{
  PetscFunctionBeginUser;
  if (!*w) PetscFunctionReturn(0);
  PetscCall(KSPDestroy(&(*w)->ksp));
  PetscCall(MatDestroy(&(*w)->matrix));
  PetscCall(MatDestroy(&(*w)->factored));
  PetscCall(PetscFree((*w)->response));
  PetscCall(PetscFree(*w));
  PetscFunctionReturn(0);
}

/* Factors the matrix as it is now, if the last factor has become a bad preconditioner. */
static PetscErrorCode Refactor(WeightedProjection w)
{
  PetscFunctionBeginUser;
  if (w->iterations > ITERATIONS_MAX) {
    if (!w->factored) PetscCall(MatDuplicate(w->matrix, MAT_COPY_VALUES, &w->factored));
    PetscCall(MatCopy(w->matrix, w->factored, SAME_NONZERO_PATTERN));
    PetscCall(MatSetOption(w->factored, MAT_SPD, PETSC_TRUE));
  }
  PetscCall(KSPSetOperators(w->ksp, w->matrix, w->factored));
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
  for (int c = 0; c < NU; c++) {
    for (int i = 0; i < NU; i++) {
      for (int k = 0; k < i; k++) x[i][c] -= l[i][k] * x[k][c];
      x[i][c] /= l[i][i];
    }
    for (int i = NU - 1; i >= 0; i--) {
      for (int k = i + 1; k < NU; k++) x[i][c] -= l[k][i] * x[k][c];
      x[i][c] /= l[i][i];
    }
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

/* What implicit inertia changes in the pressure's matrix:
 * change[q][r] = int of grad N_q . (M W^-1 M/dt - M/rho) grad N_r over the P2 basis */
static void MatrixChange(const ElementGeometry *g, double rho, double dt, const double response[NU][NU],
                         double change[6][6])
{
  double m[NU][NU], d[NU][NU], grad[6][NU];
  MassMatrix(g->area, m);
  for (int i = 0; i < NU; i++)
    for (int j = 0; j < NU; j++) {
      d[i][j] = -m[i][j] / rho;
      for (int k = 0; k < NU; k++) d[i][j] += m[i][k] * response[k][j] / dt;
    }
  for (int q = 0; q < 6; q++) {
    double unit[6] = {0}, at[3][2];
    unit[q] = 1.0;
    P2Gradient(g->g, unit, at);
    for (int i = 0; i < NU; i++) grad[q][i] = at[i % 3][i / 3];
  }
  for (int q = 0; q < 6; q++)
    for (int r = 0; r < 6; r++) {
      change[q][r] = 0.0;
      for (int i = 0; i < NU; i++)
        for (int j = 0; j < NU; j++) change[q][r] += grad[q][i] * d[i][j] * grad[r][j];
    }
}

static PetscBool IsWeighted(const CoracleCoupling *k)
{
  return k->flags & CORACLE_HAS_INERTIA ? PETSC_TRUE : PETSC_FALSE;
}

static PetscErrorCode AddElement(WeightedProjection w, const WeightedProjectionStep *s, int k,
                                 const CoracleCoupling *coupling)
{
  const P2Space *p2 = w->domain->p2;
  const int e = coupling->element;
  const ElementGeometry *g = w->domain->geometry + e;
  double change[6][6];
  PetscInt gid[6];
  PetscFunctionBeginUser;
  PetscCall(Response(g->area, s->rho[e] / s->dt, coupling->implicit_inertia, w->response[k]));
  MatrixChange(g, s->rho[e], s->dt, (const double(*)[NU])w->response[k], change);
  for (int i = 0; i < 6; i++) {
    const int p = p2->node[6 * e + i];
    gid[i] = s->is_fixed[p] ? -1 : p2->gid[p];
  }
  PetscCall(MatSetValues(w->matrix, 6, gid, 6, gid, &change[0][0], ADD_VALUES));
  PetscFunctionReturn(0);
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
  if (!any) PetscFunctionReturn(0);
  w->solid = s->solid;
  if (!w->matrix) PetscCall(CreateSolver(w, s->laplacian));
  PetscCall(PetscFree(w->response));
  PetscCall(PetscMalloc1(n, &w->response));
  PetscCall(MatCopy(s->laplacian, w->matrix, SAME_NONZERO_PATTERN));
  for (int k = 0; k < n; k++)
    if (IsWeighted(entry + k)) PetscCall(AddElement(w, s, k, entry + k));
  PetscCall(MatAssemblyBegin(w->matrix, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(w->matrix, MAT_FINAL_ASSEMBLY));
  PetscCall(Refactor(w));
  PetscFunctionReturn(0);
}

PetscErrorCode WeightedProjectionSolve(WeightedProjection w, double t, Vec rhs, Vec phi, int *iterations)
{
  PetscFunctionBeginUser;
  PetscCall(SolverSolve(w->ksp, "pressure", t, rhs, phi, &w->iterations));
  *iterations = w->iterations;
  PetscFunctionReturn(0);
}

PetscBool WeightedProjectionVelocity(WeightedProjection w, int e, const double grad[3][2], double u[6])
{
  const int k = SolidCouplingIndex(w->solid, e);
  if (k < 0 || !IsWeighted(SolidCouplingAt(w->solid, e))) return PETSC_FALSE;
  for (int i = 0; i < NU; i++)
    for (int j = 0; j < NU; j++) u[i] -= w->response[k][i][j] * grad[j % 3][j / 3];
  return PETSC_TRUE;
}
