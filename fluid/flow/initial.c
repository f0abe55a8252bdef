/* The initial state of the fluid. */
#include "fluid/discretization/ghosted.h"
#include "fluid/flow/fluid_impl.h"

/* x of P2 node k of element e */
static void P2NodePosition(const Mesh *m, int e, int k, double x[2])
{
  const double *a = ElementVertex(m, e, k < 3 ? k : (k + 1) % 3),
               *b = ElementVertex(m, e, k < 3 ? k : (k + 2) % 3);
  for (int c = 0; c < 2; c++) x[c] = 0.5 * (a[c] + b[c]);
}

/* rho g.(x - top), Pa */
static double HydrostaticPressure(const Mesh *m, double rho, const double g[2], const double x[2])
{
  double p = 0.0;
  for (int c = 0; c < 2; c++) p += rho * g[c] * (x[c] - (g[c] > 0.0 ? m->lower[c] : m->upper[c]));
  return p;
}

/* Of the layers outside of an open boundary at t, beyond that of the lightest phase, at x, Pa. */
static double LevelPressure(Fluid f, const Boundary *b, double t, const double x[2])
{
  const double *g = f->setup.gravity, *rho = f->setup.phases.rho;
  const BoundaryPhases *outside = &b->phases;
  double pressure = 0.0;
  for (int k = 0; k < outside->nlevels; k++) {
    const double above = k + 1 < outside->nlevels ? rho[outside->level_phase[k + 1]] : f->setup.rho;
    pressure += (rho[outside->level_phase[k]] - above) *
                fmax(hypot(g[0], g[1]) * BoundaryLevel(outside, k, t) + g[0] * x[0] + g[1] * x[1], 0.0);
  }
  return pressure;
}

PetscErrorCode FluidSetOpenPressure(Fluid f, double t)
{
  const Mesh *m = f->domain.mesh;
  const P2Space *p2 = f->domain.p2;
  Vec both[2]; /* sum and count: a node's owner need not have the boundary face */
  PetscScalar *v[2], *p;
  PetscFunctionBeginUser;
  for (int k = 0; k < 2; k++) {
    PetscCall(VecDuplicate(f->p, &both[k]));
    PetscCall(GhostedGetArrayZero(both[k], &v[k]));
  }
  for (int e = 0; e < m->ne; e++)
    for (int i = 0; i < 3; i++) {
      const Boundary *b = BoundaryOfFace(&f->domain, e, i);
      const int node[3] = {(i + 1) % 3, (i + 2) % 3, 3 + i};
      double value[3];
      if (!b || b->kind != BOUNDARY_OPEN) continue;
      for (int k = 0; k < 2; k++) {
        const double *x = ElementVertex(m, e, node[k]);
        value[k] = HydrostaticPressure(m, f->setup.rho, f->setup.gravity, x) +
                   BoundaryFactor(b, t) * b->pressure + LevelPressure(f, b, t, x);
      }
      value[2] = 0.5 * (value[0] + value[1]); /* linear also where the level is: effective_density.h */
      for (int k = 0; k < 3; k++) {
        v[0][p2->node[6 * e + node[k]]] += value[k];
        v[1][p2->node[6 * e + node[k]]] += 1.0;
      }
    }
  for (int k = 0; k < 2; k++) {
    PetscCall(GhostedRestoreArray(both[k], &v[k]));
    PetscCall(GhostedSum(both[k]));
    PetscCall(VecGetArray(both[k], &v[k]));
  }
  PetscCall(VecGetArray(f->p, &p));
  for (int k = 0; k < p2->nowned; k++)
    if (v[1][k] > 0.0) p[k] = v[0][k] / v[1][k];
  PetscCall(VecRestoreArray(f->p, &p));
  for (int k = 0; k < 2; k++) {
    PetscCall(VecRestoreArray(both[k], &v[k]));
    PetscCall(VecDestroy(&both[k]));
  }
  PetscCall(GhostedUpdate(f->p));
  PetscFunctionReturn(0);
}

PetscErrorCode FluidSetInitial(Fluid f, double t, FieldFunction velocity, FieldFunction pressure,
                               void *context)
{
  const Mesh *m = f->domain.mesh;
  const int *node = f->domain.p2->node;
  PetscScalar *u, *p;
  PetscFunctionBeginUser;
  f->t = t;
  f->dt_previous = 0.0;
  PetscCall(VecGetArray(f->u, &u));
  for (int e = 0; e < m->ne; e++)
    for (int i = 0; i < 3; i++) {
      double v[2] = {f->setup.velocity[0], f->setup.velocity[1]};
      if (velocity) velocity(context, t, ElementVertex(m, e, i), v);
      for (int c = 0; c < 2; c++) u[6 * e + 3 * c + i] = v[c];
    }
  PetscCall(VecRestoreArray(f->u, &u));
  PetscCall(VecCopy(f->u, f->u_previous));
  PetscCall(VecCopy(f->u, f->u_star));
  PetscCall(VecCopy(f->u, f->u_projected));
  if (f->phases) {
    PetscCall(VecCopy(f->u, f->bulk));
    PetscCall(VecCopy(f->u, f->bulk_previous));
    PetscCall(VecZeroEntries(f->dynamic));
  }
  PetscCall(GhostedGetArray(f->p, &p));
  for (int e = 0; e < m->ne; e++)
    for (int k = 0; k < 6; k++) {
      double x[2];
      P2NodePosition(m, e, k, x);
      p[node[6 * e + k]] = HydrostaticPressure(m, f->setup.rho, f->setup.gravity, x);
      if (pressure) pressure(context, t, x, p + node[6 * e + k]);
    }
  PetscCall(GhostedRestoreArray(f->p, &p));
  if (!pressure) PetscCall(FluidSetOpenPressure(f, t));
  if (!pressure && f->phases) PetscCall(FluidBalancePressure(f));
  PetscCall(FluidBudgetChanged(f));
  PetscCall(PetscArraycpy(f->budget.momentum, f->budget_start, 2));
  PetscFunctionReturn(0);
}

/* The solid's mean position in the elements of the coupling, [ne][2], m: by the integrals of N N^T over its part of them, of its inertia or its bulk
 * velocity. */
static void SolidCentres(Fluid f, double centre[][2])
{
  const Mesh *m = f->domain.mesh;
  int n;
  const CoracleCoupling *entry = SolidCouplingEntries(f->solid, &n);
  for (int k = 0; k < n; k++) {
    const CoracleCoupling *c = &entry[k];
    const double(*gram)[3] = c->flags & CORACLE_HAS_INERTIA ? c->implicit_inertia : c->ms;
    double x[3][2], weight[3], all = 0.0;
    MeshCorners(m, c->element, x);
    for (int i = 0; i < 3; i++) all += weight[i] = gram[i][0] + gram[i][1] + gram[i][2];
    for (int d = 0; d < 2; d++)
      centre[c->element][d] = all > 0.0
                                  ? (weight[0] * x[0][d] + weight[1] * x[1][d] + weight[2] * x[2][d]) / all
                                  : (x[0][d] + x[1][d] + x[2][d]) / 3.0;
  }
}

PetscErrorCode FluidStartInside(Fluid f)
{
  const CoracleCoupling *entry;
  PetscScalar *u;
  int n;
  PetscFunctionBeginUser;
  if (f->phases) {
    double(*centre)[2];
    PetscCall(PetscCalloc1(f->domain.mesh->ne, &centre));
    SolidCentres(f, centre);
    PetscCall(
        PhaseTransportStartSolid(f->phases, SolidCouplingFraction(f->solid), (const double(*)[2])centre));
    PetscCall(PetscFree(centre));
    PetscCall(FluidPhasesChanged(f));
  }
  entry = SolidCouplingEntries(f->solid, &n);
  PetscCall(VecGetArray(f->u, &u));
  for (int k = 0; k < n; k++)
    for (int i = 0; i < 6; i++) {
      PetscScalar *v = u + 6 * entry[k].element + i;
      *v += entry[k].alpha * (entry[k].velocity[i / 3] - *v);
    }
  PetscCall(VecRestoreArray(f->u, &u));
  PetscCall(GhostedUpdate(f->u));
  PetscCall(VecCopy(f->u, f->u_previous));
  SolidCouplingSetStarting(f->solid, PETSC_TRUE);
  PetscCall(FluidBudgetChanged(f));
  PetscFunctionReturn(0);
}
