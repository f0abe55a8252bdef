/* The momentum equation: assembled in place, one pass over the elements; solved for u*. */
#include "fluid/fluid_impl.h"

PetscErrorCode MomentumPattern(const Mesh *m, PetscInt block, Mat *matrix)
{
  double zero[36] = {0};
  PetscFunctionBeginUser;
  PetscCall(MatCreateBAIJ(m->comm, block, block * m->ne, block * m->ne, PETSC_DETERMINE, PETSC_DETERMINE, 4,
                          NULL, 3, NULL, matrix));
  for (int e = 0; e < m->ne; e++) {
    PetscInt cols[4] = {m->egid[e]}, n = 1;
    for (int i = 0; i < 3; i++)
      if (m->neighbor[3 * e + i] >= 0) cols[n++] = m->egid[m->neighbor[3 * e + i]];
    for (PetscInt k = 0; k < n; k++)
      PetscCall(MatSetValuesBlocked(*matrix, 1, &m->egid[e], 1, &cols[k], zero, INSERT_VALUES));
  }
  PetscCall(MatAssemblyBegin(*matrix, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(*matrix, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(0);
}

PetscErrorCode MatrixParts(Mat matrix, Mat *diagonal, Mat *offdiagonal, const PetscInt **garray)
{
  PetscBool parallel;
  PetscFunctionBeginUser;
  PetscCall(PetscObjectTypeCompare((PetscObject)matrix, MATMPIBAIJ, &parallel));
  *diagonal = matrix;
  *offdiagonal = NULL;
  *garray = NULL;
  if (parallel) PetscCall(MatMPIBAIJGetSeqBAIJ(matrix, diagonal, offdiagonal, garray));
  PetscFunctionReturn(0);
}

/* Where the block (row, global column) lies in a sequential part. */
static PetscErrorCode FindSlots(Fluid f, Mat part, const PetscInt garray[], PetscInt shift, PetscBool ghosts)
{
  const Mesh *m = f->mesh;
  const PetscInt *ia, *ja;
  PetscInt n;
  PetscBool done;
  PetscFunctionBeginUser;
  PetscCall(MatGetRowIJ(part, 0, PETSC_FALSE, PETSC_TRUE, &n, &ia, &ja, &done));
  PetscCheck(done, m->comm, PETSC_ERR_PLIB, "no access to the rows of the momentum matrix");
  for (int e = 0; e < m->ne; e++)
    for (PetscInt k = ia[e]; k < ia[e + 1]; k++) {
      const PetscInt column = garray ? garray[ja[k]] : ja[k] + shift;
      if (column == m->egid[e]) f->slot[4 * e] = k;
      for (int i = 0; i < 3; i++) {
        const int nb = m->neighbor[3 * e + i];
        if (nb >= 0 && m->egid[nb] == column) f->slot[4 * e + 1 + i] = ghosts ? -1 - k : k;
      }
    }
  PetscCall(MatRestoreRowIJ(part, 0, PETSC_FALSE, PETSC_TRUE, &n, &ia, &ja, &done));
  PetscFunctionReturn(0);
}

static PetscErrorCode CreateSolver(Fluid f)
{
  PetscFunctionBeginUser;
  PetscCall(KSPCreate(f->mesh->comm, &f->momentum_ksp));
  PetscCall(KSPSetOptionsPrefix(f->momentum_ksp, "momentum_"));
  PetscCall(KSPSetOperators(f->momentum_ksp, f->momentum, f->momentum));
  PetscCall(KSPSetType(f->momentum_ksp, KSPGMRES));
  PetscCall(KSPSetTolerances(f->momentum_ksp, 1e-6, 1e-50, 1e5, 500));
  PetscCall(KSPSetInitialGuessNonzero(f->momentum_ksp, PETSC_TRUE));
  PetscCall(PreconditionerCreate(f));
  PetscCall(KSPSetFromOptions(f->momentum_ksp));
  PetscFunctionReturn(0);
}

PetscErrorCode MomentumCreate(Fluid f)
{
  const Mesh *m = f->mesh;
  Mat diagonal, offdiagonal;
  const PetscInt *garray;
  PetscInt *ghosts;
  Vec *all[] = {&f->u,    &f->u_previous, &f->u_star,  &f->u_next,
                &f->beta, &f->load,       &f->saved_u, &f->saved_previous};
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(m->ng, &ghosts));
  for (int e = 0; e < m->ng; e++) ghosts[e] = m->egid[m->ne + e];
  PetscCall(VecCreateGhostBlock(m->comm, 6, 6 * m->ne, PETSC_DETERMINE, m->ng, ghosts, all[0]));
  for (size_t k = 1; k < sizeof all / sizeof *all; k++) PetscCall(VecDuplicate(*all[0], all[k]));
  PetscCall(PetscFree(ghosts));
  PetscCall(MomentumPattern(m, 6, &f->momentum));
  PetscCall(PetscMalloc1(4 * m->ne, &f->slot));
  PetscCall(MatrixParts(f->momentum, &diagonal, &offdiagonal, &garray));
  PetscCall(FindSlots(f, diagonal, NULL, m->estart, PETSC_FALSE));
  if (offdiagonal) PetscCall(FindSlots(f, offdiagonal, garray, 0, PETSC_TRUE));
  PetscCall(CreateSolver(f));
  PetscFunctionReturn(0);
}

PetscErrorCode MomentumDestroy(Fluid f)
{
  Vec *all[] = {&f->u,    &f->u_previous, &f->u_star,  &f->u_next,
                &f->beta, &f->load,       &f->saved_u, &f->saved_previous};
  PetscFunctionBeginUser;
  for (size_t k = 0; k < sizeof all / sizeof *all; k++) PetscCall(VecDestroy(all[k]));
  PetscCall(MatDestroy(&f->momentum));
  PetscCall(KSPDestroy(&f->momentum_ksp));
  PetscCall(PetscFree(f->slot));
  PetscCall(PreconditionerDestroy(f));
  PetscFunctionReturn(0);
}

/* beta = u at t + theta dt, extrapolated; also the ghosts */
static PetscErrorCode Extrapolate(Fluid f, double dt)
{
  const double r = f->dt_previous > 0.0 ? dt / f->dt_previous : 0.0, s = f->setup.theta * r;
  PetscFunctionBeginUser;
  PetscCall(VecWAXPY(f->beta, -1.0, f->u_previous, f->u));
  PetscCall(VecWAXPY(f->u_star, r, f->beta, f->u)); /* the solver's first guess */
  PetscCall(VecAYPX(f->beta, s, f->u));
  PetscCall(VecGhostUpdateBegin(f->beta, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecGhostUpdateEnd(f->beta, INSERT_VALUES, SCATTER_FORWARD));
  PetscFunctionReturn(0);
}

/* load += lift (g^{n+1} + (1 - theta)/theta g^n) */
static void BoundaryLoad(Fluid f, const Boundary *b, const double project[2][2], int e, const FaceSide *side,
                         double dt, const double lift[4][6], double load[6])
{
  const int node[2] = {side->a, side->b};
  const double weight = (1.0 - f->setup.theta) / f->setup.theta;
  if (b->kind != BOUNDARY_VELOCITY) return;
  for (int r = 0; r < 2; r++) {
    double now[2], next[2];
    BoundaryVelocity(b, f->t, ElementVertex(f->mesh, e, node[r]), now);
    BoundaryVelocity(b, f->t + dt, ElementVertex(f->mesh, e, node[r]), next);
    for (int c = 0; c < 2; c++)
      for (int s = 0; s < 6; s++) load[s] += lift[2 * c + r][s] * (next[c] + weight * now[c]);
  }
}

/* One face of element e: the blocks, and the load of a boundary. */
static void AssembleFace(Fluid f, int e, int i, double dt, const double beta[], double own[36],
                         double other[36], double load[6])
{
  const Mesh *m = f->mesh;
  const double theta = f->setup.theta, rho = theta * f->rho[e];
  const FaceGeometry face = f->geometry[e].face[i];
  const int nb = m->neighbor[3 * e + i];
  const double *bk = beta + 6 * e;
  double bn[2], inflow[2][2] = {{0}};
  if (nb >= 0) {
    const int j = m->neighbor_face[3 * e + i];
    const FaceSide k = FaceSideOf(f, e, i, theta, PENALTY_INTERIOR);
    FaceSide o = FaceSideOf(f, nb, j, theta, PENALTY_INTERIOR);
    const double *bo = beta + 6 * nb;
    const int swap = o.a;
    o.a = o.b, o.b = swap; /* seen from the other side the face runs backwards */
    bn[0] = 0.5 * (face.n[0] * (bk[k.a] + bo[o.a]) + face.n[1] * (bk[3 + k.a] + bo[3 + o.a]));
    bn[1] = 0.5 * (face.n[0] * (bk[k.b] + bo[o.b]) + face.n[1] * (bk[3 + k.b] + bo[3 + o.b]));
    if (bn[0] < 0.0 || bn[1] < 0.0) FaceInflow(rho, face.length, bn, inflow);
    MomentumFace(&face, &k, &o, inflow, own, other);
    return;
  }
  const Boundary *b = BoundaryOfFace(f, e, i);
  if (b->kind == BOUNDARY_OPEN) return;
  const FaceSide k = FaceSideOf(f, e, i, theta, PENALTY_BOUNDARY);
  double project[2][2], lift[4][6];
  BoundaryProjection(b, face.n, project);
  if (b->kind == BOUNDARY_VELOCITY) {
    bn[0] = face.n[0] * bk[k.a] + face.n[1] * bk[3 + k.a];
    bn[1] = face.n[0] * bk[k.b] + face.n[1] * bk[3 + k.b];
    FaceInflow(rho, face.length, bn, inflow);
  }
  MomentumBoundaryFace(&face, &k, (const double(*)[2])project, inflow, own, lift);
  BoundaryLoad(f, b, (const double(*)[2])project, e, &k, dt, (const double(*)[6])lift, load);
}

/* Body force and pressure: M (rho g - grad p + source). */
static void ElementLoad(Fluid f, int e, double dt, const double p[], double load[6])
{
  const Mesh *m = f->mesh;
  const ElementGeometry *g = f->geometry + e;
  double pe[6], grad[3][2], q[2][3];
  for (int k = 0; k < 6; k++) pe[k] = p[m->p2[6 * e + k]];
  P2Gradient(g->g, pe, grad);
  for (int i = 0; i < 3; i++) {
    double now[2] = {0}, next[2] = {0};
    if (f->setup.source) {
      f->setup.source(f->setup.source_context, f->t, ElementVertex(m, e, i), now);
      f->setup.source(f->setup.source_context, f->t + dt, ElementVertex(m, e, i), next);
    }
    for (int c = 0; c < 2; c++)
      q[c][i] = f->rho[e] * f->setup.gravity[c] - grad[i][c] + f->setup.theta * next[c] +
                (1.0 - f->setup.theta) * now[c];
  }
  for (int c = 0; c < 2; c++) {
    double mq[3];
    P1MassApply(g->area, q[c], mq);
    for (int i = 0; i < 3; i++) load[3 * c + i] += mq[i];
  }
}

/* rho M/dt u^n (1 + w) + w a u^n + s, w = (1 - theta)/theta: what is left of -(1 - theta) L u^n = -w (A - rho
 * M/dt - a) u^n once A u^n has been taken off; and the coupling's part of the block. */
static void ElementInertia(Fluid f, int e, double dt, const double u[6], double own[36], double load[6])
{
  const double w = (1.0 - f->setup.theta) / f->setup.theta;
  const double *q[2] = {u, u + 3};
  for (int c = 0; c < 2; c++) {
    double mu[3];
    P1MassApply(f->geometry[e].area, q[c], mu);
    for (int i = 0; i < 3; i++) load[3 * c + i] += (1.0 + w) * f->rho[e] / dt * mu[i];
  }
  if (f->coupling_of[e] < 0) return;
  const CoracleCoupling *k = f->coupling + f->coupling_of[e];
  const double *a = &k->a[0][0][0][0], *s = &k->s[0][0];
  for (int row = 0; row < 6; row++) {
    load[row] += s[row];
    for (int col = 0; col < 6; col++) {
      own[6 * col + row] += a[6 * row + col];
      load[row] += w * a[6 * row + col] * u[col];
    }
  }
}

static PetscErrorCode Assemble(Fluid f, double dt)
{
  const Mesh *m = f->mesh;
  Mat diagonal, offdiagonal;
  const PetscInt *garray;
  PetscScalar *ad, *ao = NULL, *load;
  const PetscScalar *beta, *u, *p;
  Vec beta_local, p_local;
  PetscFunctionBeginUser;
  PetscCall(MatrixParts(f->momentum, &diagonal, &offdiagonal, &garray));
  PetscCall(VecGhostGetLocalForm(f->beta, &beta_local));
  PetscCall(VecGhostGetLocalForm(f->p, &p_local));
  PetscCall(MatSeqBAIJGetArray(diagonal, &ad));
  if (offdiagonal) PetscCall(MatSeqBAIJGetArray(offdiagonal, &ao));
  PetscCall(VecGetArrayRead(beta_local, &beta));
  PetscCall(VecGetArrayRead(p_local, &p));
  PetscCall(VecGetArrayRead(f->u, &u));
  PetscCall(VecGetArray(f->load, &load));
  for (int e = 0; e < m->ne; e++) {
    double *own = ad + 36 * f->slot[4 * e], *l = load + 6 * e, unused[36];
    MomentumVolume(f->geometry + e, f->rho[e] / dt, f->setup.theta * f->rho[e], f->setup.theta * f->mu[e],
                   beta + 6 * e, own);
    memset(l, 0, 6 * sizeof *l);
    for (int i = 0; i < 3; i++) {
      const PetscInt k = f->slot[4 * e + 1 + i];
      double *other = m->neighbor[3 * e + i] < 0 ? unused : k >= 0 ? ad + 36 * k : ao + 36 * (-1 - k);
      AssembleFace(f, e, i, dt, beta, own, other, l);
    }
    ElementLoad(f, e, dt, p, l);
    ElementInertia(f, e, dt, u + 6 * e, own, l);
  }
  PetscCall(VecRestoreArray(f->load, &load));
  PetscCall(VecRestoreArrayRead(f->u, &u));
  PetscCall(VecRestoreArrayRead(p_local, &p));
  PetscCall(VecRestoreArrayRead(beta_local, &beta));
  if (offdiagonal) PetscCall(MatSeqBAIJRestoreArray(offdiagonal, &ao));
  PetscCall(MatSeqBAIJRestoreArray(diagonal, &ad));
  PetscCall(VecGhostRestoreLocalForm(f->p, &p_local));
  PetscCall(VecGhostRestoreLocalForm(f->beta, &beta_local));
  PetscCall(MatAssemblyBegin(f->momentum, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(f->momentum, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(0);
}

static PetscErrorCode Solve(Fluid f)
{
  PetscInt iterations;
  KSPConvergedReason reason;
  PetscFunctionBeginUser;
  PetscCall(KSPSolve(f->momentum_ksp, f->load, f->u_star));
  PetscCall(KSPGetConvergedReason(f->momentum_ksp, &reason));
  PetscCall(KSPGetIterationNumber(f->momentum_ksp, &iterations));
  PetscCheck(reason > 0, f->mesh->comm, PETSC_ERR_NOT_CONVERGED,
             "the momentum equation did not converge at t = %g s: %s after %d iterations", f->t,
             KSPConvergedReasons[reason], (int)iterations);
  f->stats.momentum_iterations = iterations;
  PetscFunctionReturn(0);
}

PetscErrorCode FluidMomentum(Fluid f, double dt)
{
  const double w = (1.0 - f->setup.theta) / f->setup.theta;
  const double start = MPI_Wtime();
  PetscFunctionBeginUser;
  f->stats.dt = dt;
  PetscCall(Extrapolate(f, dt));
  PetscCall(Assemble(f, dt));
  if (w > 0.0) {
    PetscCall(MatMult(f->momentum, f->u, f->u_next));
    PetscCall(VecAXPY(f->load, -w, f->u_next));
  }
  PetscCall(PreconditionerUpdate(f));
  const double assembled = MPI_Wtime();
  PetscCall(Solve(f));
  f->stats.seconds[ASSEMBLY] += assembled - start;
  f->stats.seconds[MOMENTUM] += MPI_Wtime() - assembled;
  PetscFunctionReturn(0);
}
