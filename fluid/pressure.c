/* The projection: int dt/rho grad phi.grad q = int u_hat*.grad q - <q, g.n> over P2, u+ = u* - dt/rho grad
 * phi. grad(P2) lies in P1DG, so the second is exact and the matrix of the first is C^T M^-1 C itself. u_hat*
 * = u* + M^-1 (us - ms u*): inside the solid the flow that must be free of divergence is the solid's. */
#include "fluid/fluid_impl.h"

/* Owned P2 nodes where phi = 0: on open boundaries; without any, global node 0. */
static PetscErrorCode FindFixed(Fluid f)
{
  const Mesh *m = f->mesh;
  char *fixed;
  int has_open = 0;
  Vec mark;
  PetscScalar *v;
  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(m->np2, &fixed));
  for (int e = 0; e < m->ne; e++)
    for (int i = 0; i < 3; i++) {
      const Boundary *b = BoundaryOfFace(f, e, i);
      if (!b || b->kind != BOUNDARY_OPEN) continue;
      fixed[m->p2[6 * e + (i + 1) % 3]] = fixed[m->p2[6 * e + (i + 2) % 3]] = fixed[m->p2[6 * e + 3 + i]] = 1;
      has_open = 1;
    }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &has_open, 1, MPI_INT, MPI_MAX, m->comm));
  f->has_open = (PetscBool)has_open;
  if (!has_open && m->np2_owned > 0 && m->p2start == 0) fixed[0] = 1;
  /* the owner of a node need not have an element with the face */
  PetscCall(VecDuplicate(f->p, &mark));
  Vec local;
  PetscCall(VecGhostGetLocalForm(mark, &local));
  PetscCall(VecGetArray(local, &v));
  for (int k = 0; k < m->np2; k++) v[k] = fixed[k];
  PetscCall(VecRestoreArray(local, &v));
  PetscCall(VecGhostRestoreLocalForm(mark, &local));
  PetscCall(VecGhostUpdateBegin(mark, ADD_VALUES, SCATTER_REVERSE));
  PetscCall(VecGhostUpdateEnd(mark, ADD_VALUES, SCATTER_REVERSE));
  PetscCall(VecGhostUpdateBegin(mark, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecGhostUpdateEnd(mark, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecGhostGetLocalForm(mark, &local));
  PetscCall(VecGetArray(local, &v));
  PetscCall(PetscMalloc1(m->np2_owned, &f->fixed));
  for (int k = 0; k < m->np2; k++) {
    fixed[k] = v[k] > 0.5;
    if (fixed[k] && k < m->np2_owned) f->fixed[f->nfixed++] = k;
  }
  PetscCall(VecRestoreArray(local, &v));
  PetscCall(VecGhostRestoreLocalForm(mark, &local));
  PetscCall(VecDestroy(&mark));
  f->is_fixed = fixed;
  PetscFunctionReturn(0);
}

static PetscErrorCode AssembleLaplacian(Fluid f)
{
  const Mesh *m = f->mesh;
  PetscInt *rows;
  PetscFunctionBeginUser;
  PetscCall(MatCreateAIJ(m->comm, m->np2_owned, m->np2_owned, PETSC_DETERMINE, PETSC_DETERMINE, 28, NULL, 14,
                         NULL, &f->laplacian));
  PetscCall(MatSetOption(f->laplacian, MAT_NEW_NONZERO_ALLOCATION_ERR, PETSC_FALSE));
  for (int e = 0; e < m->ne; e++) {
    double s[6][6];
    PetscInt gid[6];
    P2Stiffness(f->geometry[e].area, (const double(*)[2])f->geometry[e].g, 1.0 / f->rho[e], s);
    for (int k = 0; k < 6; k++) gid[k] = m->p2gid[m->p2[6 * e + k]];
    PetscCall(MatSetValues(f->laplacian, 6, gid, 6, gid, &s[0][0], ADD_VALUES));
  }
  PetscCall(MatAssemblyBegin(f->laplacian, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(f->laplacian, MAT_FINAL_ASSEMBLY));
  PetscCall(PetscMalloc1(f->nfixed, &rows));
  for (int k = 0; k < f->nfixed; k++) rows[k] = m->p2start + f->fixed[k];
  PetscCall(MatZeroRowsColumns(f->laplacian, f->nfixed, rows, 1.0, NULL, NULL));
  PetscCall(PetscFree(rows));
  PetscCall(MatSetOption(f->laplacian, MAT_SPD, PETSC_TRUE));
  PetscFunctionReturn(0);
}

static PetscErrorCode DefaultOf(const char *prefix, const char *option, const char *value)
{
  char name[96];
  PetscFunctionBeginUser;
  PetscCall(PetscSNPrintf(name, sizeof name, "-%s%s", prefix, option));
  PetscCall(FluidDefaultOption(name, value));
  PetscFunctionReturn(0);
}

/* A direct factor: PETSc's own Cholesky, whose two triangular solves are twice as fast here as those of the supernodal
 * packages.  On several ranks one of them has the factor: its solve costs less than a distributed one, until the
 * mesh is large; -<prefix>pc_type and the like choose otherwise. */
PetscErrorCode PressureSolver(Fluid f, const char *prefix, KSPType type, KSP *ksp)
{
  PetscMPIInt size;
  PC pc;
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_size(f->mesh->comm, &size));
  PetscCall(KSPCreate(f->mesh->comm, ksp));
  PetscCall(KSPSetOptionsPrefix(*ksp, prefix));
  PetscCall(KSPSetType(*ksp, type));
  PetscCall(KSPGetPC(*ksp, &pc));
  if (size == 1) {
    PetscCall(PCSetType(pc, PCCHOLESKY));
    PetscCall(PCFactorSetMatOrderingType(pc, MATORDERINGAMD));
  } else {
    PetscCall(PCSetType(pc, PCTELESCOPE));
    PetscCall(PCTelescopeSetReductionFactor(pc, size));
    PetscCall(DefaultOf(prefix, "telescope_ksp_type", "preonly"));
    PetscCall(DefaultOf(prefix, "telescope_pc_type", "cholesky"));
    PetscCall(DefaultOf(prefix, "telescope_pc_factor_mat_ordering_type", "amd"));
  }
  PetscFunctionReturn(0);
}

/* Factored once a mesh. */
static PetscErrorCode CreateSolver(Fluid f)
{
  PetscFunctionBeginUser;
  PetscCall(PressureSolver(f, "pressure_", KSPPREONLY, &f->pressure_ksp));
  PetscCall(KSPSetOperators(f->pressure_ksp, f->laplacian, f->laplacian));
  PetscCall(KSPSetTolerances(f->pressure_ksp, 1e-9, 1e-50, 1e5, 500));
  PetscCall(KSPSetFromOptions(f->pressure_ksp));
  PetscCall(KSPSetUp(f->pressure_ksp));
  PetscFunctionReturn(0);
}

PetscErrorCode PressureCreate(Fluid f)
{
  const Mesh *m = f->mesh;
  Vec *all[] = {&f->p, &f->phi, &f->divergence, &f->saved_p};
  PetscFunctionBeginUser;
  PetscCall(VecCreateGhost(m->comm, m->np2_owned, PETSC_DETERMINE, m->np2 - m->np2_owned,
                           m->p2gid + m->np2_owned, all[0]));
  for (size_t k = 1; k < sizeof all / sizeof *all; k++) PetscCall(VecDuplicate(*all[0], all[k]));
  PetscCall(FindFixed(f));
  PetscCall(AssembleLaplacian(f));
  PetscCall(CreateSolver(f));
  PetscFunctionReturn(0);
}

PetscErrorCode PressureDestroy(Fluid f)
{
  Vec *all[] = {&f->p, &f->phi, &f->divergence, &f->saved_p};
  PetscFunctionBeginUser;
  for (size_t k = 0; k < sizeof all / sizeof *all; k++) PetscCall(VecDestroy(all[k]));
  PetscCall(MatDestroy(&f->laplacian));
  PetscCall(KSPDestroy(&f->pressure_ksp));
  PetscCall(PetscFree(f->fixed));
  PetscCall(PetscFree(f->is_fixed));
  PetscCall(WeightedProjectionDestroy(f));
  PetscFunctionReturn(0);
}

/* r -= <q, g.n> on boundaries that prescribe the velocity: Simpson's rule, exact for q in P2 and constant g
 */
static void BoundaryFlux(Fluid f, int e, double t, double r[6])
{
  for (int i = 0; i < 3; i++) {
    const Boundary *b = BoundaryOfFace(f, e, i);
    if (!b || b->kind != BOUNDARY_VELOCITY) continue;
    const FaceGeometry face = f->geometry[e].face[i];
    const int node[3] = {(i + 1) % 3, 3 + i, (i + 2) % 3};
    const double *xa = ElementVertex(f->mesh, e, node[0]), *xb = ElementVertex(f->mesh, e, node[2]);
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
static void BulkMomentum(Fluid f, int e, const double u[6], double mv[2][3])
{
  for (int c = 0; c < 2; c++) P1MassApply(f->geometry[e].area, u + 3 * c, mv[c]);
  if (f->coupling_of[e] < 0) return;
  const CoracleCoupling *k = f->coupling + f->coupling_of[e];
  for (int c = 0; c < 2; c++)
    for (int i = 0; i < 3; i++) {
      mv[c][i] += k->us[c][i];
      for (int j = 0; j < 3; j++) mv[c][i] -= k->ms[i][j] * u[3 * c + j];
    }
}

/* of the bulk velocity made of u, at time t, over dt */
static PetscErrorCode Divergence(Fluid f, Vec velocity, double t, double dt)
{
  const Mesh *m = f->mesh;
  const PetscScalar *u;
  PetscScalar *d;
  Vec local;
  PetscFunctionBeginUser;
  PetscCall(VecGhostGetLocalForm(f->divergence, &local));
  PetscCall(VecSet(local, 0.0));
  PetscCall(VecGetArray(local, &d));
  PetscCall(VecGetArrayRead(velocity, &u));
  for (int e = 0; e < m->ne; e++) {
    double mv[2][3], r[6] = {0};
    BulkMomentum(f, e, u + 6 * e, mv);
    P2GradientTranspose(f->geometry[e].g, (const double(*)[3])mv, r);
    BoundaryFlux(f, e, t, r);
    for (int k = 0; k < 6; k++) d[m->p2[6 * e + k]] += r[k];
  }
  PetscCall(VecRestoreArrayRead(velocity, &u));
  PetscCall(VecRestoreArray(local, &d));
  PetscCall(VecGhostRestoreLocalForm(f->divergence, &local));
  PetscCall(VecGhostUpdateBegin(f->divergence, ADD_VALUES, SCATTER_REVERSE));
  PetscCall(VecGhostUpdateEnd(f->divergence, ADD_VALUES, SCATTER_REVERSE));
  PetscCall(VecGetArray(f->divergence, &d));
  for (int k = 0; k < f->nfixed; k++) d[f->fixed[k]] = 0.0;
  PetscCall(VecRestoreArray(f->divergence, &d));
  PetscCall(VecScale(f->divergence, 1.0 / dt));
  PetscFunctionReturn(0);
}

/* velocity -= dt/rho grad phi, or what a solid that gives way makes of it */
static PetscErrorCode SubtractGradient(Fluid f, double dt, Vec velocity)
{
  const Mesh *m = f->mesh;
  const PetscScalar *phi;
  PetscScalar *u;
  Vec local;
  PetscFunctionBeginUser;
  PetscCall(VecGhostGetLocalForm(f->phi, &local));
  PetscCall(VecGetArrayRead(local, &phi));
  PetscCall(VecGetArray(velocity, &u));
  for (int e = 0; e < m->ne; e++) {
    double pe[6], grad[3][2];
    for (int k = 0; k < 6; k++) pe[k] = phi[m->p2[6 * e + k]];
    P2Gradient(f->geometry[e].g, pe, grad);
    if (WeightedProjectionVelocity(f, e, (const double(*)[2])grad, u + 6 * e)) continue;
    for (int c = 0; c < 2; c++)
      for (int i = 0; i < 3; i++) u[6 * e + 3 * c + i] -= dt / f->rho[e] * grad[i][c];
  }
  PetscCall(VecRestoreArray(velocity, &u));
  PetscCall(VecRestoreArrayRead(local, &phi));
  PetscCall(VecGhostRestoreLocalForm(f->phi, &local));
  PetscFunctionReturn(0);
}

/* phi, with ghosts, for which u* - dt/rho grad phi is free of divergence */
static PetscErrorCode Solve(Fluid f)
{
  PetscInt iterations;
  KSPConvergedReason reason;
  PetscFunctionBeginUser;
  const KSP ksp = f->gives ? f->giving_ksp : f->pressure_ksp;
  PetscCall(KSPSolve(ksp, f->divergence, f->phi));
  PetscCall(KSPGetConvergedReason(ksp, &reason));
  PetscCall(KSPGetIterationNumber(ksp, &iterations));
  PetscCheck(reason > 0, f->mesh->comm, PETSC_ERR_NOT_CONVERGED,
             "the pressure equation did not converge at t = %g s: %s after %d iterations", f->t,
             KSPConvergedReasons[reason], (int)iterations);
  f->stats.pressure_iterations = iterations;
  if (f->gives) f->giving_iterations = iterations;
  PetscCall(VecGhostUpdateBegin(f->phi, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecGhostUpdateEnd(f->phi, INSERT_VALUES, SCATTER_FORWARD));
  PetscFunctionReturn(0);
}

PetscErrorCode FluidProject(Fluid f, double dt)
{
  const double start = MPI_Wtime();
  PetscFunctionBeginUser;
  PetscCall(WeightedProjectionPrepare(f, dt));
  PetscCall(Divergence(f, f->u_star, f->t + dt, dt));
  PetscCall(Solve(f));
  PetscCall(VecCopy(f->u_star, f->u_next));
  PetscCall(SubtractGradient(f, dt, f->u_next));
  PetscCall(VecAXPY(f->p, 1.0, f->phi));
  PetscCall(VecGhostUpdateBegin(f->p, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecGhostUpdateEnd(f->p, INSERT_VALUES, SCATTER_FORWARD));
  f->stats.seconds[PRESSURE] += MPI_Wtime() - start;
  PetscFunctionReturn(0);
}

PetscErrorCode FluidMakeSolenoidal(Fluid f)
{
  const double start = MPI_Wtime(), dt = 1.0; /* any: it is taken out again */
  PetscFunctionBeginUser;
  f->gives = PETSC_FALSE;
  PetscCall(Divergence(f, f->u, f->t, dt));
  PetscCall(Solve(f));
  PetscCall(SubtractGradient(f, dt, f->u));
  PetscCall(SubtractGradient(f, dt, f->u_previous)); /* their difference extrapolates */
  f->stats.seconds[PRESSURE] += MPI_Wtime() - start;
  PetscFunctionReturn(0);
}
