/* Joints at work: which edges have reached their strength, and the tractions of active joints. */
#include "common/exchange/scatter.h"
#include "common/supermesh/vectorize.h"
#include "solid/cracks/joints_impl.h"

/* --- lists -------------------------------------------------------------------------------------------- */

static void InitiationAdd(InitiationList *w, const Joints j, int k)
{
  const Joint *joint = &j->joint[k];
  w->joint[w->n] = k;
  for (int i = 0; i < 2; i++) {
    w->place[i][w->n] = joint->place[i];
    w->node[i][w->n] = j->corner[joint->corner[i][0]].node;
    w->inverse_square[i][w->n] = 1.0 / (joint->law.strength[i] * joint->law.strength[i]);
  }
  w->friction[w->n++] = joint->law.friction;
}

void JointsList(Joints j)
{
  j->nactive = j->initiation.n = 0;
  for (int k = 0; k < j->n; k++) {
    if (j->joint[k].followed && j->memory[k].stage == JOINT_ACTIVE) j->active[j->nactive++] = k;
    if (j->joint[k].mine && j->memory[k].stage == JOINT_INTACT && !j->at_tip[k][0] && !j->at_tip[k][1])
      InitiationAdd(&j->initiation, j, k);
  }
}

/* --- what the edges carry ----------------------------------------------------------------------------- */

/* (sigma/F_t)^2 + (tau'/F_s)^2 >= 1, tau' = |tau| less the friction of a pressed edge, with the mean of both
 * elements' stresses; multiplied by the edge's length to the fourth, so that nothing is divided by. */
static inline int Overloaded(const InitiationList *w, int k, double *const stress[3], const double x[])
{
  const int p = w->place[0][k], q = w->place[1][k];
  const Point d = PointMinus(PointAt(x, w->node[1][k]), PointAt(x, w->node[0][k]));
  const double xx = 0.5 * (stress[0][p] + stress[0][q]), yy = 0.5 * (stress[1][p] + stress[1][q]);
  const double xy = 0.5 * (stress[2][p] + stress[2][q]);
  const Point t = {xx * d.y - xy * d.x, xy * d.y - yy * d.x};
  const double normal = t.x * d.y - t.y * d.x, shear = t.x * d.x + t.y * d.y, square = d.x * d.x + d.y * d.y;
  const double tension = Greater(normal, 0.0);
  const double beyond = Greater(fabs(shear) + w->friction[k] * Lesser(normal, 0.0), 0.0);
  return tension * tension * w->inverse_square[0][k] + beyond * beyond * w->inverse_square[1][k] >=
         square * square;
}

static WIDE int CountOverloaded(const InitiationList *initiation, double *const stress[3], const double x[])
{
  const InitiationList w = *initiation;
  int n = 0;
  VECTORIZE
  for (int k = 0; k < w.n; k++) n += Overloaded(&w, k, stress, x);
  return n;
}

static JointShape ShapeOf(const Joints j, Solid s, const Joint *joint)
{
  Point at[2][2];
  for (int i = 0; i < 2; i++)
    for (int end = 0; end < 2; end++) at[i][end] = PointAt(s->x, j->corner[joint->corner[end][i]].node);
  return JointShapeOf(at[0], at[1]);
}

static PetscBool Parted(const Joints j, const Joint *joint, int end)
{
  return (PetscBool)(j->corner[joint->corner[end][0]].node != j->corner[joint->corner[end][1]].node);
}

/* Ends whose nodes have parted start with the traction between their corner sets, per metre of edge at rest. */
void JointsBeginEnds(Joints j, Solid s)
{
  CrackTip *parted = j->tip; /* scratch: crack tips are found anew afterwards */
  int n = 0;
  for (int k = 0; k < j->nactive; k++)
    for (int end = 0; end < 2; end++)
      if (j->memory[j->active[k]].end[end].begun == 0.0 && Parted(j, &j->joint[j->active[k]], end))
        parted[n++] = JointsPartedCrackTip(j, j->active[k], end);
  for (int k = 0; k < n; k++) {
    const Joint *joint = &j->joint[parted[k].joint];
    const JointShape shape = ShapeOf(j, s, joint);
    const Point t = JointsCrackTipTraction(j, s, &parted[k]), m = shape.normal, e = shape.along;
    j->memory[parted[k].joint].end[parted[k].end] =
        JointBegin(&joint->law, t.x * m.x + t.y * m.y, t.x * e.x + t.y * e.y);
  }
}

/* A crack-tip node that bears the strength: JointLoad of the traction at least 1, times the edge's length squared, so
 * that no direction is normalised in every substep.  The edge is intact: one node at each end. */
static PetscBool Breaks(const Joints j, Solid s, const CrackTip *b)
{
  const Joint *joint = &j->joint[b->joint];
  const Point d = PointMinus(PointAt(s->x, j->corner[joint->corner[1][0]].node),
                             PointAt(s->x, j->corner[joint->corner[0][0]].node));
  const Point t = JointsCrackTipTraction(j, s, b);
  return (PetscBool)(JointLoad(&joint->law, t.x * d.y - t.y * d.x, t.x * d.x + t.y * d.y) >=
                     d.x * d.x + d.y * d.y);
}

/* --- forces ------------------------------------------------------------------------------------------- */

static void Add(double force[], int node, Point f)
{
  force[2 * node] += f.x;
  force[2 * node + 1] += f.y;
}

void JointsAddForces(Joints j, Solid s)
{
  for (int k = 0; k < j->nactive; k++) {
    const Joint *joint = &j->joint[j->active[k]];
    JointEnd *end = j->memory[j->active[k]].end;
    const JointShape shape = ShapeOf(j, s, joint);
    JointTraction t[2];
    Point one[2], two[2];
    JointTractions(&joint->law, end, &shape, t);
    if (!joint->mine) continue;
    JointForces(&shape, t, 0.5 * joint->length, one, two);
    for (int i = 0; i < 2; i++) {
      Add(s->force, j->corner[joint->corner[i][0]].node, one[i]);
      Add(s->force, j->corner[joint->corner[i][1]].node, two[i]);
    }
  }
}

int JointsActive(Joints j)
{
  return j ? j->nactive : 0;
}

/* The rates of the tractions on the ends when node i / 2 alone moves along axis i % 2, by the law for unit openings. */
static void StiffnessColumn(const Joint *joint, const JointEnd end[2], const JointShape *shape, int i,
                            double stiffness[8][8])
{
  const Point n = shape->normal, e = shape->along;
  const double side = i / 2 % 2 ? 1.0 : -1.0, half = 0.5 * joint->length;
  double opening[2] = {0.0, 0.0}, slip[2] = {0.0, 0.0}, normal[2] = {0.0, 0.0}, shear[2] = {0.0, 0.0};
  opening[i / 4] = side * (i % 2 ? n.y : n.x);
  slip[i / 4] = side * (i % 2 ? e.y : e.x);
  for (int k = 0; k < 2; k++)
    if (end[k].begun > 0.0) JointAddStiffness(&joint->law, end, shape, k, opening, slip, normal, shear);
  for (int row = 0; row < 8; row++) {
    const double on_second = row / 2 % 2 ? 1.0 : -1.0;
    stiffness[row][i] = on_second * half *
                        (row % 2 ? normal[row / 4] * n.y + shear[row / 4] * e.y
                                 : normal[row / 4] * n.x + shear[row / 4] * e.x);
  }
}

PetscBool JointsStiffness(Joints j, Solid s, int k, int node[4], double stiffness[8][8])
{
  const Joint *joint = &j->joint[j->active[k]];
  const JointShape shape = ShapeOf(j, s, joint);
  for (int i = 0; i < 4; i++) node[i] = j->corner[joint->corner[i / 2][i % 2]].node;
  for (int i = 0; i < 8; i++) StiffnessColumn(joint, j->memory[j->active[k]].end, &shape, i, stiffness);
  return joint->mine;
}

/* --- events ------------------------------------------------------------------------------------------- */

/* How many ends of this rank's joints have just become the last.  Not of those that it only follows: their
 * last bits may differ from the owner's, and the substeps are not to depend on them. */
static int FindLastEnds(const Joints j, Solid s)
{
  int found = 0;
  for (int k = 0; k < j->nactive; k++) {
    JointEnd *end = j->memory[j->active[k]].end;
    for (int i = 0; i < 2; i++) {
      if (end[1 - i].damage < 1.0 || end[i].damage >= 1.0) continue;
      if (end[i].begun == 0.0 || end[i].other_weight > 0.0) continue;
      const JointShape shape = ShapeOf(j, s, &j->joint[j->active[k]]);
      const double own[2] = {shape.opening[i], shape.slip[i]};
      const double theirs[2] = {shape.opening[1 - i], shape.slip[1 - i]};
      JointLast(&end[i], own, theirs);
      found += j->joint[j->active[k]].mine;
    }
  }
  return found;
}

static PetscBool Broken(const JointMemory *m)
{
  return (PetscBool)(m->end[0].damage >= 1.0 && m->end[1].damage >= 1.0);
}

/* This rank's, allocated: 2 number for a joint that activates, 2 number + 1 for one that breaks. */
static PetscErrorCode FindEvents(const Joints j, Solid s, int *n, int **event)
{
  const InitiationList *w = &j->initiation;
  double *const *stress = s->elements.stress;
  const int overloaded = CountOverloaded(w, stress, s->x);
  int broken = 0;
  PetscFunctionBeginUser;
  for (int k = 0; k < j->nactive; k++)
    broken += j->joint[j->active[k]].mine && Broken(&j->memory[j->active[k]]);
  *n = 0;
  PetscCall(PetscMalloc1((size_t)(overloaded + broken + j->ntips), event));
  for (int k = 0; overloaded && k < w->n; k++)
    if (Overloaded(w, k, stress, s->x) && *n < overloaded)
      (*event)[(*n)++] = 2 * j->joint[w->joint[k]].number;
  for (int k = 0; k < j->ntips; k++)
    if (Breaks(j, s, &j->tip[k])) (*event)[(*n)++] = 2 * j->joint[j->tip[k].joint].number;
  for (int k = 0; broken && k < j->nactive; k++)
    if (j->joint[j->active[k]].mine && Broken(&j->memory[j->active[k]]))
      (*event)[(*n)++] = 2 * j->joint[j->active[k]].number + 1;
  PetscFunctionReturn(0);
}

PetscErrorCode JointsAdvance(Joints j, Solid s, PetscBool *changed)
{
  enum { EVENTS, LAST_ENDS, NKINDS };
  int *event, n, total, any[NKINDS];
  void *all;
  PetscFunctionBeginUser;
  JointsFollowMotions(j, s);
  JointsGhostForces(j, s);
  any[LAST_ENDS] = FindLastEnds(j, s);
  PetscCall(FindEvents(j, s, &n, &event));
  any[EVENTS] = n;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, any, NKINDS, MPI_INT, MPI_MAX, s->comm));
  *changed = (PetscBool)(any[EVENTS] > 0 || any[LAST_ENDS] > 0);
  if (*changed && !any[EVENTS]) PetscCall(JointsMeasureRate(j, s));
  if (any[EVENTS]) {
    PetscCall(GatherRecords(s->comm, n, sizeof *event, event, &total, &all));
    PetscCall(PetscSortRemoveDupsInt(&total, all));
    PetscCall(JointsApply(j, s, total, all));
    PetscCall(PetscFree(all));
  }
  PetscCall(PetscFree(event));
  PetscFunctionReturn(0);
}

/* --- the limit ---------------------------------------------------------------------------------------- */

/* An end of stiffness k L/2 between two nodes, |u2 - u1|^2 <= 2 |u1|^2 + 2 |u2|^2, gives each of them k L;
 * along the edge twice that with friction.  A last end has its tension and its pressure at two places: twice that. */
PetscErrorCode JointsMeasureRate(Joints j, Solid s)
{
  double *sum;
  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(2 * (size_t)s->nnodes, &sum));
  for (int k = 0; k < j->nactive; k++) {
    const Joint *joint = &j->joint[j->active[k]];
    const JointEnd *ends = j->memory[j->active[k]].end;
    const double last = ends[0].other_weight > 0.0 || ends[1].other_weight > 0.0 ? 2.0 : 1.0;
    for (int end = 0; end < 2; end++)
      for (int i = 0; i < 2 && joint->mine && ends[end].begun > 0.0; i++)
        sum[2 * j->corner[joint->corner[end][i]].node] +=
            last * (joint->law.friction > 0.0 ? 2.0 : 1.0) * joint->law.stiffness * joint->length;
  }
  PetscCall(CopiesSum(s->copies, 2, sum));
  j->rate = 0.0;
  for (int n = 0; n < s->nnodes; n++) j->rate = fmax(j->rate, sum[2 * n] * s->inverse_mass[n]);
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &j->rate, 1, MPI_DOUBLE, MPI_MAX, s->comm));
  PetscCall(PetscFree(sum));
  PetscFunctionReturn(0);
}

double JointsRate(Joints j)
{
  return j->rate;
}
