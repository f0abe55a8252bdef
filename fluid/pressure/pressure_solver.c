#include "fluid/pressure/pressure_solver.h"
#include "fluid/discretization/assembly.h"
#include "fluid/discretization/solver_options.h"
#include "fluid/pressure/pressure_preconditioner.h"
#include <math.h>

#define DIRECT_MAX 400000 /* nodes times ranks, up to which a factor is made for a matrix that stays */
#define TOLERANCE                                                                                            \
  1e-8 /* of the velocity that the pressure makes; -pressure_varying_ksp_rtol chooses another one */
#define OF_VELOCITY 100 /* times that: of the whole velocity */

struct PressureSolver_s {
  const FluidDomain *domain;  /* borrowed */
  const char *is_fixed;       /* borrowed */
  PetscBool closed, iterates; /* with the present matrix */
  Mat matrix;
  Assembly assembly;
  double (*block)[36]; /* [ne], and the fixed nodes' diagonal behind them */
  double *unevenness;  /* [ne] */
  PetscInt nfixed;
  KSP direct, iterative; /* made when used first */
  PressurePreconditioner preconditioner;
  PetscInt direct_max; /* nodes times ranks, up to which a factor is made for a matrix that stays */
  double contrast;     /* of the matrix */
  PetscReal tolerance; /* relative */
};

static PetscBool HasFirstNode(PressureSolver s)
{
  return (PetscBool)(s->closed && s->domain->p2->nowned > 0 && s->domain->p2->start == 0);
}

/* An entry for each entry of the elements' blocks, then the rows of fixed nodes and the first node's. */
static PetscErrorCode CreateMatrix(PressureSolver s)
{
  const P2Space *p2 = s->domain->p2;
  const int ne = s->domain->mesh->ne;
  PetscInt *row, *column, n = 36 * ne;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(n + p2->nowned + 1, &row, n + p2->nowned + 1, &column));
  for (int e = 0; e < ne; e++)
    for (int k = 0; k < 36; k++) {
      const int i = p2->node[6 * e + k / 6], j = p2->node[6 * e + k % 6];
      row[36 * e + k] = s->is_fixed[i] || s->is_fixed[j] ? -1 : p2->gid[i];
      column[36 * e + k] = p2->gid[j];
    }
  for (int k = 0; k < p2->nowned; k++)
    if (s->is_fixed[k]) row[n] = column[n] = p2->start + k, n++;
  s->nfixed = n - 36 * ne;
  if (HasFirstNode(s)) row[n] = column[n] = 0, n++;
  PetscCall(AssemblyCreate(s->domain->mesh->comm, p2->nowned, n, row, column, &s->assembly, &s->matrix));
  PetscCall(MatSetOption(s->matrix, MAT_SPD, PETSC_TRUE));
  PetscCall(PetscFree2(row, column));
  PetscFunctionReturn(0);
}

static PetscErrorCode CreateDirect(PressureSolver s)
{
  PetscFunctionBeginUser;
  PetscCall(SolverCreateDirect(s->domain->mesh->comm, "pressure_", KSPPREONLY, &s->direct));
  PetscCall(KSPSetOperators(s->direct, s->matrix, s->matrix));
  PetscCall(KSPSetTolerances(s->direct, 1e-9, 1e-50, 1e5, 500));
  PetscCall(KSPSetFromOptions(s->direct));
  PetscFunctionReturn(0);
}

static PetscErrorCode CreateIterative(PressureSolver s)
{
  PetscFunctionBeginUser;
  PetscCall(KSPCreate(s->domain->mesh->comm, &s->iterative));
  PetscCall(KSPSetOptionsPrefix(s->iterative, "pressure_varying_"));
  PetscCall(KSPSetType(s->iterative, KSPCG));
  PetscCall(KSPSetNormType(s->iterative, KSP_NORM_NATURAL));
  PetscCall(KSPSetOperators(s->iterative, s->matrix, s->matrix));
  PetscCall(
      PressurePreconditionerCreate(s->domain, s->is_fixed, s->closed, s->iterative, &s->preconditioner));
  PetscCall(KSPSetTolerances(s->iterative, TOLERANCE, 1e-50, 1e5, 500));
  PetscCall(KSPSetFromOptions(s->iterative));
  PetscCall(KSPGetTolerances(s->iterative, &s->tolerance, NULL, NULL, NULL));
  PetscFunctionReturn(0);
}

PetscErrorCode PressureSolverCreate(const FluidDomain *domain, const char is_fixed[], PetscBool closed,
                                    PressureSolver *solver)
{
  PressureSolver s;
  PetscFunctionBeginUser;
  PetscCall(PetscNew(&s));
  s->domain = domain;
  s->is_fixed = is_fixed;
  s->closed = closed;
  s->direct_max = DIRECT_MAX;
  PetscCall(PetscOptionsGetInt(NULL, "pressure_", "-direct_max", &s->direct_max, NULL));
  PetscCall(CreateMatrix(s));
  PetscCall(PetscMalloc1(domain->mesh->ne + s->nfixed / 36 + 1, &s->block));
  PetscCall(PetscMalloc1(domain->mesh->ne, &s->unevenness));
  for (int e = 0; e < domain->mesh->ne; e++) s->unevenness[e] = 1.0;
  *solver = s;
  PetscFunctionReturn(0);
}

PetscErrorCode PressureSolverDestroy(PressureSolver *solver)
{
  PressureSolver s = *solver;
  PetscFunctionBeginUser;
  if (!s) PetscFunctionReturn(0);
  PetscCall(KSPDestroy(&s->direct));
  PetscCall(KSPDestroy(&s->iterative));
  PetscCall(PressurePreconditionerDestroy(&s->preconditioner));
  PetscCall(AssemblyDestroy(&s->assembly));
  PetscCall(MatDestroy(&s->matrix));
  PetscCall(PetscFree(s->block));
  PetscCall(PetscFree(s->unevenness));
  PetscCall(PetscFree(*solver));
  PetscFunctionReturn(0);
}

double (*PressureSolverBlocks(PressureSolver s))[36]
{
  return s->block;
}

double *PressureSolverUnevenness(PressureSolver s)
{
  return s->unevenness;
}

/* Constants: the null space for CG; where there is none, phi = 0 in the first node for consistent right-hand
 * sides, by any positive number on the diagonal. */
static PetscErrorCode SetNullSpace(PressureSolver s)
{
  MatNullSpace constants = NULL;
  PetscFunctionBeginUser;
  if (s->closed && s->iterates)
    PetscCall(MatNullSpaceCreate(s->domain->mesh->comm, PETSC_TRUE, 0, NULL, &constants));
  PetscCall(MatSetNullSpace(s->matrix, constants));
  PetscCall(MatNullSpaceDestroy(&constants));
  PetscFunctionReturn(0);
}

/* CG for the matrix as it is now. */
static PetscErrorCode PrepareIterative(PressureSolver s)
{
  PetscFunctionBeginUser;
  if (!s->iterative) PetscCall(CreateIterative(s));
  PetscCall(PressurePreconditionerUpdate(s->preconditioner, (const double(*)[36])s->block, s->unevenness));
  PetscFunctionReturn(0);
}

PetscErrorCode PressureSolverSetMatrix(PressureSolver s, PetscBool varying, double contrast)
{
  double *extra = s->block[s->domain->mesh->ne];
  PetscMPIInt ranks;
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_size(s->domain->mesh->comm, &ranks));
  s->contrast = contrast;
  s->iterates = (PetscBool)(varying || s->domain->p2->nglobal > s->direct_max / ranks);
  for (int k = 0; k < s->nfixed; k++) extra[k] = 1.0;
  if (HasFirstNode(s)) extra[s->nfixed] = s->iterates ? 0.0 : s->block[0][0];
  PetscCall(AssemblySum(s->assembly, s->block[0], s->matrix));
  PetscCall(SetNullSpace(s));
  if (s->iterates)
    PetscCall(PrepareIterative(s));
  else if (!s->direct)
    PetscCall(CreateDirect(s));
  PetscFunctionReturn(0);
}

static PetscErrorCode Iterate(PressureSolver s, const PressureProblem *problem, Vec phi, SolverReport *report)
{
  const double tolerance = s->tolerance / s->contrast;
  PetscFunctionBeginUser;
  PetscCall(KSPSetTolerances(s->iterative, tolerance, OF_VELOCITY * tolerance * problem->size, PETSC_DEFAULT,
                             PETSC_DEFAULT));
  PetscCall(SolverSolve(s->iterative, "pressure", problem->t, problem->rhs, phi, report));
  PressurePreconditionerCount(s->preconditioner, report->iterations);
  PetscFunctionReturn(0);
}

PetscErrorCode PressureSolverSolve(PressureSolver s, const PressureProblem *problem, Vec phi,
                                   SolverReport *report)
{
  PetscFunctionBeginUser;
  if (s->iterates)
    PetscCall(Iterate(s, problem, phi, report));
  else
    PetscCall(SolverSolve(s->direct, "pressure", problem->t, problem->rhs, phi, report));
  PetscFunctionReturn(0);
}
