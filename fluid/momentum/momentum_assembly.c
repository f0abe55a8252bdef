/* The momentum equation: operator and load, one pass over the elements. */
#include "fluid/discretization/ghosted.h"
#include "fluid/momentum/momentum_impl.h"

/* Of jumps beside an interface, in densities times lengths over the time step. */
#define INTERFACE_PENALTY 0.5

/* load += lift (g^{n+1} + (1 - theta)/theta g^n) */
static void BoundaryLoad(MomentumSolver s, const MomentumStep *step, const Boundary *b, int e,
                         const FaceSide *side, const double lift[4][6], double load[6])
{
  const int node[2] = {side->a, side->b};
  const double weight = (1.0 - s->theta) / s->theta;
  if (b->kind != BOUNDARY_VELOCITY) return;
  for (int r = 0; r < 2; r++) {
    double now[2], next[2];
    BoundaryVelocity(b, step->t, ElementVertex(s->domain->mesh, e, node[r]), now);
    BoundaryVelocity(b, step->t + step->dt, ElementVertex(s->domain->mesh, e, node[r]), next);
    for (int c = 0; c < 2; c++)
      for (int k = 0; k < 6; k++) load[k] += lift[2 * c + r][k] * (next[c] + weight * now[c]);
  }
}

/* Penalty of jumps, Pa s/m, beside an interface: what the lines' errors move there, mostly light elements, is given to their
 * neighbours within a step, momentum conserved.  Of the lighter side's density, so that water does not feel air.  A solid in
 * an element makes no interface: water beside it is not held to the water around by what fills the solid. */
static double InterfacePenalty(const MomentumStep *step, int e, int nb, double area, double other)
{
  if (!step->outside) return 0.0;
  const double a = step->outside[e], b = step->outside[nb];
  if (fmin(a, b) == 0.0 || fabs(a - b) < 1e-6 * (a + b)) return 0.0;
  return INTERFACE_PENALTY * fmin(a, b) * sqrt(fmin(area, other)) / step->dt;
}

/* Both sides of interior face i of element e; the other one, seen from e, runs backwards. */
static inline void Sides(MomentumSolver s, const double mu[], int e, int i, FaceSide *k, FaceSide *o)
{
  const FluidDomain *d = s->domain;
  const int nb = d->mesh->neighbor[3 * e + i], j = d->mesh->neighbor_face[3 * e + i];
  *k = FaceSideOf(d, mu, e, i, s->theta, PENALTY_INTERIOR);
  *o = FaceSideOf(d, mu, nb, j, s->theta, PENALTY_INTERIOR);
  const int swap = o->a;
  o->a = o->b, o->b = swap;
}

/* Viscous stress and penalty of interior face i of element e. */
static inline __attribute__((always_inline)) void
AssembleViscous(MomentumSolver s, const MomentumStep *step, int e, int i, double own[9], double other[9])
{
  const FluidDomain *d = s->domain;
  const int nb = d->mesh->neighbor[3 * e + i];
  double none[2][2] = {{0}};
  FaceSide k, o;
  if (nb < 0) return;
  Sides(s, step->mu, e, i, &k, &o);
  o.eta += s->theta * InterfacePenalty(step, e, nb, d->geometry[e].area, d->geometry[nb].area);
  ScalarFace(d->geometry[e].face + i, &k, &o, none, own, other);
}

/* Of all interior faces of element e.  The face's number is a constant to the compiler in each of three copies. */
static void AssembleFaces(MomentumSolver s, const MomentumStep *step, int e, double block[4][9])
{
  double own[9] = {0};
  AssembleViscous(s, step, e, 0, own, block[1]);
  AssembleViscous(s, step, e, 1, own, block[2]);
  AssembleViscous(s, step, e, 2, own, block[3]);
  memcpy(block[0], own, sizeof own);
}

/* What flows in through interior face i of element e, upwind. */
static inline void AssembleInflow(MomentumSolver s, const double mu[], int e, int i, const double flux[],
                                  double block[4][9])
{
  const FaceGeometry *face = s->domain->geometry[e].face + i;
  const int nb = s->domain->mesh->neighbor[3 * e + i];
  double mn[2], inflow[2][2];
  FaceSide k, o;
  if (nb < 0) return;
  const double *mk = flux + 6 * e, *mo = flux + 6 * nb;
  Sides(s, mu, e, i, &k, &o);
  mn[0] = 0.5 * (face->n[0] * (mk[k.a] + mo[o.a]) + face->n[1] * (mk[3 + k.a] + mo[3 + o.a]));
  mn[1] = 0.5 * (face->n[0] * (mk[k.b] + mo[o.b]) + face->n[1] * (mk[3 + k.b] + mo[3 + o.b]));
  FluxDivergenceFace(face->length, mn, k.a, k.b, s->divergence[e]);
  if (mn[0] >= 0.0 && mn[1] >= 0.0) return;
  FaceInflow(s->theta, face->length, mn, inflow);
  const int row[2] = {k.a, k.b}, col[2] = {o.a, o.b};
  for (int q = 0; q < 2; q++)
    for (int r = 0; r < 2; r++) {
      block[0][3 * row[q] + row[r]] += inflow[r][q];
      block[1 + i][3 * col[q] + row[r]] -= inflow[r][q];
    }
}

/* Boundary face i of element e: the dense block and the load; false where it is open and nothing comes in.  What comes in
 * through an open side has been at rest outside.  One fluid: half of its inflow term, as though p + rho u^2/2 were the
 * pressure prescribed (Bernoulli), so that inflow brings no kinetic energy: without it a vortex that leaves grows on
 * its way (tests/fluid/test_backflow.c).  Phases: the whole term, water that comes in is heavier than what leaves. */
static PetscBool AssembleBoundary(MomentumSolver s, const MomentumStep *step, int e, int i, const double m[6],
                                  double dense[36], double load[6])
{
  const FluidDomain *d = s->domain;
  const FaceGeometry *face = d->geometry[e].face + i;
  const Boundary *b = BoundaryOfFace(d, e, i);
  const FaceSide k = FaceSideOf(d, step->mu, e, i, s->theta, PENALTY_BOUNDARY);
  const PetscBool half = (PetscBool)(b->kind == BOUNDARY_OPEN && !step->inverse_density);
  double project[2][2], lift[4][6], mn[2], inflow[2][2] = {{0}};
  BoundaryProjection(b, face->n, project);
  mn[0] = face->n[0] * m[k.a] + face->n[1] * m[3 + k.a];
  mn[1] = face->n[0] * m[k.b] + face->n[1] * m[3 + k.b];
  FluxDivergenceFace(face->length, mn, k.a, k.b, s->divergence[e]);
  if (b->kind != BOUNDARY_FREE_SLIP) {
    if (b->kind == BOUNDARY_OPEN && mn[0] >= 0.0 && mn[1] >= 0.0) return PETSC_FALSE;
    FaceInflow(s->theta * (half ? 0.5 : 1.0), face->length, mn, inflow);
  }
  MomentumBoundaryFace(face, &k, (const double(*)[2])project, inflow, dense, lift);
  BoundaryLoad(s, step, b, e, &k, (const double(*)[6])lift, load);
  return PETSC_TRUE;
}

/* rho g - grad p, or with phases rho (weight - R^-1 grad p), N/m3 */
static void WeightAndPressure(const MomentumStep *step, int e, const double grad[2], double q[2])
{
  if (!step->inverse_density) {
    for (int c = 0; c < 2; c++) q[c] = step->rho[e] * step->gravity[c] - grad[c];
    return;
  }
  InverseDensityAcceleration(&step->inverse_density[e], grad, q);
  for (int c = 0; c < 2; c++) q[c] *= step->rho[e];
}

/* Body force, pressure and absorption: M (rho g - grad p + source + rho k U). */
static void ElementLoad(MomentumSolver s, const MomentumStep *step, int e, const double p[], double load[6])
{
  const Mesh *m = s->domain->mesh;
  const ElementGeometry *g = s->domain->geometry + e;
  const AbsorptionAt absorption = step->absorption ? step->absorption[e] : (AbsorptionAt){0.0, {0.0, 0.0}};
  double grad[3][2], q[2][3];
  DomainGradient(s->domain, e, p, grad);
  for (int i = 0; i < 3; i++) {
    double now[2] = {0}, next[2] = {0}, force[2];
    WeightAndPressure(step, e, grad[i], force);
    if (s->setup.source) {
      s->setup.source(s->setup.source_context, step->t, ElementVertex(m, e, i), now);
      s->setup.source(s->setup.source_context, step->t + step->dt, ElementVertex(m, e, i), next);
    }
    for (int c = 0; c < 2; c++)
      q[c][i] = force[c] + step->rho[e] * absorption.push[c] + s->theta * next[c] + (1.0 - s->theta) * now[c];
  }
  for (int c = 0; c < 2; c++) {
    double mq[3];
    P1MassApply(g->area, q[c], mq);
    for (int i = 0; i < 3; i++) load[3 * c + i] += mq[i];
  }
}

/* rho M/dt u^n (1 + w), w = (1 - theta)/theta: what is left of -(1 - theta) L u^n = -w (A - rho M/dt - a) u^n
 * once A u^n has been subtracted; the coupling's part is in AssembleEntry. */
static void ElementInertia(MomentumSolver s, const MomentumStep *step, int e, const double u[6],
                           double load[6])
{
  for (int c = 0; c < 2; c++) {
    double mu[3];
    P1MassApply(s->domain->geometry[e].area, u + 3 * c, mu);
    for (int i = 0; i < 3; i++) load[3 * c + i] += step->rho[e] / (step->dt * s->theta) * mu[i];
  }
}

/* a and the implicit inertia I to the dense block, w (a + I) u^n and what does not depend on u* (SolidCouplingLoad) to the load. */
static void AssembleEntry(MomentumSolver s, const MomentumStep *step, const CoracleCoupling *k,
                          const double u[6], double dense[36], double load[6])
{
  const double w = (1.0 - s->theta) / s->theta;
  const int e = k->element;
  double matrix[6][6];
  SolidCouplingMatrix(k, matrix);
  SolidCouplingLoad(step->solid, e, u, s->domain->geometry[e].area, step->rho[e] / step->dt, load);
  for (int row = 0; row < 6; row++)
    for (int col = 0; col < 6; col++) {
      dense[6 * col + row] = matrix[row][col];
      load[row] += w * matrix[row][col] * u[col];
    }
}

PetscErrorCode MomentumAssembleSolid(MomentumSolver s, const MomentumStep *step)
{
  int n;
  const CoracleCoupling *entry = SolidCouplingEntries(step->solid, &n);
  const PetscScalar *u;
  PetscScalar *load;
  PetscFunctionBeginUser;
  PetscCall(VecGetArrayRead(step->u, &u));
  PetscCall(VecGetArray(s->load, &load));
  for (int k = 0; k < n; k++) {
    const int e = entry[k].element;
    double dense[36];
    AssembleEntry(s, step, entry + k, u + 6 * e, dense, load + 6 * e);
    PetscCall(MomentumOperatorAddDense(&s->op, e, dense));
  }
  PetscCall(VecRestoreArray(s->load, &load));
  PetscCall(VecRestoreArrayRead(step->u, &u));
  PetscFunctionReturn(0);
}

/* Scalar blocks of element e, but for boundary faces. */
static void AssembleScalar(MomentumSolver s, const MomentumStep *step, int e, const double flux[])
{
  double(*block)[9] = s->op.block[e], *volume = s->op.volume[e];
  if (s->faces)
    memcpy(block, s->faces[e], sizeof s->faces[e]);
  else
    AssembleFaces(s, step, e, block);
  const double rate = step->absorption ? step->absorption[e].rate : 0.0;
  const double mass = step->rho[e] * (1.0 / step->dt + s->theta * rate);
  ScalarVolume(s->domain->geometry + e, mass, s->theta, s->op.theta_mu[e], flux + 6 * e, volume);
  for (int k = 0; k < 9; k++) block[0][k] += volume[k];
  FluxDivergenceVolume(s->domain->geometry + e, flux + 6 * e, s->divergence[e]);
  for (int i = 0; i < 3; i++) AssembleInflow(s, step->mu, e, i, flux, block);
}

/* The faces' blocks are kept while theta stays and the viscosity is that of the beginning. */
static PetscErrorCode KeepFaces(MomentumSolver s, const MomentumStep *step)
{
  const int ne = s->domain->mesh->ne;
  PetscFunctionBeginUser;
  if (step->revision > 0 || step->theta != s->theta) PetscCall(PetscFree(s->faces));
  s->theta = step->theta;
  if (step->revision > 0 || s->faces) PetscFunctionReturn(0);
  PetscCall(PetscCalloc1(ne, &s->faces));
  for (int e = 0; e < ne; e++) AssembleFaces(s, step, e, s->faces[e]);
  PetscFunctionReturn(0);
}

/* Blocks and load of element e. */
static PetscErrorCode AssembleElement(MomentumSolver s, const MomentumStep *step, int e, const double flux[],
                                      const double u[6], const double p[], double load[6])
{
  const FluidDomain *d = s->domain;
  const double diffusion = s->op.theta_mu[e] * step->dt / (step->rho[e] * d->geometry[e].area);
  double dense[36] = {0};
  PetscBool has_dense = PETSC_FALSE;
  PetscFunctionBeginUser;
  memset(load, 0, 6 * sizeof *load);
  if (diffusion > s->op.diffusion) s->op.diffusion = diffusion;
  AssembleScalar(s, step, e, flux);
  for (int i = 0; i < 3; i++)
    if (d->mesh->neighbor[3 * e + i] < 0 && AssembleBoundary(s, step, e, i, flux + 6 * e, dense, load))
      has_dense = PETSC_TRUE;
  for (int j = 0; j < 3; j++)
    for (int c = 0; c < 2; c++) s->advected[c] += s->divergence[e][j] * u[3 * c + j];
  ElementLoad(s, step, e, p, load);
  ElementInertia(s, step, e, u, load);
  if (has_dense) PetscCall(MomentumOperatorAddDense(&s->op, e, dense));
  PetscFunctionReturn(0);
}

PetscErrorCode MomentumSolverAssemble(MomentumSolver s, const MomentumStep *step)
{
  const Mesh *m = s->domain->mesh;
  const PetscScalar *flux, *u, *p;
  PetscScalar *load;
  PetscFunctionBeginUser;
  PetscCall(KeepFaces(s, step));
  MomentumOperatorClearDense(&s->op);
  s->op.diffusion = 0.0;
  s->advected[0] = s->advected[1] = 0.0;
  for (int e = 0; e < m->ne + m->ng; e++) s->op.theta_mu[e] = s->theta * step->mu[e];
  PetscCall(GhostedGetArrayRead(step->mass_flux, &flux));
  PetscCall(GhostedGetArrayRead(step->p, &p));
  PetscCall(VecGetArrayRead(step->u, &u));
  PetscCall(VecGetArray(s->load, &load));
  for (int e = 0; e < m->ne; e++) PetscCall(AssembleElement(s, step, e, flux, u + 6 * e, p, load + 6 * e));
  PetscCall(VecRestoreArray(s->load, &load));
  PetscCall(VecRestoreArrayRead(step->u, &u));
  PetscCall(GhostedRestoreArrayRead(step->p, &p));
  PetscCall(GhostedRestoreArrayRead(step->mass_flux, &flux));
  PetscFunctionReturn(0);
}

Vec MomentumSolverLoad(MomentumSolver s)
{
  return s->load;
}
