/* The solid's motion as the coupler receives it, and how nodes respond to the fluid's force.
 *
 * The explicit substeps follow every vibration; a step of the fluid resolves those with omega dt << 1 only.  What
 * is sent is therefore the response of one implicit step to the same forces,
 *
 *     S = (M + dt^2/4 K)^-1 M,    K the tangent stiffness of elements, joints and springs where they are now,
 *
 * which keeps rigid motions, and slow deformation (omega dt << 1) too, and divides fast vibrations by
 * 1 + (omega dt/2)^2; it has no parameter and no switch.  With v the velocity, f the solid's own forces
 * (internal, joints, contact) and F the fluid's of the step just made, v^n and f^n those at its start,
 *
 *     velocity      w = S v + 2 S^2 (1 - S) d,      d = v^n + dt ((f^n + F)/m + g) - v
 *     acceleration  a = S ((f + F)/m + g) - F/m          by all forces but the fluid's
 *
 * so that a mode which the step does not resolve holds against F: a -> -F/m.  What holds or moves nodes is among the forces:
 * a component that is fixed or prescribed keeps its own velocity and acceleration in S.
 * d is what the forces at the step's start make of the velocity, less what the substeps have made of it.  S^2 (1 - S) lets through what of it
 * has omega dt of 1 to 6, neither motions that the step resolves nor stiff ones: the phase in which the last substep has left a
 * vibration.  With w = S v solids much lighter than the fluid fed on that: a lumped mode of a tenth of the fluid's density grew by up to
 * 1.8 a step at omega dt of 3 to 4, with w nothing grows at a twentieth (a clamped plate of a tenth of the fluid's density failed, and took
 * twice the coupling iterations; tests/coupled/plate.sh).
 *
 * A force that is constant over a step does not act where a vibration with omega dt of 3 or more is, but where it was
 * sampled, and can feed it: in a lumped model by up to 1.6 % a step without damping, at any ratio of added mass to mass, the beam
 * of FSI1 (cases/flexible_beam, sixteen triangles through it, le 0.004 m, steps of 8.8 ms) by some 8 %, a vibration that
 * alternates from step to step.  So each step takes DAMPING of the velocity that it does not resolve,
 *
 *     v -= DAMPING (1 - S) (v + h/2 ((f + F)/m + g)),
 *
 * h the last substep: v is half of one behind the positions, and of v alone a part of the modes with omega h near a multiple of pi over the
 * number of substeps grows, by up to 5 % a step.  It keeps momentum and rigid motions.  With 0.05 that beam's vibration still grew by 4 % a step; with 0.15 and 0.3 nothing does, and the
 * tip is the same in three digits.  A mode with omega dt = 0.1 is damped by a ratio of DAMPING omega dt/8 = 0.0019. */
#include "solid/step_response.h"

#define DAMPING 0.15
/* Of responses; and of those that steady w, whose errors are 1e-3 of that in w. */
#define EXACT 1e-10
#define ROUGH 1e-5

/* resolved[nnodes][2]: S v; total[nnodes][2]: the acceleration by all forces, S of it in acceleration. */
static void DampUnresolved(Solid s, const double resolved[], const double total[])
{
  for (int k = 0; k < 2 * s->nnodes; k++) {
    if (StepResponseHolds(s, k)) continue;
    const double unresolved = s->v[k] - resolved[k] + 0.5 * s->stats.h * (total[k] - s->acceleration[k]);
    const double dv = -DAMPING * unresolved;
    BudgetAddImpulse(s, k / 2, k % 2, s->mass[k / 2] * dv, s->v[k] + 0.5 * dv);
    s->v[k] += dv;
  }
}

/* The rate of a prescribed rotation at the step's end: of the last substep. */
static double SpinNow(Solid s, const PrescribedMotion *d)
{
  return s->stats.h > 0.0 ? PrescribedRotation(d, s->stats.t - s->stats.h, s->stats.h) : 0.0;
}

/* interface_velocity of nodes that a rotation is prescribed for. */
static void RotatePrescribed(Solid s)
{
  const double t = s->stats.t, h = s->stats.h;
  double pivot[2] = {0.0, 0.0};
  for (int k = 0, motion = -1; k < s->nprescribed && h > 0.0; k++) {
    const PrescribedMotion *d = &s->motion[s->prescribed[k].motion];
    const int n = s->prescribed[k].node;
    if (!PrescribedActs(d, t) || !PrescribedTurns(d)) continue;
    if (motion != s->prescribed[k].motion) PrescribedPivot(d, t, pivot);
    motion = s->prescribed[k].motion;
    const double spin = SpinNow(s, d);
    const double turned[2] = {-spin * (s->x[2 * n + 1] - pivot[1]), spin * (s->x[2 * n] - pivot[0])};
    for (int c = 0; c < 2; c++)
      if (d->prescribed[c]) s->interface_velocity[2 * n + c] = PrescribedVelocity(d, c, t - h, h) + turned[c];
  }
}

/* What moves prescribed nodes acts beside the fluid: their whole acceleration is that of the prescribed velocity, and the fluid does not
 * move them.  The coupler has the solid where it is half a step later, at x + dt/2 v (coupler/step/coupler.c).  A rotation w about the pivot is a rigid
 * velocity there, at the rate w' that it has at the step's end, if
 *
 *     v  =  V + w x r,   a  =  V' + (w' - w)/dt x r - w w' r/2,     r from the pivot,
 *
 * v exactly, not its mean over the last substep: a velocity that is not free of divergence would add to the pressure in what is held in each step. */
static void AcceleratePrescribed(Solid s)
{
  const double t = s->stats.t, h = s->stats.h,
               dt = h > 0.0 ? s->dt : 0.0; /* velocities: means over a substep */
  double pivot[2] = {0.0, 0.0};
  for (int k = 0, motion = -1; k < s->nprescribed; k++) {
    const PrescribedMotion *d = &s->motion[s->prescribed[k].motion];
    if (!PrescribedActs(d, t)) continue;
    const int n = s->prescribed[k].node;
    double spin_up = 0.0, around = 0.0;
    if (d->prescribed[0] && d->prescribed[1]) s->mobility[n] = 0.0;
    if (PrescribedTurns(d) && dt > 0.0) {
      if (motion != s->prescribed[k].motion) PrescribedPivot(d, t, pivot);
      motion = s->prescribed[k].motion;
      const double spin = SpinNow(s, d);
      spin_up = (PrescribedRotation(d, t + dt - h, h) - spin) / dt;
      around = 0.5 * spin * (spin + dt * spin_up);
    }
    const double r[2] = {s->x[2 * n] - pivot[0], s->x[2 * n + 1] - pivot[1]};
    const double turned[2] = {-r[1] * spin_up - r[0] * around, r[0] * spin_up - r[1] * around};
    for (int c = 0; c < 2; c++)
      if (d->prescribed[c])
        s->acceleration[2 * n + c] =
            dt > 0.0 ? (PrescribedVelocity(d, c, t + dt - h, h) - PrescribedVelocity(d, c, t - h, h)) / dt +
                           turned[c]
                     : 0.0;
  }
}

/* interface_velocity, to which v has been extrapolated, becomes w; resolved[nnodes][2]: S v. */
static PetscErrorCode SteadyVelocity(Solid s, const double resolved[])
{
  const size_t n = 2 * (size_t)s->nnodes;
  double *d = s->interface_velocity, *slower;
  PetscFunctionBeginUser;
  for (int k = 0; k < 2 * s->nnodes; k++) d[k] = StepResponseHolds(s, k) ? 0.0 : d[k] - s->v[k];
  PetscCall(StepResponseApply(s, ROUGH, d));
  PetscCall(PetscMalloc1(n, &slower));
  PetscCall(PetscArraycpy(slower, d, n));
  PetscCall(StepResponseApply(s, ROUGH, slower));
  for (size_t k = 0; k < n; k++) d[k] = 2.0 * (d[k] - slower[k]);
  PetscCall(PetscFree(slower));
  PetscCall(StepResponseApply(s, ROUGH, d));
  for (size_t k = 0; k < n; k++) d[k] += resolved[k];
  PetscFunctionReturn(0);
}

PetscErrorCode SolidUpdateInterfaceMotion(Solid s, InterfaceMotion *interface)
{
  const size_t n = 2 * (size_t)s->nnodes;
  const double *force;
  double *resolved, *total, gravity[2] = {s->setup.gravity[0], s->setup.gravity[1]};
  PetscFunctionBeginUser;
  PetscCall(SolidForces(s, &force));
  GravityOver(&s->setup.gravity_table, s->stats.t, s->dt,
              gravity); /* of the coming step, as long as the last */
  const double start = MPI_Wtime();
  for (int k = 0; k < 2 * s->nnodes; k++) {
    const double by_mass = s->inverse_mass[k / 2];
    s->mobility[k / 2] = by_mass * BodyMassFactor(&s->body[s->node_body[k / 2]], PointAt(s->rest, k / 2));
    s->acceleration[k] =
        by_mass > 0.0 ? by_mass * (force[k] + s->load[k]) + gravity[k % 2] - s->setup.decay_rate * s->v[k]
                      : 0.0;
  }
  AcceleratePrescribed(s);
  PetscCall(PetscMalloc2(n, &resolved, n, &total));
  PetscCall(PetscArraycpy(resolved, s->v, n));
  PetscCall(PetscArraycpy(total, s->acceleration, n));
  PetscCall(StepResponseUpdate(s));
  PetscCall(StepResponseApply(s, EXACT, resolved));
  PetscCall(StepResponseApply(s, EXACT, s->acceleration));
  if (s->dt > 0.0)
    PetscCall(SteadyVelocity(s, resolved));
  else
    PetscCall(PetscArraycpy(s->interface_velocity, s->v, n));
  RotatePrescribed(s);
  DampUnresolved(s, resolved, total);
  PetscCall(PetscFree2(resolved, total));
  for (int k = 0; k < 2 * s->nnodes; k++) s->acceleration[k] -= s->load[k] * s->mobility[k / 2];
  s->stats.seconds[5] += MPI_Wtime() - start;
  SolidGetInterfaceMotion(s, interface);
  PetscFunctionReturn(0);
}

void SolidGetInterfaceMotion(Solid s, InterfaceMotion *interface)
{
  *interface = (InterfaceMotion){s->interface_velocity, s->mobility, s->acceleration};
}
