#include "fluid/momentum.h"
#include "fluid/momentum_impl.h"
#include "fluid/solver_options.h"

#define VELOCITY_TOLERANCE 1e-5 /* -momentum_ksp_rtol chooses another one */
#define SINGLE_PRECISION 1e-6   /* of a correction: what single_operator.h leaves of it */
#define REFINEMENTS_MAX 4
/* The force on a solid is its mass times what the solver finds as its change of velocity: of one that is heavier than so many times the
 * fluid the tolerance is the smaller, down to round-off times that ratio. */
#define HEAVY 20.0
#define ROUND_OFF 1e-14

/* MATOP_MULT */
static PetscErrorCode Apply(Mat matrix, Vec x, Vec y)
{
  SingleOperator op;
  PetscFunctionBeginUser;
  PetscCall(MatShellGetContext(matrix, &op));
  PetscCall(SingleOperatorApply(op, x, y));
  PetscFunctionReturn(0);
}

static PetscErrorCode CreateMatrix(MomentumSolver s, Vec like)
{
  const PetscInt n = 6 * s->domain->mesh->ne;
  PetscFunctionBeginUser;
  PetscCall(MomentumOperatorCreate(s->domain, like, &s->op));
  PetscCall(SingleOperatorCreate(&s->op, &s->single));
  PetscCall(
      MatCreateShell(s->domain->mesh->comm, n, n, PETSC_DETERMINE, PETSC_DETERMINE, s->single, &s->matrix));
  PetscCall(MatShellSetOperation(s->matrix, MATOP_MULT, (void (*)(void))Apply));
  PetscFunctionReturn(0);
}

static PetscErrorCode CreateSolver(MomentumSolver s)
{
  const Mesh *m = s->domain->mesh;
  PetscFunctionBeginUser;
  PetscCall(KSPCreate(m->comm, &s->ksp));
  PetscCall(KSPSetOptionsPrefix(s->ksp, "momentum_"));
  PetscCall(KSPSetOperators(s->ksp, s->matrix, s->matrix));
  PetscCall(KSPSetType(s->ksp, KSPGMRES));
  PetscCall(KSPSetTolerances(s->ksp, VELOCITY_TOLERANCE, 1e-50, 1e5, 500));
  PetscCall(PreconditionerCreate(&s->op, s->ksp, &s->preconditioner));
  PetscCall(KSPSetFromOptions(s->ksp));
  PetscCall(KSPGetTolerances(s->ksp, &s->tolerance, NULL, NULL, NULL));
  PetscFunctionReturn(0);
}

PetscErrorCode MomentumSolverCreate(const FluidDomain *domain, const MomentumSetup *setup, Vec like,
                                    MomentumSolver *solver)
{
  MomentumSolver s;
  PetscFunctionBeginUser;
  PetscCall(PetscNew(&s));
  s->domain = domain;
  s->setup = *setup;
  PetscCall(VecDuplicate(like, &s->load));
  PetscCall(VecDuplicate(like, &s->product));
  PetscCall(VecDuplicate(like, &s->sum));
  PetscCall(PetscCalloc1(domain->mesh->ne, &s->divergence));
  PetscCall(CreateMatrix(s, like));
  PetscCall(CreateSolver(s));
  *solver = s;
  PetscFunctionReturn(0);
}

PetscErrorCode MomentumSolverDestroy(MomentumSolver *solver)
{
  MomentumSolver s = *solver;
  PetscFunctionBeginUser;
  if (!s) PetscFunctionReturn(0);
  PetscCall(VecDestroy(&s->load));
  PetscCall(VecDestroy(&s->product));
  PetscCall(VecDestroy(&s->sum));
  PetscCall(MatDestroy(&s->matrix));
  PetscCall(KSPDestroy(&s->ksp));
  PetscCall(PetscFree(s->faces));
  PetscCall(PetscFree(s->divergence));
  PetscCall(SingleOperatorDestroy(&s->single));
  PetscCall(MomentumOperatorDestroy(&s->op));
  PetscCall(PreconditionerDestroy(&s->preconditioner));
  PetscCall(PetscFree(*solver));
  PetscFunctionReturn(0);
}

const double (*MomentumSolverDivergence(MomentumSolver s, double advected[2]))[3]
{
  for (int c = 0; c < 2; c++) advected[c] = s->advected[c];
  return (const double(*)[3])s->divergence;
}

/* The largest ratio, over all ranks, of the inertia of what fills an element to the fluid's; 1 among phases, where solids are compared
 * with the water's. */
static PetscErrorCode LargestInertia(const MomentumSolver s, const MomentumStep *step, double *ratio)
{
  int n;
  const CoracleCoupling *entry = SolidCouplingEntries(step->solid, &n);
  PetscFunctionBeginUser;
  *ratio = 1.0;
  for (int k = 0; k < n && !step->inverse_density; k++) {
    const int e = entry[k].element;
    double inertia = 0.0;
    for (int i = 0; i < 9; i++) inertia += entry[k].implicit_inertia[i / 3][i % 3];
    *ratio = PetscMax(*ratio, 1.0 + inertia * step->dt / (step->rho[e] * s->domain->geometry[e].area));
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, ratio, 1, MPI_DOUBLE, MPI_MAX, s->domain->mesh->comm));
  PetscFunctionReturn(0);
}

/* A d = load for the correction d of u_star, and u_star += d; *more: d, found in single precision, is too large for the
 * tolerance.  The tolerance is relative to the velocity, which the preconditioned load is close to; to the first
 * residual where that is larger, as in a flow that starts from rest. */
static PetscErrorCode SolveOnce(MomentumSolver s, double t, double tolerance, Vec u_star, int *iterations,
                                PetscBool *more)
{
  PetscReal norm, correction;
  PetscFunctionBeginUser;
  PetscCall(VecNorm(u_star, NORM_2, &norm));
  PetscCall(KSPSetTolerances(s->ksp, PetscMax(tolerance, SINGLE_PRECISION), PetscMax(tolerance * norm, 1e-50),
                             PETSC_DEFAULT, PETSC_DEFAULT));
  PetscCall(SolverSolve(s->ksp, "momentum", t, s->load, s->product, iterations));
  PetscCall(VecAXPY(u_star, 1.0, s->product));
  PetscCall(VecNorm(u_star, NORM_2, &norm));
  PetscCall(VecNorm(s->product, NORM_2, &correction));
  *more = (PetscBool)(SINGLE_PRECISION * correction > tolerance * norm);
  PetscFunctionReturn(0);
}

/* Until the load, which is load - A (u_star + w u^n) first, is small enough: once, but for a tolerance that is much smaller than usual. */
static PetscErrorCode SolveCorrection(MomentumSolver s, const MomentumStep *step, Vec u_star, int *iterations)
{
  PetscBool more = PETSC_TRUE;
  double ratio;
  PetscFunctionBeginUser;
  PetscCall(LargestInertia(s, step, &ratio));
  const double tolerance =
      PetscMin(s->tolerance, PetscMax(VELOCITY_TOLERANCE * HEAVY / ratio, ROUND_OFF * ratio));
  *iterations = 0;
  for (int k = 0; k < REFINEMENTS_MAX && more; k++) {
    int n;
    if (k > 0) {
      PetscCall(MomentumOperatorApply(&s->op, s->product, s->sum));
      PetscCall(VecAXPY(s->load, -1.0, s->sum));
    }
    PetscCall(SolveOnce(s, step->t, tolerance, u_star, &n, &more));
    *iterations += n;
  }
  PetscFunctionReturn(0);
}

PetscErrorCode MomentumSolverSolve(MomentumSolver s, const MomentumStep *step, Vec u_star,
                                   MomentumReport *report)
{
  const double w = (1.0 - s->setup.theta) / s->setup.theta, start = MPI_Wtime();
  PetscFunctionBeginUser;
  PetscCall(MomentumAssemble(s, step));
  PetscCall(VecWAXPY(s->sum, w, step->u, u_star));
  PetscCall(MomentumOperatorApply(&s->op, s->sum, s->product));
  PetscCall(VecAXPY(s->load, -1.0, s->product));
  PetscCall(SingleOperatorUpdate(s->single));
  PetscCall(PreconditionerUpdate(s->preconditioner));
  const double assembled = MPI_Wtime();
  PetscCall(SolveCorrection(s, step, u_star, &report->iterations));
  report->seconds_assembly = assembled - start;
  report->seconds_solve = MPI_Wtime() - assembled;
  PetscFunctionReturn(0);
}
