#include "solid/springs.h"
#include "solid/solid_impl.h"

PetscErrorCode SpringsFind(Solid s)
{
  PetscFunctionBeginUser;
  s->linked = PETSC_FALSE;
  for (int k = 0; k < s->setup.nsprings; k++) {
    const Spring *spring = &s->setup.spring[k];
    if (!spring->anchored) s->linked = PETSC_TRUE;
    for (int i = 0; i < 2; i++) {
      s->spring_element[k][i] = -1;
      for (int e = 0; (i == 0 || !spring->anchored) && e < s->elements.n; e++)
        if (s->elements.number[e] == spring->end[i].element) s->spring_element[k][i] = e;
    }
  }
  PetscFunctionReturn(0);
}

/* The nodes of the element at end i of spring k; NULL: another rank has it, or it is the anchor. */
static const int *NodesAt(const Solid s, int k, int i)
{
  return s->spring_element[k][i] < 0 ? NULL : s->element + 3 * s->spring_element[k][i];
}

/* value[nnodes][2] at that end, 0 where NodesAt is NULL */
static void AtEnd(const Solid s, int k, int i, const double value[], double at[2])
{
  const int *node = NodesAt(s, k, i);
  for (int c = 0; c < 2; c++) {
    at[c] = 0.0;
    for (int j = 0; node && j < 3; j++) at[c] += s->setup.spring[k].end[i].weight[j] * value[2 * node[j] + c];
  }
}

/* difference[nsprings][2]: value[nnodes][2] at the other end less that at the point; an anchor has 0.  Of all springs where `all`, else at least of those
 * with an end here.  Collective. */
static PetscErrorCode Difference(Solid s, PetscBool all, const double value[], double difference[][2])
{
  PetscFunctionBeginUser;
  for (int k = 0; k < s->setup.nsprings; k++) {
    double at[2][2];
    for (int i = 0; i < 2; i++) AtEnd(s, k, i, value, at[i]);
    for (int c = 0; c < 2; c++) difference[k][c] = at[1][c] - at[0][c];
  }
  if (all || s->linked)
    PetscCallMPI(
        MPI_Allreduce(MPI_IN_PLACE, difference, 2 * s->setup.nsprings, MPI_DOUBLE, MPI_SUM, s->comm));
  PetscFunctionReturn(0);
}

/* at[nsprings], likewise */
static PetscErrorCode Extents(Solid s, PetscBool all, SpringExtent at[])
{
  double d[MAX_SPRINGS][2], rate[MAX_SPRINGS][2];
  PetscFunctionBeginUser;
  PetscCall(Difference(s, all, s->x, d));
  PetscCall(Difference(s, all, s->v, rate));
  for (int k = 0; k < s->setup.nsprings; k++)
    for (int c = 0; c < 2; c++) {
      at[k].d[c] = d[k][c] + (s->setup.spring[k].anchored ? s->setup.spring[k].anchor[c] : 0.0);
      at[k].rate[c] = rate[k][c];
    }
  PetscFunctionReturn(0);
}

/* vector[nnodes][2] += force, on the point of spring k, and the opposite on its other end */
static void Act(const Solid s, int k, const double force[2], double vector[])
{
  for (int i = 0; i < 2; i++) {
    const int *node = NodesAt(s, k, i);
    for (int j = 0; node && j < 3; j++)
      for (int c = 0; c < 2; c++)
        vector[2 * node[j] + c] += (i ? -force[c] : force[c]) * s->setup.spring[k].end[i].weight[j];
  }
}

PetscErrorCode SpringsAddForces(Solid s)
{
  SpringExtent at[MAX_SPRINGS];
  PetscFunctionBeginUser;
  if (s->setup.nsprings == 0) PetscFunctionReturn(0);
  PetscCall(Extents(s, PETSC_FALSE, at));
  for (int k = 0; k < s->setup.nsprings; k++) {
    (void)SpringForce(&s->setup.spring[k], &at[k], s->spring_force[k]);
    Act(s, k, s->spring_force[k], s->force);
  }
  PetscFunctionReturn(0);
}

void SpringsAddBudget(Solid s)
{
  for (int k = 0; k < s->setup.nsprings; k++)
    for (int i = 0; i < 2; i++) {
      const int *node = NodesAt(s, k, i);
      double v[2];
      if (!node) continue;
      AtEnd(s, k, i, s->v, v);
      for (int c = 0; c < 2; c++) {
        const double impulse = s->kick * (i ? -s->spring_force[k][c] : s->spring_force[k][c]);
        s->reaction[s->node_body[node[0]]][c] += impulse;
        s->budget.reaction_work += impulse * v[c];
      }
    }
}

PetscErrorCode SpringsStiffness(Solid s, double stiffness[][4])
{
  SpringExtent at[MAX_SPRINGS];
  PetscFunctionBeginUser;
  if (s->setup.nsprings == 0) PetscFunctionReturn(0);
  PetscCall(Extents(s, PETSC_FALSE, at));
  for (int k = 0; k < s->setup.nsprings; k++) SpringStiffness(&s->setup.spring[k], &at[k], stiffness[k]);
  PetscFunctionReturn(0);
}

PetscErrorCode SpringsMultiply(Solid s, double stiffness[][4], const double d[], double kd[])
{
  double stretch[MAX_SPRINGS][2];
  PetscFunctionBeginUser;
  if (s->setup.nsprings == 0) PetscFunctionReturn(0);
  PetscCall(Difference(s, PETSC_FALSE, d, stretch));
  for (int k = 0; k < s->setup.nsprings; k++) {
    double force[2];
    for (int c = 0; c < 2; c++)
      force[c] = -(stiffness[k][2 * c] * stretch[k][0] + stiffness[k][2 * c + 1] * stretch[k][1]);
    Act(s, k, force, kd);
  }
  PetscFunctionReturn(0);
}

/* Of the point at an end: velocity per impulse there, at most. */
static double EndMobility(const Solid s, const SpringEnd *end, const int node[3])
{
  const Body *body = &s->body[s->node_body[node[0]]];
  double sum = 0.0, arm[2] = {-body->centre[0], -body->centre[1]};
  for (int i = 0; i < 3; i++) {
    const double w = end->weight[i];
    sum += w * w * s->inverse_mass[node[i]];
    for (int c = 0; c < 2; c++) arm[c] += w * s->rest[2 * node[i] + c];
  }
  if (body->rigid.mass == 0.0) return sum;
  return 1.0 / body->rigid.mass + (arm[0] * arm[0] + arm[1] * arm[1]) / body->rigid.inertia;
}

PetscErrorCode SpringsRate(Solid s, ElementRates *rates)
{
  double sum[2] = {0.0, 0.0};
  PetscFunctionBeginUser;
  for (int k = 0; k < 2 * s->setup.nsprings; k++) {
    const Spring *spring = &s->setup.spring[k / 2];
    const int *node = NodesAt(s, k / 2, k % 2);
    if (!node) continue;
    const double mobility = EndMobility(s, &spring->end[k % 2], node);
    sum[0] += spring->stiffness * mobility;
    sum[1] += spring->damping * mobility;
  }
  if (s->setup.nsprings) PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sum, 2, MPI_DOUBLE, MPI_SUM, s->comm));
  rates->stiffness += sum[0];
  rates->damping += sum[1];
  PetscFunctionReturn(0);
}

PetscErrorCode SolidSprings(Solid s, SpringState state[])
{
  SpringExtent at[MAX_SPRINGS];
  double force[2];
  PetscFunctionBeginUser;
  PetscCall(Extents(s, PETSC_TRUE, at));
  for (int k = 0; k < s->setup.nsprings; k++) state[k] = SpringForce(&s->setup.spring[k], &at[k], force);
  PetscFunctionReturn(0);
}
