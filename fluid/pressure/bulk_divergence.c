#include "fluid/pressure/bulk_divergence.h"
#include "fluid/discretization/ghosted.h"

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

PetscErrorCode BulkDivergence(const FluidDomain *domain, const ProjectionStep *step, Vec velocity,
                              Vec divergence)
{
  const Mesh *m = domain->mesh;
  const PetscScalar *u;
  PetscScalar *d;
  PetscFunctionBeginUser;
  PetscCall(GhostedGetArrayZero(divergence, &d));
  PetscCall(VecGetArrayRead(velocity, &u));
  for (int e = 0; e < m->ne; e++) {
    double mv[2][3], r[6] = {0};
    BulkMomentum(domain->geometry[e].area, SolidCouplingAt(step->solid, e), u + 6 * e, mv);
    P2GradientTranspose(domain->geometry[e].g, (const double(*)[3])mv, r);
    BoundaryFlux(domain, e, step->t, r);
    for (int k = 0; k < 6; k++) d[domain->p2->node[6 * e + k]] += r[k];
  }
  PetscCall(VecRestoreArrayRead(velocity, &u));
  if (step->compressible && step->pressure)
    PetscCall(CompressibilityAddLoads(domain, step->compressible, step->dt, step->pressure, d));
  PetscCall(GhostedRestoreArray(divergence, &d));
  PetscCall(GhostedSum(divergence));
  PetscFunctionReturn(0);
}
