#include "fluid/projection.h"
#include "fluid/solver_options.h"
#include "fluid/weighted_projection.h"

struct ProjectionSolver_s {
  const FluidDomain *domain; /* borrowed */
  Vec phi, divergence;       /* ghosted P2 vectors */
  Mat laplacian;             /* int 1/rho grad.grad */
  KSP ksp;
  int revision; /* of the density in the laplacian */
  int nfixed;
  int *fixed;     /* local P2 nodes (owned) where phi = 0 */
  char *is_fixed; /* [n] of the P2 space */
  WeightedProjection weighted;
  PetscBool inertia; /* the last solve was a weighted one */
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

/* P2 nodes where phi = 0: on open boundaries; without any, global node 0.  The owner of a node need not have
 * an element with the face: hence the sum over ranks. */
static PetscErrorCode FindFixed(ProjectionSolver s)
{
  const P2Space *p2 = s->domain->p2;
  PetscScalar *v;
  Vec mark, local;
  int has_open;
  PetscFunctionBeginUser;
  PetscCall(VecDuplicate(s->phi, &mark));
  PetscCall(VecGhostGetLocalForm(mark, &local));
  PetscCall(VecSet(local, 0.0));
  PetscCall(VecGetArray(local, &v));
  PetscCall(MarkOpen(s->domain, v, &has_open));
  if (!has_open && p2->nowned > 0 && p2->start == 0) v[0] = 1.0;
  PetscCall(VecRestoreArray(local, &v));
  PetscCall(VecGhostUpdateBegin(mark, ADD_VALUES, SCATTER_REVERSE));
  PetscCall(VecGhostUpdateEnd(mark, ADD_VALUES, SCATTER_REVERSE));
  PetscCall(VecGhostUpdateBegin(mark, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecGhostUpdateEnd(mark, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecGetArray(local, &v));
  PetscCall(PetscMalloc1(p2->n, &s->is_fixed));
  PetscCall(PetscMalloc1(p2->nowned, &s->fixed));
  for (int k = 0; k < p2->n; k++) {
    s->is_fixed[k] = v[k] > 0.5;
    if (s->is_fixed[k] && k < p2->nowned) s->fixed[s->nfixed++] = k;
  }
  PetscCall(VecRestoreArray(local, &v));
  PetscCall(VecGhostRestoreLocalForm(mark, &local));
  PetscCall(VecDestroy(&mark));
  PetscFunctionReturn(0);
}

static PetscErrorCode CreateLaplacian(ProjectionSolver s)
{
  const int n = s->domain->p2->nowned;
  PetscFunctionBeginUser;
  PetscCall(MatCreateAIJ(s->domain->mesh->comm, n, n, PETSC_DETERMINE, PETSC_DETERMINE, 28, NULL, 14, NULL,
                         &s->laplacian));
  PetscCall(MatSetOption(s->laplacian, MAT_NEW_NONZERO_ALLOCATION_ERR, PETSC_FALSE));
  PetscFunctionReturn(0);
}

static PetscErrorCode AssembleLaplacian(ProjectionSolver s, const double rho[],
                                        const InverseDensity *inverse_density)
{
  const P2Space *p2 = s->domain->p2;
  PetscInt *rows;
  PetscFunctionBeginUser;
  for (int e = 0; e < s->domain->mesh->ne; e++) {
    double k[6][6];
    PetscInt gid[6];
    const ElementGeometry *g = &s->domain->geometry[e];
    if (inverse_density)
      P2StiffnessTensor(g->area, (const double(*)[2])g->g, inverse_density[e].inverse, k);
    else
      P2Stiffness(g->area, (const double(*)[2])g->g, 1.0 / rho[e], k);
    for (int i = 0; i < 6; i++) gid[i] = p2->gid[p2->node[6 * e + i]];
    PetscCall(MatSetValues(s->laplacian, 6, gid, 6, gid, &k[0][0], ADD_VALUES));
  }
  PetscCall(MatAssemblyBegin(s->laplacian, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(s->laplacian, MAT_FINAL_ASSEMBLY));
  PetscCall(PetscMalloc1(s->nfixed, &rows));
  for (int k = 0; k < s->nfixed; k++) rows[k] = p2->start + s->fixed[k];
  PetscCall(MatZeroRowsColumns(s->laplacian, s->nfixed, rows, 1.0, NULL, NULL));
  PetscCall(PetscFree(rows));
  PetscCall(MatSetOption(s->laplacian, MAT_SPD, PETSC_TRUE));
  PetscFunctionReturn(0);
}

/* Assembles and factors for another density. */
static PetscErrorCode Refactor(ProjectionSolver s, const ProjectionStep *step)
{
  PetscFunctionBeginUser;
  if (s->revision == step->revision) PetscFunctionReturn(0);
  s->revision = step->revision;
  PetscCall(MatZeroEntries(s->laplacian));
  PetscCall(AssembleLaplacian(s, step->rho, step->inverse_density));
  PetscCall(KSPSetOperators(s->ksp, s->laplacian, s->laplacian));
  PetscFunctionReturn(0);
}

static PetscErrorCode CreateSolver(ProjectionSolver s)
{
  PetscFunctionBeginUser;
  PetscCall(SolverCreateDirect(s->domain->mesh->comm, "pressure_", KSPPREONLY, &s->ksp));
  PetscCall(KSPSetOperators(s->ksp, s->laplacian, s->laplacian));
  PetscCall(KSPSetTolerances(s->ksp, 1e-9, 1e-50, 1e5, 500));
  PetscCall(KSPSetFromOptions(s->ksp));
  PetscCall(KSPSetUp(s->ksp));
  PetscFunctionReturn(0);
}

PetscErrorCode ProjectionSolverCreate(const FluidDomain *domain, Vec like, const double rho[],
                                      ProjectionSolver *solver)
{
  ProjectionSolver s;
  PetscFunctionBeginUser;
  PetscCall(PetscNew(&s));
  s->domain = domain;
  PetscCall(VecDuplicate(like, &s->phi));
  PetscCall(VecDuplicate(like, &s->divergence));
  PetscCall(FindFixed(s));
  PetscCall(CreateLaplacian(s));
  PetscCall(AssembleLaplacian(s, rho, NULL));
  PetscCall(CreateSolver(s));
  PetscCall(WeightedProjectionCreate(domain, &s->weighted));
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
  PetscCall(MatDestroy(&s->laplacian));
  PetscCall(KSPDestroy(&s->ksp));
  PetscCall(PetscFree(s->fixed));
  PetscCall(PetscFree(s->is_fixed));
  PetscCall(WeightedProjectionDestroy(&s->weighted));
  PetscCall(PetscFree(*solver));
  PetscFunctionReturn(0);
}

/* r -= <q, g.n> on boundaries that prescribe the velocity: Simpson's rule, exact for q in P2 and constant g
 */
static void BoundaryFlux(const FluidDomain *d, int e, double t, double r[6])
{
  for (int i = 0; i < 3; i++) {
    const Boundary *b = BoundaryOfFace(d, e, i);
    if (!b || b->kind != BOUNDARY_VELOCITY) continue;
    const FaceGeometry face = d->geometry[e].face[i];
    const int node[3] = {(i + 1) % 3, 3 + i, (i + 2) % 3};
    const double *xa = ElementVertex(d->mesh, e, node[0]), *xb = ElementVertex(d->mesh, e, node[2]);
    const double weight[3] = {1.0 / 6.0, 4.0 / 6.0, 1.0 / 6.0};
    for (int k = 0; k < 3; k++) {
      const double x[2] = {xa[0] + 0.5 * k * (xb[0] - xa[0]), xa[1] + 0.5 * k * (xb[1] - xa[1])};
      double v[2];
      BoundaryVelocity(b, t, x, v);
      r[node[k]] -= weight[k] * face.length * (v[0] * face.n[0] + v[1] * face.n[1]);
    }
  }
}

/* mv = M u + (us - ms u) */
static void BulkMomentum(double area, const CoracleCoupling *k, const double u[6], double mv[2][3])
{
  for (int c = 0; c < 2; c++) P1MassApply(area, u + 3 * c, mv[c]);
  for (int c = 0; c < 2 && k; c++)
    for (int i = 0; i < 3; i++) {
      mv[c][i] += k->us[c][i];
      for (int j = 0; j < 3; j++) mv[c][i] -= k->ms[i][j] * u[3 * c + j];
    }
}

/* Of the bulk velocity made of u, over dt: the right-hand side, 0 on fixed nodes. */
static PetscErrorCode Divergence(ProjectionSolver s, const ProjectionStep *step, Vec velocity)
{
  const FluidDomain *domain = s->domain;
  const Mesh *m = domain->mesh;
  const PetscScalar *u;
  PetscScalar *d;
  Vec local;
  PetscFunctionBeginUser;
  PetscCall(VecGhostGetLocalForm(s->divergence, &local));
  PetscCall(VecSet(local, 0.0));
  PetscCall(VecGetArray(local, &d));
  PetscCall(VecGetArrayRead(velocity, &u));
  for (int e = 0; e < m->ne; e++) {
    double mv[2][3], r[6] = {0};
    BulkMomentum(domain->geometry[e].area, SolidCouplingAt(step->solid, e), u + 6 * e, mv);
    P2GradientTranspose(domain->geometry[e].g, (const double(*)[3])mv, r);
    BoundaryFlux(domain, e, step->t, r);
    for (int k = 0; k < 6; k++) d[domain->p2->node[6 * e + k]] += r[k];
  }
  PetscCall(VecRestoreArrayRead(velocity, &u));
  PetscCall(VecRestoreArray(local, &d));
  PetscCall(VecGhostRestoreLocalForm(s->divergence, &local));
  PetscCall(VecGhostUpdateBegin(s->divergence, ADD_VALUES, SCATTER_REVERSE));
  PetscCall(VecGhostUpdateEnd(s->divergence, ADD_VALUES, SCATTER_REVERSE));
  PetscCall(VecGetArray(s->divergence, &d));
  for (int k = 0; k < s->nfixed; k++) d[s->fixed[k]] = 0.0;
  PetscCall(VecRestoreArray(s->divergence, &d));
  PetscCall(VecScale(s->divergence, 1.0 / step->dt));
  PetscFunctionReturn(0);
}

PetscErrorCode ProjectionSolverSolve(ProjectionSolver s, const ProjectionStep *step, Vec velocity, Vec *phi,
                                     int *iterations)
{
  const WeightedProjectionStep weighted = {step->dt, step->rho, step->solid, s->laplacian, s->is_fixed};
  PetscFunctionBeginUser;
  PetscCall(Refactor(s, step));
  s->inertia = PETSC_FALSE;
  if (step->inertia) PetscCall(WeightedProjectionPrepare(s->weighted, &weighted, &s->inertia));
  PetscCall(Divergence(s, step, velocity));
  if (s->inertia)
    PetscCall(WeightedProjectionSolve(s->weighted, step->t, s->divergence, s->phi, iterations));
  else
    PetscCall(SolverSolve(s->ksp, "pressure", step->t, s->divergence, s->phi, iterations));
  PetscCall(VecGhostUpdateBegin(s->phi, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecGhostUpdateEnd(s->phi, INSERT_VALUES, SCATTER_FORWARD));
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
  Vec local;
  PetscFunctionBeginUser;
  PetscCall(VecGhostGetLocalForm(s->phi, &local));
  PetscCall(VecGetArrayRead(local, &phi));
  PetscCall(VecGetArray(velocity, &u));
  for (int e = 0; e < m->ne; e++) {
    double pe[6], grad[3][2];
    for (int k = 0; k < 6; k++) pe[k] = phi[d->p2->node[6 * e + k]];
    P2Gradient(d->geometry[e].g, pe, grad);
    if (s->inertia && WeightedProjectionVelocity(s->weighted, e, (const double(*)[2])grad, u + 6 * e))
      continue;
    if (step->inverse_density)
      SubtractTensor(step->dt, step->inverse_density[e].inverse, (const double(*)[2])grad, u + 6 * e);
    else
      for (int c = 0; c < 2; c++)
        for (int i = 0; i < 3; i++) u[6 * e + 3 * c + i] -= step->dt / step->rho[e] * grad[i][c];
  }
  PetscCall(VecRestoreArray(velocity, &u));
  PetscCall(VecRestoreArrayRead(local, &phi));
  PetscCall(VecGhostRestoreLocalForm(s->phi, &local));
  PetscFunctionReturn(0);
}
