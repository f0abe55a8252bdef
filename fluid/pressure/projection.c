#include "fluid/pressure/projection.h"
#include "fluid/discretization/ghosted.h"
#include "fluid/pressure/bulk_divergence.h"
#include "fluid/pressure/pressure_solver.h"
#include "fluid/pressure/rotational_increment.h"
#include "fluid/pressure/weighted_projection.h"

struct ProjectionSolver_s {
  const FluidDomain *domain; /* borrowed */
  Vec phi, divergence;       /* ghosted P2 vectors */
  PressureSolver solver;
  int revision;      /* of the density in the solver's matrix, -1: there is none */
  PetscBool tensor;  /* it has R^-1 */
  PetscBool inertia; /* it has the solid's */
  int nfixed;
  int *fixed;     /* local P2 nodes (owned) where phi = 0 */
  char *is_fixed; /* [n] of the P2 space */
  WeightedProjection weighted;
  RotationalIncrement rotational;
  char *is_weighted; /* [ne] whose block has the solid's inertia */
};

/* mark[n] of the P2 space on this rank's nodes of open boundaries; *any: on any rank */
static PetscErrorCode MarkOpen(const FluidDomain *d, PetscScalar mark[], int *any)
{
  const Mesh *m = d->mesh;
  PetscFunctionBeginUser;
  *any = 0;
  for (int e = 0; e < m->ne; e++)
    for (int i = 0; i < 3; i++) {
      const Boundary *b = BoundaryOfFace(d, e, i);
      const int *node = d->p2->node + 6 * e;
      if (!b || b->kind != BOUNDARY_OPEN) continue;
      mark[node[(i + 1) % 3]] = mark[node[(i + 2) % 3]] = mark[node[3 + i]] = 1.0;
      *any = 1;
    }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, any, 1, MPI_INT, MPI_MAX, m->comm));
  PetscFunctionReturn(0);
}

/* P2 nodes where phi = 0: on open boundaries; *closed: there are none.  The owner of a node need not have
 * an element with the face: hence the sum over ranks. */
static PetscErrorCode FindFixed(ProjectionSolver s, PetscBool *closed)
{
  PetscScalar *v;
  const P2Space *p2 = s->domain->p2;
  Vec mark;
  int has_open;
  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(s->phi, &mark));
  PetscCall(GhostedGetArrayZero(mark, &v));
  PetscCall(MarkOpen(s->domain, v, &has_open));
  *closed = (PetscBool)!has_open;
  PetscCall(GhostedRestoreArray(mark, &v));
  PetscCall(GhostedSum(mark));
  PetscCall(GhostedUpdate(mark));
  PetscCall(GhostedGetArray(mark, &v));
  PetscCall(PetscMalloc1(p2->n, &s->is_fixed));
  PetscCall(PetscMalloc1(p2->nowned, &s->fixed));
  for (int k = 0; k < p2->n; k++) {
    s->is_fixed[k] = v[k] > 0.5;
    if (s->is_fixed[k] && k < p2->nowned) s->fixed[s->nfixed++] = k;
  }
  PetscCall(GhostedRestoreArray(mark, &v));
  PetscCall(VecDestroy(&mark));
  PetscFunctionReturn(0);
}

/* int grad phi_q . k grad phi_r, k = 1/rho or R^-1 */
static void Stiffness(const ElementGeometry *g, const ProjectionStep *step, int e, double block[6][6])
{
  if (step->inverse_density)
    P2StiffnessTensor(g->area, (const double(*)[2])g->g, step->inverse_density[e].inverse, block);
  else
    P2Stiffness(g->area, (const double(*)[2])g->g, 1.0 / step->rho[e], block);
}

/* int |grad N|^2 over a vertex's function is area |grad lambda|^2. */
static double Unevenness(const ElementGeometry *g, const double block[36])
{
  double least = HUGE_VAL, largest = 0.0;
  for (int i = 0; i < 3; i++) {
    const double coefficient = block[7 * i] / (g->g[i][0] * g->g[i][0] + g->g[i][1] * g->g[i][1]);
    least = PetscMin(least, coefficient);
    largest = PetscMax(largest, coefficient);
  }
  return largest / least;
}

/* The solver's matrix has the step's coefficient, but for what the solid does to it. */
static PetscBool HasCoefficient(ProjectionSolver s, const ProjectionStep *step)
{
  return (PetscBool)(s->revision == step->revision && !step->compressible &&
                     s->tensor == !!step->inverse_density);
}

/* The blocks of the step.  While the density stays only those change that have, or had, the solid's inertia. */
static void SetBlocks(ProjectionSolver s, const ProjectionStep *step)
{
  const FluidDomain *d = s->domain;
  double(*block)[36] = PressureSolverBlocks(s->solver), *unevenness = PressureSolverUnevenness(s->solver);
  const PetscBool all = (PetscBool)!HasCoefficient(s, step);
  for (int e = 0; e < d->mesh->ne; e++) {
    const PetscBool weighted = s->inertia && WeightedProjectionBlock(s->weighted, e, (double(*)[6])block[e]);
    if (!weighted && (all || s->is_weighted[e])) Stiffness(d->geometry + e, step, e, (double(*)[6])block[e]);
    s->is_weighted[e] = weighted;
    unevenness[e] = weighted || step->inverse_density ? Unevenness(d->geometry + e, block[e]) : 1.0;
    if (step->compressible)
      CompressibilityBlock(&step->compressible[e], d->geometry[e].area, step->dt, (double(*)[6])block[e]);
  }
}

/* The square root of the largest ratio of the fluid's densities.  What the solid adds does not count: the heavier it is, the less of the
 * energy is in what the pressure changes there. */
static PetscErrorCode Contrast(const Mesh *m, const double rho[], double *contrast)
{
  double range[2] = {0.0, 0.0}; /* largest, inverse of the least */
  PetscFunctionBeginUser;
  for (int e = 0; e < m->ne; e++) {
    range[0] = PetscMax(range[0], rho[e]);
    range[1] = PetscMax(range[1], 1.0 / rho[e]);
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, range, 2, MPI_DOUBLE, MPI_MAX, m->comm));
  *contrast = sqrt(range[0] * range[1]);
  PetscFunctionReturn(0);
}

/* The pressure's matrix for the step, if it is not the solver's already. */
static PetscErrorCode Assemble(ProjectionSolver s, const ProjectionStep *step)
{
  const WeightedProjectionStep weighted = {step->dt, step->rho, step->solid, step->inertia};
  const PetscBool had_inertia = s->inertia;
  WeightedProjectionFound found;
  double contrast = 1.0;
  PetscFunctionBeginUser;
  PetscCall(WeightedProjectionPrepare(s->weighted, &weighted, &found));
  s->inertia = (PetscBool)(found.active && step->inertia);
  if (HasCoefficient(s, step) && had_inertia == s->inertia && (found.same || !s->inertia))
    PetscFunctionReturn(0);
  SetBlocks(s, step);
  PetscCall(Contrast(s->domain->mesh, step->rho, &contrast));
  PetscCall(PressureSolverSetMatrix(s->solver, (PetscBool)(found.moves || step->revision > 0), contrast));
  s->revision = step->revision;
  s->tensor = (PetscBool) !!step->inverse_density;
  PetscFunctionReturn(0);
}

PetscErrorCode ProjectionSolverCreate(const FluidDomain *domain, Vec like, PetscBool compressible,
                                      ProjectionSolver *solver)
{
  ProjectionSolver s;
  PetscBool closed = PETSC_FALSE;
  PetscFunctionBeginUser;
  PetscCall(PetscNew(&s));
  s->domain = domain;
  s->revision = -1;
  PetscCall(VecDuplicate(like, &s->phi));
  PetscCall(VecDuplicate(like, &s->divergence));
  PetscCall(FindFixed(s, &closed));
  PetscCall(PressureSolverCreate(domain, s->is_fixed, (PetscBool)(closed && !compressible), &s->solver));
  PetscCall(WeightedProjectionCreate(domain, &s->weighted));
  PetscCall(RotationalIncrementCreate(domain, like, s->is_fixed, &s->rotational));
  PetscCall(PetscCalloc1(domain->mesh->ne, &s->is_weighted));
  *solver = s;
  PetscFunctionReturn(0);
}

PetscErrorCode ProjectionSolverDestroy(ProjectionSolver *solver)
{
  ProjectionSolver s = *solver;
  PetscFunctionBeginUser;
  if (!s) PetscFunctionReturn(0);
  PetscCall(VecDestroy(&s->phi));
  PetscCall(VecDestroy(&s->divergence));
  PetscCall(PressureSolverDestroy(&s->solver));
  PetscCall(PetscFree(s->fixed));
  PetscCall(PetscFree(s->is_fixed));
  PetscCall(PetscFree(s->is_weighted));
  PetscCall(WeightedProjectionDestroy(&s->weighted));
  PetscCall(RotationalIncrementDestroy(&s->rotational));
  PetscCall(PetscFree(*solver));
  PetscFunctionReturn(0);
}

/* int of u.u */
static double Square(double area, const double u[6])
{
  double sum = 0.0;
  for (int c = 0; c < 2; c++) {
    double mu[3];
    P1MassApply(area, u + 3 * c, mu);
    for (int i = 0; i < 3; i++) sum += mu[i] * u[3 * c + i];
  }
  return sum;
}

/* The square root of int rho u^2 over dt. */
static PetscErrorCode Size(ProjectionSolver s, const ProjectionStep *step, Vec velocity, double *size)
{
  const Mesh *m = s->domain->mesh;
  const PetscScalar *u;
  PetscFunctionBeginUser;
  PetscCall(VecGetArrayRead(velocity, &u));
  *size = 0.0;
  for (int e = 0; e < m->ne; e++) *size += step->rho[e] * Square(s->domain->geometry[e].area, u + 6 * e);
  PetscCall(VecRestoreArrayRead(velocity, &u));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, size, 1, MPI_DOUBLE, MPI_SUM, m->comm));
  *size = sqrt(*size) / step->dt;
  PetscFunctionReturn(0);
}

/* Of the bulk velocity made of u, over dt: the right-hand side, 0 on fixed nodes. */
static PetscErrorCode Divergence(ProjectionSolver s, const ProjectionStep *step, Vec velocity)
{
  PetscScalar *d;
  PetscFunctionBeginUser;
  PetscCall(BulkDivergence(s->domain, step, velocity, s->divergence));
  PetscCall(VecGetArray(s->divergence, &d));
  for (int k = 0; k < s->nfixed; k++) d[s->fixed[k]] = 0.0;
  PetscCall(VecRestoreArray(s->divergence, &d));
  PetscCall(VecScale(s->divergence, 1.0 / step->dt));
  PetscFunctionReturn(0);
}

PetscErrorCode ProjectionSolverKeepFixed(ProjectionSolver s, Vec p)
{
  PetscScalar *v;
  PetscFunctionBeginUser;
  PetscCall(GhostedGetArray(p, &v));
  for (int k = 0; k < s->domain->p2->n; k++)
    if (!s->is_fixed[k]) v[k] = 0.0;
  PetscCall(GhostedRestoreArray(p, &v));
  PetscFunctionReturn(0);
}

PetscErrorCode ProjectionSolverSolve(ProjectionSolver s, const ProjectionStep *step, Vec velocity, Vec *phi,
                                     SolverReport *report)
{
  PressureProblem problem = {step->t, 0.0, s->divergence};
  PetscFunctionBeginUser;
  PetscCall(Assemble(s, step));
  PetscCall(Divergence(s, step, velocity));
  /* volumes of phases add up as far as the divergence is removed: its solver may not stop sooner for them */
  if (step->revision == 0) PetscCall(Size(s, step, velocity, &problem.size));
  PetscCall(PressureSolverSolve(s->solver, &problem, s->phi, report));
  PetscCall(GhostedUpdate(s->phi));
  *phi = s->phi;
  PetscFunctionReturn(0);
}

/* u -= dt k grad phi, k symmetric */
static void SubtractTensor(double dt, const double k[3], const double grad[3][2], double u[6])
{
  for (int i = 0; i < 3; i++) {
    u[i] -= dt * (k[0] * grad[i][0] + k[1] * grad[i][1]);
    u[3 + i] -= dt * (k[1] * grad[i][0] + k[2] * grad[i][1]);
  }
}

PetscErrorCode ProjectionSolverSubtract(ProjectionSolver s, const ProjectionStep *step, Vec velocity)
{
  const FluidDomain *d = s->domain;
  const Mesh *m = d->mesh;
  const PetscScalar *phi;
  PetscScalar *u;
  PetscFunctionBeginUser;
  PetscCall(GhostedGetArrayRead(s->phi, &phi));
  PetscCall(VecGetArray(velocity, &u));
  for (int e = 0; e < m->ne; e++) {
    double grad[3][2];
    DomainGradient(d, e, phi, grad);
    if (s->inertia && WeightedProjectionVelocity(s->weighted, e, (const double(*)[2])grad, u + 6 * e))
      continue;
    if (step->inverse_density)
      SubtractTensor(step->dt, step->inverse_density[e].inverse, (const double(*)[2])grad, u + 6 * e);
    else
      for (int c = 0; c < 2; c++)
        for (int i = 0; i < 3; i++) u[6 * e + 3 * c + i] -= step->dt / step->rho[e] * grad[i][c];
  }
  PetscCall(VecRestoreArray(velocity, &u));
  PetscCall(GhostedRestoreArrayRead(s->phi, &phi));
  PetscFunctionReturn(0);
}

PetscErrorCode ProjectionSolverAddRotational(ProjectionSolver s, const ProjectionStep *step,
                                             const double mu[], double theta, Vec p)
{
  PetscFunctionBeginUser;
  PetscCall(RotationalIncrementAdd(s->rotational, s->divergence, mu, step->revision, theta * step->dt, p));
  PetscFunctionReturn(0);
}

Vec ProjectionSolverLast(ProjectionSolver s)
{
  return s->phi;
}
