/* The momentum equation: matrix and load, one pass over the elements, the matrix written in place. */
#include "fluid/element_matrix.h"
#include "fluid/momentum_impl.h"

/* load += lift (g^{n+1} + (1 - theta)/theta g^n) */
static void BoundaryLoad(MomentumSolver s, const MomentumStep *step, const Boundary *b,
                         const double project[2][2], int e, const FaceSide *side, const double lift[4][6],
                         double load[6])
{
  const int node[2] = {side->a, side->b};
  const double weight = (1.0 - s->setup.theta) / s->setup.theta;
  if (b->kind != BOUNDARY_VELOCITY) return;
  for (int r = 0; r < 2; r++) {
    double now[2], next[2];
    BoundaryVelocity(b, step->t, ElementVertex(s->domain->mesh, e, node[r]), now);
    BoundaryVelocity(b, step->t + step->dt, ElementVertex(s->domain->mesh, e, node[r]), next);
    for (int c = 0; c < 2; c++)
      for (int k = 0; k < 6; k++) load[k] += lift[2 * c + r][k] * (next[c] + weight * now[c]);
  }
}

/* One face of element e: the blocks, and the load of a boundary. */
static void AssembleFace(MomentumSolver s, const MomentumStep *step, int e, int i, const double flux[],
                         double own[36], double other[36], double load[6])
{
  const Mesh *m = s->domain->mesh;
  const double theta = s->setup.theta;
  const FaceGeometry face = s->domain->geometry[e].face[i];
  const int nb = m->neighbor[3 * e + i];
  const double *mk = flux + 6 * e;
  double mn[2], inflow[2][2] = {{0}};
  if (nb >= 0) {
    const int j = m->neighbor_face[3 * e + i];
    const FaceSide k = FaceSideOf(s->domain, step->mu, e, i, theta, PENALTY_INTERIOR);
    FaceSide o = FaceSideOf(s->domain, step->mu, nb, j, theta, PENALTY_INTERIOR);
    const double *mo = flux + 6 * nb;
    const int swap = o.a;
    o.a = o.b, o.b = swap; /* seen from the other side the face runs backwards */
    mn[0] = 0.5 * (face.n[0] * (mk[k.a] + mo[o.a]) + face.n[1] * (mk[3 + k.a] + mo[3 + o.a]));
    mn[1] = 0.5 * (face.n[0] * (mk[k.b] + mo[o.b]) + face.n[1] * (mk[3 + k.b] + mo[3 + o.b]));
    if (mn[0] < 0.0 || mn[1] < 0.0) FaceInflow(theta, face.length, mn, inflow);
    MomentumFace(&face, &k, &o, inflow, own, other);
    return;
  }
  const Boundary *b = BoundaryOfFace(s->domain, e, i);
  if (b->kind == BOUNDARY_OPEN) return;
  const FaceSide k = FaceSideOf(s->domain, step->mu, e, i, theta, PENALTY_BOUNDARY);
  double project[2][2], lift[4][6];
  BoundaryProjection(b, face.n, project);
  if (b->kind == BOUNDARY_VELOCITY) {
    mn[0] = face.n[0] * mk[k.a] + face.n[1] * mk[3 + k.a];
    mn[1] = face.n[0] * mk[k.b] + face.n[1] * mk[3 + k.b];
    FaceInflow(theta, face.length, mn, inflow);
  }
  MomentumBoundaryFace(&face, &k, (const double(*)[2])project, inflow, own, lift);
  BoundaryLoad(s, step, b, (const double(*)[2])project, e, &k, (const double(*)[6])lift, load);
}

/* Body force and pressure: M (rho g - grad p + source). */
static void ElementLoad(MomentumSolver s, const MomentumStep *step, int e, const double p[], double load[6])
{
  const Mesh *m = s->domain->mesh;
  const ElementGeometry *g = s->domain->geometry + e;
  double pe[6], grad[3][2], q[2][3];
  for (int k = 0; k < 6; k++) pe[k] = p[m->p2[6 * e + k]];
  P2Gradient(g->g, pe, grad);
  for (int i = 0; i < 3; i++) {
    double now[2] = {0}, next[2] = {0};
    if (s->setup.source) {
      s->setup.source(s->setup.source_context, step->t, ElementVertex(m, e, i), now);
      s->setup.source(s->setup.source_context, step->t + step->dt, ElementVertex(m, e, i), next);
    }
    for (int c = 0; c < 2; c++)
      q[c][i] = step->rho[e] * s->setup.gravity[c] - grad[i][c] + s->setup.theta * next[c] +
                (1.0 - s->setup.theta) * now[c];
  }
  for (int c = 0; c < 2; c++) {
    double mq[3];
    P1MassApply(g->area, q[c], mq);
    for (int i = 0; i < 3; i++) load[3 * c + i] += mq[i];
  }
}

/* rho M/dt u^n (1 + w) + w a u^n + s, w = (1 - theta)/theta: what is left of -(1 - theta) L u^n = -w (A - rho
 * M/dt - a) u^n once A u^n has been taken off; and the coupling's part of the block. */
static void ElementInertia(MomentumSolver s, const MomentumStep *step, int e, const double u[6],
                           double own[36], double load[6])
{
  const double w = (1.0 - s->setup.theta) / s->setup.theta;
  const double *q[2] = {u, u + 3};
  for (int c = 0; c < 2; c++) {
    double mu[3];
    P1MassApply(s->domain->geometry[e].area, q[c], mu);
    for (int i = 0; i < 3; i++) load[3 * c + i] += (1.0 + w) * step->rho[e] / step->dt * mu[i];
  }
  const CoracleCoupling *k = SolidCouplingAt(step->solid, e);
  if (!k) return;
  const double *a = &k->a[0][0][0][0], *explicit_part = &k->s[0][0];
  for (int row = 0; row < 6; row++) {
    load[row] += explicit_part[row];
    for (int col = 0; col < 6; col++) {
      own[6 * col + row] += a[6 * row + col];
      load[row] += w * a[6 * row + col] * u[col];
    }
  }
}

/* Row block and load of element e; ad, ao: the blocks of the matrix's two parts. */
static void AssembleElement(MomentumSolver s, const MomentumStep *step, int e, const double flux[],
                            const double u[6], const double p[], double ad[], double ao[], double load[6])
{
  const FluidDomain *d = s->domain;
  const PetscInt *slot = s->slot + 4 * e;
  double *own = ad + 36 * slot[0], unused[36];
  MomentumVolume(d->geometry + e, step->rho[e] / step->dt, s->setup.theta, s->setup.theta * step->mu[e],
                 flux + 6 * e, own);
  memset(load, 0, 6 * sizeof *load);
  for (int i = 0; i < 3; i++) {
    const PetscInt k = slot[1 + i];
    double *other = d->mesh->neighbor[3 * e + i] < 0 ? unused : k >= 0 ? ad + 36 * k : ao + 36 * (-1 - k);
    AssembleFace(s, step, e, i, flux, own, other, load);
  }
  ElementLoad(s, step, e, p, load);
  ElementInertia(s, step, e, u, own, load);
}

PetscErrorCode MomentumAssemble(MomentumSolver s, const MomentumStep *step)
{
  Mat diagonal, off_diagonal;
  PetscScalar *ad, *ao = NULL, *load;
  const PetscScalar *flux, *u, *p;
  Vec flux_local, p_local;
  PetscFunctionBeginUser;
  PetscCall(ElementMatrixParts(s->matrix, &diagonal, &off_diagonal, NULL));
  PetscCall(VecGhostGetLocalForm(step->mass_flux, &flux_local));
  PetscCall(VecGhostGetLocalForm(step->p, &p_local));
  PetscCall(MatSeqBAIJGetArray(diagonal, &ad));
  if (off_diagonal) PetscCall(MatSeqBAIJGetArray(off_diagonal, &ao));
  PetscCall(VecGetArrayRead(flux_local, &flux));
  PetscCall(VecGetArrayRead(p_local, &p));
  PetscCall(VecGetArrayRead(step->u, &u));
  PetscCall(VecGetArray(s->load, &load));
  for (int e = 0; e < s->domain->mesh->ne; e++)
    AssembleElement(s, step, e, flux, u + 6 * e, p, ad, ao, load + 6 * e);
  PetscCall(VecRestoreArray(s->load, &load));
  PetscCall(VecRestoreArrayRead(step->u, &u));
  PetscCall(VecRestoreArrayRead(p_local, &p));
  PetscCall(VecRestoreArrayRead(flux_local, &flux));
  if (off_diagonal) PetscCall(MatSeqBAIJRestoreArray(off_diagonal, &ao));
  PetscCall(MatSeqBAIJRestoreArray(diagonal, &ad));
  PetscCall(VecGhostRestoreLocalForm(step->p, &p_local));
  PetscCall(VecGhostRestoreLocalForm(step->mass_flux, &flux_local));
  PetscCall(MatAssemblyBegin(s->matrix, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(s->matrix, MAT_FINAL_ASSEMBLY));
  PetscFunctionReturn(0);
}
