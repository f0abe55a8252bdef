/* What walls, holds and the fluid do to all bodies together over a step: the other side of their momentum and
 * energy. */
#include "solid/solid_impl.h"

void BudgetStart(Solid s)
{
  s->budget = (SolidBudget){.work = 0.0};
  memset(s->reaction, 0, (size_t)s->nbodies * sizeof *s->reaction);
  memset(s->momentum, 0, (size_t)s->nbodies * sizeof *s->momentum);
  for (int k = 0; k < s->nmotions; k++) memset(s->motion_impulse[k], 0, sizeof s->motion_impulse[k]);
  memset(s->contact_impulse, 0, sizeof s->contact_impulse);
  for (int n = 0; n < s->nnodes; n++)
    for (int c = 0; c < 2 && SolidOwns(s, n); c++)
      s->momentum[s->node_body[n]][c] += s->mass[n] * s->v[2 * n + c];
}

/* What holds a fixed node takes all that would accelerate it. */
void BudgetAddSubstep(Solid s)
{
  const Point walls = ContactWalls(s->contact);
  s->budget.walls[0] += s->kick * walls.x;
  s->budget.walls[1] += s->kick * walls.y;
  s->budget.contact_loss += s->kick * ContactLoss(s->contact);
  ContactAddImpulses(s->contact, s, s->contact_impulse);
  for (int k = 0; k < s->nfixed; k++) {
    const int n = s->fixed[k];
    if (!SolidOwns(s, n)) continue;
    for (int c = 0; c < 2; c++)
      s->reaction[s->node_body[n]][c] -=
          s->kick * s->force[2 * n + c] + s->h * (s->load[2 * n + c] + s->mass[n] * s->setup.gravity[c]);
  }
}

void BudgetAddImpulse(Solid s, int n, int c, double impulse, double v)
{
  if (!SolidOwns(s, n)) return;
  s->reaction[s->node_body[n]][c] += impulse;
  s->budget.reaction_work += impulse * v;
}

/* After the nodes have moved. */
void BudgetAddDecay(Solid s)
{
  const double rate = s->setup.decay_rate;
  for (int n = 0; n < s->nnodes && rate > 0.0; n++)
    for (int c = 0; c < 2; c++) {
      const double v = s->v[2 * n + c];
      BudgetAddImpulse(s, n, c, -s->h * rate * s->mass[n] * v, v);
    }
}

void SolidFindMoved(Solid s, char moved[])
{
  for (int k = 0; k < s->nprescribed; k++) {
    const PrescribedMotion *d = &s->motion[s->prescribed[k].motion];
    for (int c = 0; c < 2 && PrescribedActs(d, s->stats.t - s->stats.h); c++)
      if (d->prescribed[c]) moved[2 * s->prescribed[k].node + c] = 1;
  }
}

/* Half of a substep's work that the solid's own forces, s->force, do at what prescribed motions move, J/m. */
static PetscErrorCode HalfSubstepWork(Solid s, double *work)
{
  char *moved;
  PetscFunctionBeginUser;
  *work = 0.0;
  PetscCall(PetscCalloc1(2 * (size_t)s->nnodes, &moved));
  SolidFindMoved(s, moved);
  for (int k = 0; k < 2 * s->nnodes; k++)
    if (moved[k] && s->inverse_mass[k / 2] > 0.0 && SolidOwns(s, k / 2))
      *work += 0.5 * s->stats.h * s->force[k] * s->v[k];
  PetscCall(PetscFree(moved));
  PetscFunctionReturn(0);
}

/* A motion holds against the force of each substep's start over the whole of it, the solid against the mean of that and the one at its
 * end: half of the last substep's work is that of the step before, half of this step's last one that of the next. */
PetscErrorCode BudgetStartForces(Solid s)
{
  const double *force;
  double half;
  PetscFunctionBeginUser;
  PetscCall(SolidForces(s, &force));
  PetscCall(HalfSubstepWork(s, &half));
  s->budget.reaction_work += half;
  PetscFunctionReturn(0);
}

void BudgetAddPrescribed(Solid s, int motion, int n, int c, double before, double v, double arm)
{
  const double impulse = s->mass[n] * (v - s->v[2 * n + c]);
  /* load and gravity work along the way of the substep, the rest at the mean of the velocities before and after */
  const double steady = s->h * (s->load[2 * n + c] + s->mass[n] * s->setup.gravity[c]);
  const double work = 0.5 * (impulse * (v + before) - steady * (v - before));
  double *sum = s->motion_impulse[motion];
  if (!SolidOwns(s, n)) return;
  s->reaction[s->node_body[n]][c] += impulse;
  s->budget.reaction_work += work;
  sum[c] += impulse;
  sum[2] += arm * impulse;
  sum[3] += work;
}

PetscErrorCode SolidMotionReaction(Solid s, const char *name, double reaction[4])
{
  PetscFunctionBeginUser;
  PetscCall(PetscArrayzero(reaction, 4));
  for (int k = 0; k < s->nmotions; k++)
    for (int i = 0; i < 4 && s->dt > 0.0 && !strcmp(s->motion[k].name, name); i++)
      reaction[i] += s->motion_impulse[k][i] / s->dt;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, reaction, 4, MPI_DOUBLE, MPI_SUM, s->comm));
  PetscFunctionReturn(0);
}

PetscErrorCode SolidGetBudget(Solid s, SolidBudget *budget)
{
  enum {
    WALLS,
    REACTION = 2,
    WORK = 4,
    REACTION_WORK,
    CONTACT_LOSS,
    MASS,
    START,
    MOMENTUM = START + 2,
    LOAD = MOMENTUM + 2,
    COUNT = LOAD + 2
  };
  const SolidBudget *b = &s->budget;
  const double *force;
  double half, sum[COUNT] = {b->walls[0], b->walls[1]};
  PetscFunctionBeginUser;
  PetscCall(SolidForces(s, &force));
  PetscCall(HalfSubstepWork(s, &half));
  sum[REACTION_WORK] = b->reaction_work - half;
  sum[CONTACT_LOSS] = b->contact_loss;
  for (int k = 0; k < 2 * s->nbodies; k++) {
    sum[REACTION + k % 2] += s->reaction[k / 2][k % 2];
    sum[START + k % 2] += s->momentum[k / 2][k % 2];
  }
  for (int n = 0; n < s->nnodes; n++) {
    if (!SolidOwns(s, n)) continue;
    sum[MASS] += s->mass[n];
    for (int c = 0; c < 2; c++) {
      const int k = 2 * n + c;
      sum[WORK] += s->load[k] * (s->x[k] - s->start[k]);
      sum[MOMENTUM + c] += s->mass[n] * s->v[k];
      sum[LOAD + c] += s->load[k];
    }
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sum, COUNT, MPI_DOUBLE, MPI_SUM, s->comm));
  *budget = (SolidBudget){{sum[WALLS], sum[WALLS + 1]},
                          {sum[REACTION], sum[REACTION + 1]},
                          sum[WORK],
                          sum[REACTION_WORK],
                          sum[CONTACT_LOSS],
                          {sum[START], sum[START + 1]},
                          {sum[MOMENTUM], sum[MOMENTUM + 1]},
                          {sum[LOAD], sum[LOAD + 1]},
                          {sum[MASS] * s->setup.gravity[0], sum[MASS] * s->setup.gravity[1]}};
  PetscFunctionReturn(0);
}
