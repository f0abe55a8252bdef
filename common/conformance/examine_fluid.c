#include "common/conformance/attempts.h"
#include "common/conformance/examine.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOVE_STEP = 6 };               /* after which the box moves */
static const double TOLERANCE = 0.01; /* of what an attempt over tau gains */
/* The same, of cells whose gradient is the step's before and that are covered in part. */
static const double ROUGH = 0.1;

static void Refuse(const Fluid *f, int step, const char *what, const char *expected)
{
  ServerFail(f->kit->server, "conformance: step %d: %s: %s", step, what, expected);
}

/* --- what is checked ------------------------------------------------------------------------------------ */

static double Distance(const double a[2], const double b[2])
{
  return hypot(a[0] - b[0], a[1] - b[1]);
}

static void CheckRepeats(const Fluid *f, int step)
{
  const size_t bytes = 6 * (size_t)f->patch.n * sizeof(double);
  if (memcmp(f->flow[HELD].u_star, f->flow[AGAIN].u_star, bytes) ||
      memcmp(f->flow[HELD].u_projected, f->flow[AGAIN].u_projected, bytes))
    Refuse(f, step, "redone with the coupling of its first attempt, it has another flow",
           "bind all state that a step changes (CoracleBindState) and let nothing else depend on the "
           "attempts before");
}

static void CheckDirection(const Fluid *f, int step)
{
  double held[2], more[2], mass;
  PatchCoupled(f->kit, &f->patch, f->flow[HELD].u_star, held, &mass);
  PatchCoupled(f->kit, &f->patch, f->flow[MORE].u_star, more, &mass);
  if (!(0.5 * (more[0] - held[0]) - 0.25 * (more[1] - held[1]) > 0.0))
    Refuse(f, step, "a faster solid does not take the fluid along",
           "s is added to the momentum equation, a u taken off");
}

/* u_start has the correction of the step before, and the step begins with it. */
static void CheckStart(const Fluid *f, int step)
{
  double start[2], star[2], expected[2];
  const Patch *p = &f->patch;
  PatchMomentum(f->kit, p, f->flow[HELD].u_start, start);
  PatchMomentum(f->kit, p, f->flow[FREE].u_star, star);
  for (int c = 0; c < 2; c++) expected[c] = f->momentum[c] + f->corrected[c];
  const double scale = Distance(expected, f->momentum);
  if (f->known && Distance(start, expected) > TOLERANCE * scale)
    Refuse(f, step, "the correction of the step before has not been added to the velocity",
           "u += M^-1 r when CoracleStepAccepted, and that as u_start");
  if (f->known && Distance(star, start) > TOLERANCE * scale)
    Refuse(f, step, "over a step that is next to nothing u* is not u_start", "the step begins with u_start");
}

/* Over tau nothing but the coupling changes the momentum. */
static void CheckForcing(const Fluid *f, int step)
{
  double now[KINDS][2], held[2], start[2], expected[2], mass;
  const Patch *p = &f->patch;
  for (int kind = FREE; kind <= COVERED; kind++) PatchMomentum(f->kit, p, f->flow[kind].u_star, now[kind]);
  PatchCoupled(f->kit, p, f->flow[SOURCE].u_star, held, &mass);
  for (int c = 0; c < 2; c++) expected[c] = now[FREE][c] + mass * f->w[c];
  const double scale = Distance(expected, now[FREE]);
  if (Distance(now[SOURCE], expected) > TOLERANCE * scale)
    Refuse(f, step, "the fluid does not gain dt s",
           "s is a force on the element's vertices, N, the density not divided out");
  PatchCoupled(f->kit, p, f->flow[INERTIA].u_star, held, &mass);
  PatchCoupled(f->kit, p, f->flow[INERTIA].u_start, start, &mass);
  for (int c = 0; c < 2; c++) expected[c] = now[FREE][c] + 10.0 * mass * f->w[c] - 9.0 * (held[c] - start[c]);
  if (Distance(now[INERTIA], expected) > TOLERANCE * scale)
    Refuse(f, step, "the implicit inertia does not resist the change of the velocity",
           "rho M/dt (u* - u_start) + implicit_inertia (inertia_tensor u* - kept u_start) + a u* = ... + s");
  PatchCoupled(f->kit, p, f->flow[KEPT].u_star, held, &mass);
  PatchCoupled(f->kit, p, f->flow[KEPT].u_start, start, &mass);
  for (int c = 0; c < 2; c++)
    expected[c] = now[FREE][c] + 10.0 * mass * f->w[c] -
                  9.0 * (AttemptTensor[c][0] * held[0] + AttemptTensor[c][1] * held[1] -
                         AttemptKept[c][0] * start[0] - AttemptKept[c][1] * start[1]);
  if (Distance(now[KEPT], expected) > ROUGH * scale)
    Refuse(f, step,
           "the implicit inertia does not move by its tensor or begin with what is kept of the velocity",
           "rho M/dt (u* - u_start) + implicit_inertia (inertia_tensor u* - kept u_start) + a u* = ... + s");
  PatchCoupled(f->kit, p, f->flow[COVERED].u_star, held, &mass);
  for (int c = 0; c < 2; c++) expected[c] = now[FREE][c] + 10.0 * mass * f->w[c] - 9.0 * held[c] - start[c];
  if (Distance(now[COVERED], expected) > ROUGH * Distance(expected, now[FREE]))
    Refuse(f, step, "where it is covered the fluid does not start from the solid's velocity",
           "CORACLE_IS_COVERED: (rho M/dt + implicit_inertia inertia_tensor) u* + a u* = ... + s");
  PatchCoupled(f->kit, p, f->flow[COEFFICIENT].u_star, held, &mass);
  for (int c = 0; c < 2; c++) expected[c] = now[FREE][c] - 9.0 * held[c];
  if (Distance(now[COEFFICIENT], expected) > TOLERANCE * Distance(expected, now[FREE]))
    Refuse(f, step, "the fluid does not lose dt a u*", "a is implicit: (rho M/dt + a) u* = ... + s");
}

static void CheckProjection(const Fluid *f, int step)
{
  double all[KINDS], disc[KINDS];
  for (int kind = FREE; kind <= COVERED; kind++)
    PatchDifference(f->kit, &f->patch, f->flow[kind].u_projected, f->flow[kind].u_star, &all[kind],
                    &disc[kind]);
  const bool none = disc[SOURCE] < 1e-3 * hypot(f->w[0], f->w[1]);
  if (none && f->kit->rank == 0 && step == 2) printf("conformance: note: the fluid has no projection\n");
  if (none) return;
  if (all[BULK] < 0.2 * all[SOURCE])
    Refuse(f, step, "the pressure does not see the solid's motion",
           "what is projected is u* + M^-1 (us - ms u*), the bulk velocity");
  if (disc[INERTIA] > 0.3 * disc[SOURCE])
    Refuse(f, step, "the pressure moves the fluid inside a heavy solid as if it were fluid",
           "u projected = u* - dt W^-1 M grad phi, W = rho M/dt + implicit_inertia inertia_tensor");
}

/* --- the run -------------------------------------------------------------------------------------------- */

static void Receive(Fluid *f, int step, Kind kind)
{
  CoracleFlow flow;
  const size_t bytes = 6 * (size_t)f->patch.n * sizeof(double);
  Flow *to = &f->flow[kind];
  ServerReceiveFlow(f->kit->server, &flow);
  KitRefuseRejection(f->kit, step);
  to->u_start = realloc(to->u_start, bytes + 1);
  to->u_star = realloc(to->u_star, bytes + 1);
  to->u_projected = realloc(to->u_projected, bytes + 1);
  if (bytes) memcpy(to->u_start, flow.u_start, bytes);
  if (bytes) memcpy(to->u_star, flow.u_star, bytes);
  if (bytes) memcpy(to->u_projected, flow.u_projected, bytes);
}

static void MoveSolid(const Fluid *f, Kind kind)
{
  const Kit *k = f->kit;
  ServerSolid solid;
  const double dt = AttemptStep(f, kind);
  ServerSendForce(k->server, k->t, dt, kind == HELD ? CORACLE_RUN : CORACLE_REDO, NULL);
  ServerReceiveSolid(k->server, &solid);
}

static void Row(Fluid *f, int step)
{
  double sum[5], projected[2];
  PatchCoupled(f->kit, &f->patch, f->flow[HELD].u_star, sum + 1, sum);
  PatchCoupled(f->kit, &f->patch, f->flow[HELD].u_projected, projected, sum);
  for (int c = 0; c < 2; c++) {
    sum[1 + c] /= sum[0];
    sum[3 + c] = projected[c] / sum[0];
  }
  KitRow(f->kit, step, 5, sum);
}

static void Accept(Fluid *f, int step)
{
  Kit *k = f->kit;
  const int n = f->patch.ncoupled;
  AttemptCorrection(f);
  k->t += k->dt;
  Row(f, step);
  KitCheckpoint(k, step);
  const bool changed = ServerElementsChanged(k->server);
  f->known = !changed && step != MOVE_STEP;
  k->changed += changed;
  if (!f->known) PatchAsk(k, step >= MOVE_STEP, &f->patch);
  k->dt = KitStepSize(k, step + 1);
  AttemptSend(f, HELD, step < k->steps ? CORACLE_RUN : CORACLE_STOP, n);
}

static void Step(Fluid *f, int step)
{
  for (int kind = HELD; kind < KINDS; kind++) {
    Receive(f, step, (Kind)kind);
    MoveSolid(f, (Kind)kind);
    if (!KitRepeats(step) || kind == AGAIN) break;
    AttemptSend(f, (Kind)(kind + 1), CORACLE_REDO, 0);
  }
  if (KitRepeats(step)) {
    CheckRepeats(f, step);
    CheckDirection(f, step);
    CheckStart(f, step);
    CheckForcing(f, step);
    CheckProjection(f, step);
  }
  Accept(f, step);
}

void ExamineFluid(Kit *k)
{
  Fluid f = {.kit = k};
  ServerSolid solid;
  KitOpenRows(k, "mass [kg],star_x [m/s],star_y [m/s],projected_x [m/s],projected_y [m/s]");
  ServerReceiveSolid(k->server, &solid);
  PatchAsk(k, k->first > MOVE_STEP, &f.patch);
  f.w[0] = f.patch.radius / (12.0 * k->dt_max);
  f.w[1] = -0.5 * f.w[0];
  k->dt = KitStepSize(k, k->first);
  AttemptSend(&f, HELD, k->steps >= k->first ? CORACLE_RUN : CORACLE_STOP, 0);
  for (int step = k->first; step <= k->steps; step++) Step(&f, step);
  ServerSendForce(k->server, k->t, 0.0, CORACLE_STOP, NULL);
  PatchFree(&f.patch);
  free(f.coupling);
  free(f.correction);
  for (int kind = 0; kind < KINDS; kind++) {
    free(f.flow[kind].u_start);
    free(f.flow[kind].u_star);
    free(f.flow[kind].u_projected);
  }
}
