#include "solid/springs.h"
#include "solid/solid_impl.h"

PetscErrorCode SpringsFind(Solid s)
{
  PetscFunctionBeginUser;
  for (int k = 0; k < s->setup.nsprings; k++) {
    s->spring_element[k] = -1;
    for (int e = 0; e < s->elements.n; e++)
      if (s->elements.number[e] == s->setup.spring[k].element) s->spring_element[k] = e;
  }
  PetscFunctionReturn(0);
}

/* The nodes of spring k's element; NULL: another rank has it. */
static const int *NodesOf(const Solid s, int k)
{
  return s->spring_element[k] < 0 ? NULL : s->element + 3 * s->spring_element[k];
}

/* value[nnodes][2] at the point of spring k */
static void AtPoint(const Solid s, int k, const double value[], double at[2])
{
  const int *node = NodesOf(s, k);
  for (int c = 0; c < 2; c++) {
    at[c] = 0.0;
    for (int i = 0; i < 3; i++) at[c] += s->setup.spring[k].weight[i] * value[2 * node[i] + c];
  }
}

static SpringState Act(const Solid s, int k, double force[2])
{
  double x[2], v[2];
  AtPoint(s, k, s->x, x);
  AtPoint(s, k, s->v, v);
  return SpringForce(&s->setup.spring[k], x, v, force);
}

void SpringsAddForces(Solid s)
{
  for (int k = 0; k < s->setup.nsprings; k++) {
    const int *node = NodesOf(s, k);
    if (!node) continue;
    (void)Act(s, k, s->spring_force[k]);
    for (int i = 0; i < 3; i++)
      for (int c = 0; c < 2; c++)
        s->force[2 * node[i] + c] += s->setup.spring[k].weight[i] * s->spring_force[k][c];
  }
}

void SpringsAddBudget(Solid s)
{
  for (int k = 0; k < s->setup.nsprings; k++) {
    double v[2];
    const int *node = NodesOf(s, k);
    if (!node) continue;
    AtPoint(s, k, s->v, v);
    for (int c = 0; c < 2; c++) {
      s->reaction[s->node_body[node[0]]][c] += s->h * s->spring_force[k][c];
      s->budget.reaction_work += s->h * s->spring_force[k][c] * v[c];
    }
  }
}

PetscBool SpringsStiffness(Solid s, int k, int node[3], double stiffness[6][6])
{
  const double *w = s->setup.spring[k].weight;
  double x[2], v[2], at_point[4];
  if (!NodesOf(s, k)) return PETSC_FALSE;
  AtPoint(s, k, s->x, x);
  AtPoint(s, k, s->v, v);
  SpringStiffness(&s->setup.spring[k], x, v, at_point);
  for (int i = 0; i < 3; i++) node[i] = NodesOf(s, k)[i];
  for (int i = 0; i < 36; i++) {
    const int row = i / 6, column = i % 6;
    stiffness[row][column] = w[row / 2] * w[column / 2] * at_point[2 * (row % 2) + column % 2];
  }
  return PETSC_TRUE;
}

PetscErrorCode SpringsRate(Solid s, ElementRates *rates)
{
  double sum[2] = {0.0, 0.0};
  PetscFunctionBeginUser;
  for (int k = 0; k < s->setup.nsprings; k++) {
    const int *node = NodesOf(s, k);
    for (int i = 0; node && i < 3; i++) {
      const double w = s->setup.spring[k].weight[i];
      sum[0] += s->setup.spring[k].stiffness * w * w * s->inverse_mass[node[i]];
      sum[1] += s->setup.spring[k].damping * w * w * s->inverse_mass[node[i]];
    }
  }
  if (s->size > 1 && s->setup.nsprings)
    PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sum, 2, MPI_DOUBLE, MPI_SUM, s->comm));
  rates->stiffness += sum[0];
  rates->damping += sum[1];
  PetscFunctionReturn(0);
}

PetscErrorCode SolidSprings(Solid s, SpringState state[])
{
  double sum[MAX_SPRINGS][2] = {{0.0}};
  PetscFunctionBeginUser;
  for (int k = 0; k < s->setup.nsprings; k++) {
    double force[2];
    if (!NodesOf(s, k)) continue;
    const SpringState now = Act(s, k, force);
    sum[k][0] = now.length;
    sum[k][1] = now.tension;
  }
  if (s->size > 1)
    PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sum, 2 * s->setup.nsprings, MPI_DOUBLE, MPI_SUM, s->comm));
  for (int k = 0; k < s->setup.nsprings; k++) state[k] = (SpringState){sum[k][0], sum[k][1]};
  PetscFunctionReturn(0);
}
