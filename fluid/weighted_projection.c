/* Solids that give way within the projection (coracle.h: give): on their elements the pressure moves fluid and
 * solid together, u+ = u* - dt W^-1 M grad phi with W = rho M/dt + give, and the pressure's matrix is
 * C^T M W^-1 M C/dt there.  It changes with every step, but little: CG with the factor of a few steps ago. */
#include "fluid/fluid_impl.h"

#define ITERATIONS_MAX 8 /* with an old factor, before it is made anew */
enum { NU = 6 };         /* velocity unknowns of an element: component, then vertex */

static PetscErrorCode Create(Fluid f)
{
  PetscFunctionBeginUser;
  PetscCall(PressureSolver(f, "pressure_giving_", KSPCG, &f->giving_ksp));
  PetscCall(KSPSetTolerances(f->giving_ksp, 1e-7, 1e-50, 1e5, 500));
  PetscCall(KSPSetFromOptions(f->giving_ksp));
  PetscCall(MatDuplicate(f->laplacian, MAT_COPY_VALUES, &f->giving));
  PetscCall(MatSetOption(f->giving, MAT_SPD, PETSC_TRUE));
  f->giving_iterations = ITERATIONS_MAX + 1;
  PetscFunctionReturn(0);
}

PetscErrorCode WeightedProjectionDestroy(Fluid f)
{
  PetscFunctionBeginUser;
  PetscCall(KSPDestroy(&f->giving_ksp));
  PetscCall(MatDestroy(&f->giving));
  PetscCall(MatDestroy(&f->giving_factored));
  PetscCall(PetscFree(f->response));
  PetscFunctionReturn(0);
}

/* Factors the matrix as it is now, if the last factor has become a bad preconditioner. */
static PetscErrorCode Refactor(Fluid f)
{
  PetscFunctionBeginUser;
  if (f->giving_iterations > ITERATIONS_MAX) {
    if (!f->giving_factored) PetscCall(MatDuplicate(f->giving, MAT_COPY_VALUES, &f->giving_factored));
    PetscCall(MatCopy(f->giving, f->giving_factored, SAME_NONZERO_PATTERN));
    PetscCall(MatSetOption(f->giving_factored, MAT_SPD, PETSC_TRUE));
  }
  PetscCall(KSPSetOperators(f->giving_ksp, f->giving, f->giving_factored));
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
static PetscErrorCode Response(double area, double rho_dt, const double give[2][3][2][3],
                               double response[NU][NU])
{
  double w[NU][NU];
  PetscFunctionBeginUser;
  MassMatrix(area, response);
  for (int i = 0; i < NU; i++)
    for (int j = 0; j < NU; j++) w[i][j] = rho_dt * response[i][j] + give[i / 3][i % 3][j / 3][j % 3];
  PetscCheck(Factor(w), PETSC_COMM_SELF, PETSC_ERR_NOT_CONVERGED,
             "the inertia of a solid that gives way is not positive on a fluid element");
  SolveColumns((const double(*)[NU])w, response);
  PetscFunctionReturn(0);
}

/* change[q][r] = int of grad N_q . (M W^-1 M/dt - M/rho) grad N_r over the P2 basis */
static void Change(const ElementGeometry *g, double rho, double dt, const double response[NU][NU],
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

static PetscBool HasInertia(const CoracleCoupling *k)
{
  return k->flags & CORACLE_HAS_INERTIA ? PETSC_TRUE : PETSC_FALSE;
}

static PetscErrorCode AddElement(Fluid f, double dt, int k)
{
  const Mesh *m = f->mesh;
  const int e = f->coupling[k].element;
  double change[6][6];
  PetscInt gid[6];
  PetscFunctionBeginUser;
  PetscCall(Response(f->geometry[e].area, f->rho[e] / dt, f->coupling[k].implicit_inertia, f->response[k]));
  Change(f->geometry + e, f->rho[e], dt, (const double(*)[NU])f->response[k], change);
  for (int i = 0; i < 6; i++) {
    const int p = m->p2[6 * e + i];
    gid[i] = f->is_fixed[p] ? -1 : m->p2gid[p];
  }
  PetscCall(MatSetValues(f->giving, 6, gid, 6, gid, &change[0][0], ADD_VALUES));
  PetscFunctionReturn(0);
}

PetscErrorCode WeightedProjectionPrepare(Fluid f, double dt)
{
  int gives = 0;
  PetscFunctionBeginUser;
  for (int k = 0; k < f->ncoupling; k++) gives |= HasInertia(f->coupling + k);
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &gives, 1, MPI_INT, MPI_LOR, f->mesh->comm));
  f->gives = (PetscBool)gives;
  if (!gives) PetscFunctionReturn(0);
  if (!f->giving) PetscCall(Create(f));
  PetscCall(PetscFree(f->response));
  PetscCall(PetscMalloc1(f->ncoupling, &f->response));
  PetscCall(MatCopy(f->laplacian, f->giving, SAME_NONZERO_PATTERN));
  for (int k = 0; k < f->ncoupling; k++)
    if (HasInertia(f->coupling + k)) PetscCall(AddElement(f, dt, k));
  PetscCall(MatAssemblyBegin(f->giving, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(f->giving, MAT_FINAL_ASSEMBLY));
  PetscCall(Refactor(f));
  PetscFunctionReturn(0);
}

PetscBool WeightedProjectionVelocity(Fluid f, int e, const double grad[3][2], double u[6])
{
  const int k = f->coupling_of[e];
  if (!f->gives || k < 0 || !HasInertia(f->coupling + k)) return PETSC_FALSE;
  for (int i = 0; i < NU; i++)
    for (int j = 0; j < NU; j++) u[i] -= f->response[k][i][j] * grad[j % 3][j / 3];
  return PETSC_TRUE;
}
