#include "fluid/momentum/momentum.h"
#include "fluid/discretization/solver_options.h"
#include "fluid/momentum/momentum_impl.h"

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

/* The density, kg/m3, that the implicit inertia of an entry would have in its element. */
static double SolidDensity(const MomentumSolver s, const MomentumStep *step, const CoracleCoupling *entry)
{
  double inertia = 0.0;
  for (int i = 0; i < 9; i++) inertia += entry->implicit_inertia[i / 3][i % 3];
  return inertia * step->dt / s->domain->geometry[entry->element].area;
}

/* Whether it is more than that of the fluid in and around the element: what the neighbours do to such an element is little. */
static PetscBool IsHeavy(const MomentumSolver s, const MomentumStep *step, const CoracleCoupling *entry)
{
  const int *neighbor = s->domain->mesh->neighbor + 3 * entry->element;
  double most = step->rho[entry->element];
  for (int i = 0; i < 3; i++)
    if (neighbor[i] >= 0) most = PetscMax(most, step->rho[neighbor[i]]);
  return (PetscBool)(SolidDensity(s, step, entry) > most);
}

/* The largest ratio, over all ranks, of the inertia of what fills an element to the fluid's, 1 among phases, where solids are compared
 * with the water's, and of what is held, whose velocity is known; *heavy: some elements are. */
static PetscErrorCode LargestInertia(const MomentumSolver s, const MomentumStep *step, double *ratio,
                                     PetscBool *heavy)
{
  int n;
  const CoracleCoupling *entry = SolidCouplingEntries(step->solid, &n);
  double most[2] = {1.0, 0.0};
  PetscFunctionBeginUser;
  for (int k = 0; k < n; k++) {
    if (IsHeavy(s, step, entry + k)) most[1] = 1.0;
    if (step->inverse_density || entry[k].flags & CORACLE_IS_HELD) continue;
    most[0] = PetscMax(most[0], 1.0 + SolidDensity(s, step, entry + k) / step->rho[entry[k].element]);
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, most, 2, MPI_DOUBLE, MPI_MAX, s->domain->mesh->comm));
  *ratio = most[0];
  *heavy = (PetscBool)(most[1] > 0.0);
  PetscFunctionReturn(0);
}

/* load -= A product */
static PetscErrorCode UpdateLoad(MomentumSolver s)
{
  PetscFunctionBeginUser;
  PetscCall(MomentumOperatorApply(&s->op, s->product, s->sum));
  PetscCall(VecAXPY(s->load, -1.0, s->sum));
  PetscFunctionReturn(0);
}

/* Heavy elements take what the iteration has left of their load.  Its norm is that of a velocity, in which the load of an element of a
 * thousand times the water's density is a thousandth; but it is a force on the solid, and all of the rest that the budget of momentum
 * has.  Each is solved alone, in double precision. */
static PetscErrorCode SolveHeavy(MomentumSolver s, const MomentumStep *step, Vec u_star)
{
  int n;
  const CoracleCoupling *entry = SolidCouplingEntries(step->solid, &n);
  const PetscScalar *load;
  PetscScalar *u;
  PetscFunctionBeginUser;
  PetscCall(UpdateLoad(s));
  PetscCall(VecGetArrayRead(s->load, &load));
  PetscCall(VecGetArray(u_star, &u));
  for (int k = 0; k < n; k++) {
    const int e = entry[k].element;
    double change[6];
    if (!IsHeavy(s, step, entry + k)) continue;
    PreconditionerSolveElement(s->preconditioner, e, load + 6 * e, change);
    for (int i = 0; i < 6; i++) u[6 * e + i] += change[i];
  }
  PetscCall(VecRestoreArray(u_star, &u));
  PetscCall(VecRestoreArrayRead(s->load, &load));
  PetscFunctionReturn(0);
}

/* A d = load for the correction d of u_star, and u_star += d; *more: d, found in single precision, is too large for the
 * tolerance.  The tolerance is relative to the velocity, which the preconditioned load is close to; to the first
 * residual where that is larger, as in a flow that starts from rest. */
static PetscErrorCode SolveOnce(MomentumSolver s, double t, double tolerance, Vec u_star,
                                SolverReport *report, PetscBool *more)
{
  PetscReal norm, correction;
  PetscFunctionBeginUser;
  PetscCall(VecNorm(u_star, NORM_2, &norm));
  PetscCall(KSPSetTolerances(s->ksp, PetscMax(tolerance, SINGLE_PRECISION), PetscMax(tolerance * norm, 1e-50),
                             PETSC_DEFAULT, PETSC_DEFAULT));
  PetscCall(SolverSolve(s->ksp, "momentum", t, s->load, s->product, report));
  PetscCall(VecAXPY(u_star, 1.0, s->product));
  PetscCall(VecNorm(u_star, NORM_2, &norm));
  PetscCall(VecNorm(s->product, NORM_2, &correction));
  *more = (PetscBool)(!report->failure[0] && SINGLE_PRECISION * correction > tolerance * norm);
  PetscFunctionReturn(0);
}

/* Until the load, which is load - A (u_star + w u^n) first, is small enough: once, but for a tolerance that is much smaller than usual;
 * then of heavy elements. */
static PetscErrorCode SolveCorrection(MomentumSolver s, const MomentumStep *step, Vec u_star,
                                      SolverReport *report)
{
  PetscBool more = PETSC_TRUE, heavy;
  double ratio;
  PetscFunctionBeginUser;
  PetscCall(LargestInertia(s, step, &ratio, &heavy));
  const double tolerance =
      PetscMin(s->tolerance, PetscMax(VELOCITY_TOLERANCE * HEAVY / ratio, ROUND_OFF * ratio));
  int iterations = 0;
  for (int k = 0; k < REFINEMENTS_MAX && more; k++) {
    if (k > 0) PetscCall(UpdateLoad(s));
    PetscCall(SolveOnce(s, step->t, tolerance, u_star, report, &more));
    iterations += report->iterations;
  }
  report->iterations = iterations;
  if (heavy) PetscCall(SolveHeavy(s, step, u_star));
  PetscFunctionReturn(0);
}

PetscErrorCode MomentumSolverSolve(MomentumSolver s, const MomentumStep *step, Vec u_star,
                                   MomentumReport *report)
{
  const double w = (1.0 - s->theta) / s->theta, start = MPI_Wtime();
  PetscFunctionBeginUser;
  PetscCall(MomentumAssembleSolid(s, step));
  PetscCall(VecWAXPY(s->sum, w, step->u, u_star));
  PetscCall(MomentumOperatorApply(&s->op, s->sum, s->product));
  PetscCall(VecAXPY(s->load, -1.0, s->product));
  PetscCall(SingleOperatorUpdate(s->single));
  PetscCall(PreconditionerUpdate(s->preconditioner));
  const double assembled = MPI_Wtime();
  PetscCall(SolveCorrection(s, step, u_star, &report->solver));
  report->seconds_assembly = assembled - start;
  report->seconds_solve = MPI_Wtime() - assembled;
  PetscFunctionReturn(0);
}
