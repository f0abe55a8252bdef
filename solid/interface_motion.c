/* The solid's motion as the coupler receives it, and how nodes respond to the fluid's force.
 *
 * The explicit substeps follow every vibration; a step of the fluid resolves those with omega dt << 1 only.  What
 * is sent is therefore the response of one implicit step to the same forces,
 *
 *     S = (M + dt^2/4 K)^-1 M,    K the tangent stiffness of elements and joints where they are now,
 *
 * which keeps rigid motions, and slow deformation (omega dt << 1) too, and divides fast vibrations by
 * 1 + (omega dt/2)^2; it has no parameter and no switch.  With v the velocity, f the solid's own forces
 * (internal, joints, contact) and F the fluid's of the step just made,
 *
 *     velocity      w = S v
 *     acceleration  a = S ((f + F)/m + g) - F/m          by all forces but the fluid's
 *
 * so that a mode which the step does not resolve holds against F: a -> -F/m.  What holds or moves nodes is among the forces.
 *
 * A force that is constant over a step does not act where a vibration with omega dt of 3 or more is, but where it was
 * sampled, and can feed it: in a lumped model by up to 1.6 % a step without damping, at any ratio of added mass to mass.
 * So each step takes DAMPING of the velocity that it does not resolve,
 *
 *     v -= DAMPING (v - S v),
 *
 * which keeps momentum and rigid motions. In the model nothing grows from 0.05 on; a mode with omega dt = 0.1 is
 * damped by a ratio of 0.0006. */
#include "solid/solid_impl.h"

/* Of the conjugate gradients: the residual's norm, relative to that of the argument; and their number, after
 * which the result, then smoothed less, is taken as it is. */
#define TOLERANCE 1e-9
enum { MAX_ITERATIONS = 1000 };
#define DAMPING 0.05

/* f -= int sigma(d) grad N_i over element k as it is now, sigma = 2 mu e + lambda tr(e) I. */
static void AddElementStiffness(const Elements *e, int k, const double x[], const double d[], double f[])
{
  double g[2][2] = {{0}}, normal[3][2], twice = 0.0;
  for (int i = 0; i < 3; i++) {
    const double *p = x + 2 * e->node[(i + 1) % 3][k], *q = x + 2 * e->node[(i + 2) % 3][k];
    const double *di = d + 2 * e->node[i][k];
    normal[i][0] = p[1] - q[1];
    normal[i][1] = q[0] - p[0];
    twice += p[0] * q[1] - q[0] * p[1];
    for (int c = 0; c < 2; c++)
      for (int b = 0; b < 2; b++) g[c][b] += di[c] * normal[i][b];
  }
  const double mu = e->mu[k], lambda = e->lambda[k];
  const double bulk = e->plane_stress[k] > 0.0 ? 2.0 * lambda * mu / (lambda + 2.0 * mu) : lambda;
  const double shear = mu * (g[0][1] + g[1][0]), trace = bulk * (g[0][0] + g[1][1]);
  const double t[2][2] = {{2.0 * mu * g[0][0] + trace, shear}, {shear, 2.0 * mu * g[1][1] + trace}};
  for (int i = 0; i < 3; i++)
    for (int c = 0; c < 2; c++)
      f[2 * e->node[i][k] + c] -= (t[c][0] * normal[i][0] + t[c][1] * normal[i][1]) / (2.0 * twice);
}

static PetscBool IsHeld(Solid s, int k)
{
  double mobility = 0.0;
  for (int i = 0; i < 3; i++) mobility += s->inverse_mass[s->elements.node[i][k]];
  return mobility == 0.0 ? PETSC_TRUE : PETSC_FALSE;
}

/* ad = d + factor M^-1 K d; fixed nodes: d */
static PetscErrorCode Apply(Solid s, double factor, const double d[], double ad[])
{
  PetscFunctionBeginUser;
  PetscCall(PetscArrayzero(ad, 2 * (size_t)s->nnodes));
  for (int k = 0; k < s->elements.n; k++)
    if (!IsHeld(s, k)) AddElementStiffness(&s->elements, k, s->x, d, ad);
  JointsAddStiffness(s->joints, s, d, ad);
  PetscCall(CopiesSum(s->copies, 2, ad));
  for (int k = 0; k < 2 * s->nnodes; k++) ad[k] = d[k] - factor * s->inverse_mass[k / 2] * ad[k];
  PetscFunctionReturn(0);
}

/* sum m a.b over the nodes */
static PetscErrorCode Dot(Solid s, const double a[], const double b[], double *dot)
{
  PetscFunctionBeginUser;
  *dot = 0.0;
  for (int i = 0; i < s->nnodes; i++)
    if (SolidOwns(s, i)) *dot += s->mass[i] * (a[2 * i] * b[2 * i] + a[2 * i + 1] * b[2 * i + 1]);
  if (s->size > 1) PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, dot, 1, MPI_DOUBLE, MPI_SUM, s->comm));
  PetscFunctionReturn(0);
}

/* d -> S d, by conjugate gradients from d itself: exact at once where d is a rigid motion. */
static PetscErrorCode Respond(Solid s, double d[])
{
  const double factor = 0.25 * s->dt * s->dt;
  const size_t n = 2 * (size_t)s->nnodes;
  double *r, *p, *ap, rr, pap, size, next;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc3(n, &r, n, &p, n, &ap));
  PetscCall(Apply(s, factor, d, ap));
  for (size_t k = 0; k < n; k++) p[k] = r[k] = d[k] - ap[k];
  PetscCall(Dot(s, r, r, &rr));
  PetscCall(Dot(s, d, d, &size));
  for (int i = 0; i < MAX_ITERATIONS && rr > TOLERANCE * TOLERANCE * size; i++) {
    PetscCall(Apply(s, factor, p, ap));
    PetscCall(Dot(s, p, ap, &pap));
    for (size_t k = 0; k < n; k++) {
      d[k] += rr / pap * p[k];
      r[k] -= rr / pap * ap[k];
    }
    PetscCall(Dot(s, r, r, &next));
    for (size_t k = 0; k < n; k++) p[k] = r[k] + next / rr * p[k];
    rr = next;
  }
  PetscCall(PetscFree3(r, p, ap));
  PetscFunctionReturn(0);
}

/* v -= DAMPING (v - S v) of free nodes, S v in interface_velocity. */
static void DampUnresolved(Solid s)
{
  for (int n = 0; n < s->nnodes; n++)
    for (int c = 0; c < 2 && s->inverse_mass[n] > 0.0 && !s->is_prescribed[n]; c++) {
      const double dv = DAMPING * (s->interface_velocity[2 * n + c] - s->v[2 * n + c]);
      BudgetAddImpulse(s, n, c, s->mass[n] * dv, s->v[2 * n + c] + 0.5 * dv);
      s->v[2 * n + c] += dv;
    }
}

/* What moves prescribed nodes acts beside the fluid: their whole acceleration is that of the prescribed velocity. */
static void AcceleratePrescribed(Solid s)
{
  const double t = s->stats.t, dt = s->dt;
  for (int k = 0; k < s->nprescribed && dt > 0.0; k++) {
    const PrescribedMotion *d = &s->motion[s->prescribed[k].motion];
    if (d->release > 0.0 && t >= d->release * (1.0 - 1e-12)) continue;
    for (int c = 0; c < 2; c++)
      if (d->prescribed[c])
        s->acceleration[2 * s->prescribed[k].node + c] =
            (PrescribedVelocity(d, c, t, dt) - PrescribedVelocity(d, c, t - dt, dt)) / dt;
  }
}

PetscErrorCode SolidUpdateInterfaceMotion(Solid s, InterfaceMotion *interface)
{
  const double *force;
  PetscFunctionBeginUser;
  PetscCall(SolidForces(s, &force));
  PetscCall(PetscArraycpy(s->interface_velocity, s->v, 2 * (size_t)s->nnodes));
  for (int k = 0; k < 2 * s->nnodes; k++) {
    const double by_mass = s->inverse_mass[k / 2];
    s->mobility[k / 2] = by_mass;
    s->acceleration[k] = by_mass > 0.0 ? by_mass * (force[k] + s->load[k]) + s->setup.gravity[k % 2] -
                                             s->setup.decay_rate * s->v[k]
                                       : 0.0;
  }
  PetscCall(Respond(s, s->interface_velocity));
  DampUnresolved(s);
  AcceleratePrescribed(s);
  PetscCall(Respond(s, s->acceleration));
  for (int k = 0; k < 2 * s->nnodes; k++) s->acceleration[k] -= s->load[k] / s->mass[k / 2];
  SolidGetInterfaceMotion(s, interface);
  PetscFunctionReturn(0);
}

void SolidGetInterfaceMotion(Solid s, InterfaceMotion *interface)
{
  *interface = (InterfaceMotion){s->interface_velocity, s->mobility, s->acceleration};
}
