#include "solid/rigid.h"

#define FEWEST_SUBSTEPS 10.0 /* of a step */
#define MOST_TURN 0.05       /* of a substep, rad */

/* Over a body's nodes, of forces or momenta q of them, first the sums and then what they make of the body as a whole; y = x less where the mass centre was
 * at the start, so that moments do not cancel where coordinates are large. */
typedef struct {
  double centre[2]; /* sum m y; the mass centre, m */
  double linear[2]; /* sum q; over the mass */
  double angular;   /* sum y x q; that about the centre over the moment of inertia */
} RigidSums;

PetscErrorCode RigidFind(Solid s)
{
  const size_t nbodies = (size_t)s->nbodies;
  PetscFunctionBeginUser;
  s->nrigid = s->nrigid_nodes = 0;
  PetscCall(PetscMalloc1(nbodies, &s->rigid_index));
  PetscCall(PetscCalloc1(nbodies, &s->rigid_turn));
  for (int b = 0; b < s->nbodies; b++) s->rigid_index[b] = s->body[b].rigid.mass > 0.0 ? s->nrigid++ : -1;
  for (int i = 0; i < s->nnodes; i++) s->nrigid_nodes += s->rigid_index[s->node_body[i]] >= 0;
  PetscCall(PetscMalloc1((size_t)s->nrigid_nodes, &s->rigid_node));
  for (int i = 0, k = 0; i < s->nnodes; i++)
    if (s->rigid_index[s->node_body[i]] >= 0) s->rigid_node[k++] = i;
  PetscFunctionReturn(0);
}

PetscErrorCode RigidFree(Solid s)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(s->rigid_index));
  PetscCall(PetscFree(s->rigid_turn));
  PetscCall(PetscFree(s->rigid_node));
  PetscFunctionReturn(0);
}

/* y and q of a node of mass m. */
static inline void Add(double m, Point y, Point q, RigidSums *k)
{
  k->centre[0] += m * y.x;
  k->centre[1] += m * y.y;
  k->linear[0] += q.x;
  k->linear[1] += q.y;
  k->angular += PointCross(y, q);
}

/* The place in rigid_node after those from k on that are of one body, which there are. */
static int SameBody(const Solid s, int k)
{
  const int body = s->node_body[s->rigid_node[k]];
  while (k < s->nrigid_nodes && s->node_body[s->rigid_node[k]] == body) k++;
  return k;
}

/* Of this rank's nodes: q is value[nnodes][2] or, with by_mass, a node's mass times it, and, unless that is NULL, `more`. */
static void AddVector(const Solid s, const double value[], const double more[], PetscBool by_mass,
                      RigidSums sum[])
{
  for (int k = 0; k < s->nrigid_nodes;) {
    const int body = s->node_body[s->rigid_node[k]], end = SameBody(s, k);
    const Point start = PointAt(s->body[body].centre, 0);
    RigidSums own = {{0.0, 0.0}, {0.0, 0.0}, 0.0}, *of = &sum[s->rigid_index[body]];
    for (; k < end; k++) {
      const int i = s->rigid_node[k];
      if (!SolidOwns(s, i)) continue;
      const double by = by_mass ? s->mass[i] : 1.0, *v = value + 2 * i, *w = more ? more + 2 * i : NULL;
      Add(s->mass[i], PointMinus(PointAt(s->x, i), start),
          (Point){by * v[0] + (w ? w[0] : 0.0), by * v[1] + (w ? w[1] : 0.0)}, &own);
    }
    for (int c = 0; c < 2; c++) {
      of->centre[c] += own.centre[c];
      of->linear[c] += own.linear[c];
    }
    of->angular += own.angular;
  }
}

/* Entry k of s->prescribed moves its node in one component alone now. */
static PetscBool Guides(const Solid s, int k)
{
  const PrescribedMotion *d = &s->motion[s->prescribed[k].motion];
  return (PetscBool)(!(d->prescribed[0] && d->prescribed[1]) && PrescribedActs(d, s->stats.t));
}

/* Bodies that move as prescribed in one component alone do not turn by themselves: known where they have nodes.  Where both are prescribed
 * nodes move so whatever forces make of them, and what moves them has the whole moment (BudgetAddPrescribed). */
static void HoldTurns(const Solid s, RigidSums sum[])
{
  for (int k = 0; k < s->nprescribed; k++) {
    const int b = s->rigid_index[s->node_body[s->prescribed[k].node]];
    if (b >= 0 && Guides(s, k)) sum[b].angular = 0.0;
  }
}

/* What that takes over a substep, N s: of the last of a body's motions, shared among its nodes, and so among ranks, by their mass. */
static void AddHeldMoments(const Solid s, const RigidSums momentum[])
{
  for (int k = s->nprescribed - 1, body = -1, holds = -1; k >= 0; k--) {
    const int n = s->prescribed[k].node, motion = s->prescribed[k].motion,
              b = s->rigid_index[s->node_body[n]];
    if (b < 0 || !Guides(s, k)) continue;
    if (s->node_body[n] != body) holds = motion;
    body = s->node_body[n];
    if (motion != holds || !SolidOwns(s, n)) continue;
    const RigidBody *rigid = &s->body[body].rigid;
    s->motion_impulse[motion][2] -=
        s->mass[n] / rigid->mass * rigid->inertia * (s->kick * s->rigid_turn[b] + momentum[b].angular);
  }
}

/* sum[vectors][nrigid] over all ranks. */
static PetscErrorCode SumOverRanks(Solid s, int vectors, RigidSums sum[])
{
  const int count = vectors * s->nrigid * (int)(sizeof *sum / sizeof(double));
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sum, count, MPI_DOUBLE, MPI_SUM, s->comm));
  PetscFunctionReturn(0);
}

/* What the sums of a vector make of the bodies. */
static void Complete(Solid s, RigidSums sum[])
{
  for (int b = 0; b < s->nbodies; b++) {
    if (s->rigid_index[b] < 0) continue;
    const RigidBody *body = &s->body[b].rigid;
    RigidSums *k = &sum[s->rigid_index[b]];
    for (int c = 0; c < 2; c++) k->centre[c] /= body->mass;
    k->angular = (k->angular - PointCross(PointAt(k->centre, 0), PointAt(k->linear, 0))) / body->inertia;
    for (int c = 0; c < 2; c++) {
      k->centre[c] += s->body[b].centre[c];
      k->linear[c] /= body->mass;
    }
  }
}

/* m (A + a x r) in a node, of forces that accelerate its body so. */
static Point RigidForce(const Solid s, int node, const RigidSums *k)
{
  const Point r = PointMinus(PointAt(s->x, node), PointAt(k->centre, 0));
  const double m = s->mass[node];
  return (Point){m * (k->linear[0] - k->angular * r.y), m * (k->linear[1] + k->angular * r.x)};
}

PetscErrorCode RigidDistribute(Solid s, double value[])
{
  RigidSums *sum;
  PetscFunctionBeginUser;
  if (s->nrigid == 0) PetscFunctionReturn(0);
  PetscCall(PetscCalloc1((size_t)s->nrigid, &sum));
  AddVector(s, value, NULL, PETSC_FALSE, sum);
  PetscCall(SumOverRanks(s, 1, sum));
  Complete(s, sum);
  HoldTurns(s, sum);
  for (int k = 0; k < s->nrigid_nodes; k++) {
    const int i = s->rigid_node[k];
    const Point f = RigidForce(s, i, &sum[s->rigid_index[s->node_body[i]]]);
    value[2 * i] = f.x;
    value[2 * i + 1] = f.y;
  }
  PetscCall(PetscFree(sum));
  PetscFunctionReturn(0);
}

PetscErrorCode RigidConstrain(Solid s)
{
  RigidSums *force, *momentum;
  PetscFunctionBeginUser;
  if (s->nrigid == 0) PetscFunctionReturn(0);
  PetscCall(PetscCalloc1(2 * (size_t)s->nrigid, &force));
  momentum = force + s->nrigid;
  AddVector(s, s->force, s->load, PETSC_FALSE, force);
  AddVector(s, s->v, NULL, PETSC_TRUE, momentum);
  PetscCall(SumOverRanks(s, 2, force));
  Complete(s, force);
  Complete(s, momentum);
  s->rigid_spin = 0.0;
  for (int k = 0; k < s->nrigid; k++) {
    s->rigid_spin = fmax(s->rigid_spin, fabs(momentum[k].angular));
    s->rigid_turn[k] = force[k].angular;
  }
  HoldTurns(s, force);
  HoldTurns(s, momentum);
  for (int k = 0; k < s->nrigid_nodes; k++) {
    const int i = s->rigid_node[k], b = s->rigid_index[s->node_body[i]];
    const Point f = RigidForce(s, i, &force[b]),
                r = PointMinus(PointAt(s->x, i), PointAt(force[b].centre, 0));
    const double inward = s->mass[i] * momentum[b].angular * momentum[b].angular;
    s->force[2 * i] = f.x - inward * r.x - s->load[2 * i];
    s->force[2 * i + 1] = f.y - inward * r.y - s->load[2 * i + 1];
  }
  PetscCall(PetscFree(force));
  PetscFunctionReturn(0);
}

PetscErrorCode RigidMove(Solid s)
{
  const double h = s->h;
  RigidSums *sum;
  double(*turn)[2]; /* [nrigid] sine and cosine - 1, over h */
  PetscFunctionBeginUser;
  if (s->nrigid == 0) PetscFunctionReturn(0);
  PetscCall(PetscCalloc2((size_t)s->nrigid, &sum, (size_t)s->nrigid, &turn));
  for (int k = 0; k < s->nrigid_nodes; k++) {
    const int i = s->rigid_node[k];
    for (int c = 0; c < 2; c++) s->x[2 * i + c] -= h * s->v[2 * i + c];
  }
  AddVector(s, s->v, NULL, PETSC_TRUE, sum);
  PetscCall(SumOverRanks(s, 1, sum));
  Complete(s, sum);
  AddHeldMoments(s, sum);
  HoldTurns(s, sum);
  for (int b = 0; b < s->nrigid; b++) {
    const double sine = Lesser(1.0, Greater(-1.0, h * sum[b].angular));
    turn[b][0] = sine / h;
    turn[b][1] = -sine * sine / (1.0 + sqrt(1.0 - sine * sine)) / h;
  }
  for (int k = 0; k < s->nrigid_nodes; k++) {
    const int i = s->rigid_node[k], b = s->rigid_index[s->node_body[i]];
    const Point r = PointMinus(PointAt(s->x, i), PointAt(sum[b].centre, 0));
    s->v[2 * i] = sum[b].linear[0] + turn[b][1] * r.x - turn[b][0] * r.y;
    s->v[2 * i + 1] = sum[b].linear[1] + turn[b][0] * r.x + turn[b][1] * r.y;
    for (int c = 0; c < 2; c++) s->x[2 * i + c] += h * s->v[2 * i + c];
  }
  PetscCall(PetscFree2(sum, turn));
  PetscFunctionReturn(0);
}

double RigidLongestSubstep(Solid s)
{
  if (s->nrigid == 0) return HUGE_VAL;
  return fmin(s->dt / FEWEST_SUBSTEPS, s->rigid_spin > 0.0 ? MOST_TURN / s->rigid_spin : HUGE_VAL);
}
