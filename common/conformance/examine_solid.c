#include "common/conformance/examine.h"
#include "common/conformance/motion.h"
#include <math.h>
#include <stdlib.h>

typedef struct {
  Kit *kit;
  Motion now, start, attempt, other; /* of the step: its start, its first and second attempt */
} Solid;

/* --- the exchanges -------------------------------------------------------------------------------------- */

static void AskElements(Kit *k)
{
  const double box[] = {-1e9, -1e9, 1e9, 1e9};
  ServerElements e;
  ServerAskElements(k->server, 1, box, &e);
}

static void Receive(Solid *s, int step)
{
  ServerSolid solid;
  ServerReceiveSolid(s->kit->server, &solid);
  KitRefuseRejection(s->kit, step);
  MotionTake(&s->now, &solid);
  s->kit->changed += solid.changed;
}

/* Force F, with G when `more`, on the nodes of the step's start. */
static void SendForce(const Solid *s, CoracleAction action, bool more)
{
  const Kit *k = s->kit;
  const double phase = KitPhase(k), pressure = k->density * k->gravity;
  const double density[2] = {pressure * (cos(phase) + 0.5 * more), pressure * (sin(phase) - 0.25 * more)};
  double *force = malloc(2 * sizeof *force * (size_t)s->start.n + 1);
  for (int i = 0; i < 2 * s->start.n; i++) force[i] = s->start.area[i / 2] * density[i % 2];
  ServerSendForce(k->server, k->t, k->dt, action, force);
  free(force);
}

static void SendCoupling(Kit *k, CoracleAction action)
{
  ServerSendStep(k->server, k->t, action == CORACLE_STOP ? 0.0 : k->dt, action, 0, NULL);
  if (action != CORACLE_STOP) ServerSendCoupling(k->server, 0, NULL);
}

/* --- what is checked ------------------------------------------------------------------------------------ */

static void CheckRepeats(const Solid *s, int step)
{
  char what[128];
  if (MotionDiffers(&s->attempt, &s->now, what, sizeof what))
    ServerFail(s->kit->server,
               "conformance: step %d, redone with the force of its first attempt, has another %s: bind all "
               "state that a step changes "
               "(CoracleBindState) and let nothing else depend on the attempts before",
               step, what);
}

static void CheckDirection(const Solid *s, int step)
{
  const double G[2] = {0.5, -0.25};
  double work = 0.0, path = 0.0;
  if (s->attempt.n == s->other.n && s->attempt.n == s->start.n)
    for (int i = 0; i < 2 * s->start.n; i++) {
      const double moved = s->other.x[i] - s->attempt.x[i];
      work += s->start.area[i / 2] * G[i % 2] * moved;
      path += s->start.area[i / 2] * fabs(moved);
    }
  MPI_Allreduce(MPI_IN_PLACE, &work, 1, MPI_DOUBLE, MPI_SUM, s->kit->comm);
  MPI_Allreduce(MPI_IN_PLACE, &path, 1, MPI_DOUBLE, MPI_SUM, s->kit->comm);
  if (work < -1e-6 * path)
    ServerFail(s->kit->server,
               "conformance: in step %d an additional force moves the solid against its direction: sign of "
               "the force?",
               step);
}

/* --- the run -------------------------------------------------------------------------------------------- */

static void Attempt(Solid *s, int step, int attempt)
{
  Kit *k = s->kit;
  const bool last = attempt == (KitRepeats(step) ? 2 : 0);
  CoracleFlow flow;
  ServerReceiveFlow(k->server, &flow);
  SendForce(s, attempt ? CORACLE_REDO : CORACLE_RUN, attempt == 1);
  Receive(s, step);
  if (attempt == 0) MotionCopy(&s->attempt, &s->now);
  if (attempt == 1) MotionCopy(&s->other, &s->now);
  if (attempt == 2) CheckRepeats(s, step);
  if (attempt == 2) CheckDirection(s, step);
  if (last) {
    k->t += k->dt;
    k->dt = KitStepSize(k, step + 1);
    KitCheckpoint(k, step);
  }
  if (ServerElementsChanged(k->server) && last) AskElements(k);
  SendCoupling(k, !last ? CORACLE_REDO : step < k->steps ? CORACLE_RUN : CORACLE_STOP);
}

static void Row(const Solid *s, int step)
{
  double sum[MOTION_SUMS];
  MotionSum(&s->now, sum);
  MPI_Allreduce(MPI_IN_PLACE, sum, MOTION_SUMS, MPI_DOUBLE, MPI_SUM, s->kit->comm);
  for (int i = 1; i < MOTION_SUMS; i++) sum[i] /= sum[0];
  KitRow(s->kit, step, MOTION_SUMS, sum);
}

void ExamineSolid(Kit *k)
{
  Solid s = {.kit = k};
  KitOpenRows(k, "area [m2],x [m],y [m],x2 [m2],y2 [m2],u_x [m/s],u_y [m/s],given_x [m/s],given_y [m/s]");
  Receive(&s, k->first - 1);
  k->changed = 0;
  AskElements(k);
  Row(&s, k->first - 1);
  k->dt = KitStepSize(k, k->first);
  SendCoupling(k, k->steps >= k->first ? CORACLE_RUN : CORACLE_STOP);
  for (int step = k->first; step <= k->steps; step++) {
    MotionCopy(&s.start, &s.now);
    for (int attempt = 0; attempt < (KitRepeats(step) ? 3 : 1); attempt++) Attempt(&s, step, attempt);
    Row(&s, step);
  }
  ServerSendForce(k->server, k->t, 0.0, CORACLE_STOP, NULL);
  for (Motion *m[] = {&s.now, &s.start, &s.attempt, &s.other}, **p = m; p < m + 4; p++) MotionFree(*p);
}
