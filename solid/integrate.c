/* Time stepping: forces, substeps, and how long a substep may be. */
#include "common/output/time_reached.h"
#include "solid/loads.h"
#include "solid/rigid.h"
#include "solid/springs.h"

enum { CHECK_EVERY = 20 }; /* substeps between two checks of the stability limit, at most */
enum { FEW = 2 };          /* that a fast body's skin is for */
#define KEEP 0.75          /* of the allowed length, down to which the last one is kept */
#define LENGTHEN 1.003     /* from one plan to the next, at most */

static double Clock(void)
{
  return MPI_Wtime();
}

PetscErrorCode SolidForces(Solid s, const double **force)
{
  PetscFunctionBeginUser;
  *force = s->force;
  if (s->force_valid) PetscFunctionReturn(0);
  const double start = Clock();
  PetscCall(SolidInternalForces(s));
  const double elements = Clock();
  if (s->joints) JointsAddForces(s->joints, s);
  const double joints = Clock();
  PetscCall(ContactAddForces(s->contact, s));
  PetscCall(SpringsAddForces(s));
  LoadsAddForces(s);
  const double contact = Clock();
  PetscCall(CopiesSum(s->copies, 2, s->force));
  const double copies = Clock();
  PetscCall(RigidConstrain(s));
  s->force_valid = PETSC_TRUE;
  s->stats.seconds[0] += elements - start + Clock() - copies;
  s->stats.seconds[1] += contact - joints;
  s->stats.seconds[2] += copies - contact;
  s->stats.seconds[4] += joints - elements;
  PetscFunctionReturn(0);
}

/* --- the substep's length ----------------------------------------------------------------------------- */

PetscErrorCode SolidLimit(Solid s, double *limit)
{
  PetscFunctionBeginUser;
  ElementRates rates = ContactRate(s->contact);
  if (s->joints) rates.stiffness += JointsRate(s->joints);
  PetscCall(SpringsRate(s, &rates));
  *limit = SolidElementLimit(s, rates);
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, limit, 1, MPI_DOUBLE, MPI_MIN, s->comm));
  PetscFunctionReturn(0);
}

/* Of a body's surface nodes: how far the farthest is from its place at the last search; largest speed, acceleration now, or of
 * what is prescribed until the next check. */
typedef struct {
  double moved, speed, acceleration;
} BulkMotion;

/* The largest speeds, squared, that motions will give nodes within the window, s: they may change at once. */
static void PrescribedSpeeds(const Solid s, double window, BulkMotion m[])
{
  double velocity = 0.0, turn = 0.0, pivot[2] = {0.0, 0.0};
  for (int k = 0, motion = -1; k < s->nprescribed; k++) {
    const PrescribedMotion *d = &s->motion[s->prescribed[k].motion];
    const double *x = s->x + 2 * s->prescribed[k].node;
    if (!PrescribedActs(d, s->stats.t)) continue;
    if (motion != s->prescribed[k].motion) {
      motion = s->prescribed[k].motion;
      PrescribedLargest(d, s->stats.t, window, &velocity, &turn);
      if (PrescribedTurns(d)) PrescribedPivot(d, s->stats.t, pivot);
    }
    BulkMotion *of = &m[s->node_body[s->prescribed[k].node]];
    const double speed = velocity + turn * hypot(x[0] - pivot[0], x[1] - pivot[1]);
    of->speed = fmax(of->speed, speed * speed);
  }
}

/* m[nbodies + 1], room for one behind the bodies; failed: some rank cannot make the step. */
static PetscErrorCode MotionNow(Solid s, const double force[], double window, BulkMotion m[],
                                PetscBool *failed)
{
  PetscFunctionBeginUser;
  PetscCall(PetscArrayzero(m, (size_t)s->nbodies + 1));
  for (int n = 0; n < s->nnodes; n++) {
    if (!s->surface[n]) continue;
    double speed = 0.0, acceleration = 0.0;
    for (int c = 0; c < 2; c++) {
      const double a = (force[2 * n + c] + s->load[2 * n + c]) * s->inverse_mass[n] + s->setup.gravity[c];
      speed += s->v[2 * n + c] * s->v[2 * n + c];
      acceleration += a * a;
    }
    BulkMotion *of = &m[s->node_body[n]];
    of->moved = fmax(of->moved, ContactMovedSquared(s->contact, s, n));
    of->speed = fmax(of->speed, speed);
    of->acceleration = fmax(of->acceleration, acceleration);
  }
  PrescribedSpeeds(s, window, m);
  m[s->nbodies].moved = s->failure[0] ? 1.0 : 0.0;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, m, 3 * s->nbodies + 1, MPI_DOUBLE, MPI_MAX, s->comm));
  *failed = (PetscBool)(m[s->nbodies].moved > 0.0);
  for (int b = 0; b < s->nbodies; b++)
    m[b] = (BulkMotion){sqrt(m[b].moved), sqrt(m[b].speed), sqrt(m[b].acceleration)};
  PetscFunctionReturn(0);
}

/* How far a node gets in k substeps of h if speed and acceleration do not double. */
static double Travel(const BulkMotion *m, int k, double h)
{
  return m->moved + 2.0 * k * h * (m->speed + k * h * m->acceleration);
}

/* In k substeps no body leaves its skin.  One that is struck may get as fast as what strikes it, so that in more than a few substeps
 * all are to stay within the shortest skin. */
static PetscBool StayWithinSkins(const Solid s, const BulkMotion m[], int k, double h)
{
  const double *skin = ContactSkins(s->contact);
  double shortest = HUGE_VAL;
  for (int b = 0; b < s->nbodies; b++) shortest = fmin(shortest, skin[b]);
  for (int b = 0; b < s->nbodies; b++)
    if (Travel(&m[b], k, h) > (k > FEW ? shortest : skin[b])) return PETSC_FALSE;
  return PETSC_TRUE;
}

static int SafeSubsteps(const Solid s, const BulkMotion m[], double h)
{
  int k = CHECK_EVERY;
  while (k > 1 && !StayWithinSkins(s, m, k, h)) k /= 2;
  return k;
}

static double LargestTravel(const Solid s, const BulkMotion m[], int k, double h)
{
  double largest = 0.0;
  for (int b = 0; b < s->nbodies; b++) largest = fmax(largest, Travel(&m[b], k, h));
  return largest;
}

/* Candidates for the coming substeps of h, from where the bodies are. */
static PetscErrorCode SearchAgain(Solid s, BulkMotion m[], double h)
{
  double *least;
  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1((size_t)s->nbodies, &least));
  for (int b = 0; b < s->nbodies; b++) {
    m[b].moved = 0.0;
    least[b] = Travel(&m[b], FEW, h);
  }
  PetscCall(ContactSearch(s->contact, s, least));
  PetscCall(PetscFree(least));
  s->force_valid = PETSC_FALSE;
  PetscFunctionReturn(0);
}

/* Searches anew always at the start of a step, so that candidates follow from x alone and a step that is
 * redone has the same bits, and when the candidates may not last.  *limit: of stability; *substeps: how many
 * until the next check; *failed: none. */
static PetscErrorCode CheckContact(Solid s, double *limit, int *substeps, PetscBool *failed)
{
  const double *force;
  BulkMotion *m;
  double after;
  PetscFunctionBeginUser;
  if (s->done == 0.0) {
    PetscCall(ContactSearch(s->contact, s, NULL));
    s->force_valid = PETSC_FALSE;
  }
  PetscCall(SolidLimit(s, limit));
  PetscCall(SolidForces(s, &force)); /* with how fast rigid bodies turn */
  const double h = fmin(fmin(s->setup.courant * *limit, RigidLongestSubstep(s)), s->dt);
  PetscCall(PetscMalloc1((size_t)s->nbodies + 1, &m));
  PetscCall(MotionNow(s, force, CHECK_EVERY * h, m, failed));
  if (!*failed && !StayWithinSkins(s, m, CHECK_EVERY, h)) {
    PetscCall(SearchAgain(s, m, h));
    PetscCall(SolidLimit(s, &after));
    *limit = fmin(*limit, after); /* contact has been searched for substeps of h */
  }
  *substeps = (int)fmin(SafeSubsteps(s, m, h), fmax(1.0, LoadsSteadyFor(s, CHECK_EVERY * h) / h));
  ContactSetTravel(s->contact, LargestTravel(s, m, *substeps, h));
  PetscCall(PetscFree(m));
  PetscFunctionReturn(0);
}

/* At once as short as is allowed, kept while that is not much less than what is allowed, and slowly longer: every change
 * of length costs the scheme some of its energy conservation, and a length that goes up and down with a vibration, as the
 * limit does where bodies deform, feeds it (a ball of rubber that fell from 1 m rose to 4 m). */
static double ChooseLength(Solid s, double allowed)
{
  if (s->planned <= 0.0 || s->planned > allowed)
    s->planned = allowed;
  else if (s->planned < KEEP * allowed)
    s->planned *= LENGTHEN;
  return s->planned;
}

/* Substeps for the rest of the step, none longer than courant times the limit; none where a rank cannot make it. */
static PetscErrorCode Plan(Solid s)
{
  const double start = Clock(), rest = s->dt - s->done;
  double limit;
  PetscBool failed;
  PetscFunctionBeginUser;
  PetscCall(CheckContact(s, &limit, &s->until_check, &failed));
  if (failed) {
    s->remaining = 0;
    PetscFunctionReturn(0);
  }
  const double length = ChooseLength(s, fmin(s->setup.courant * limit, RigidLongestSubstep(s)));
  const double substeps = TimeSteps(rest, length);
  if (substeps > INT_MAX) {
    (void)snprintf(
        s->failure, sizeof s->failure,
        "a step of %g s would take %.3g substeps of %g s, which the smallest and stiffest elements need: "
        "shorten time.dt_max",
        s->dt, substeps, length);
    s->remaining = 0;
    PetscFunctionReturn(0);
  }
  s->remaining = (int)substeps;
  s->h = rest / s->remaining;
  s->stats.seconds[3] += Clock() - start;
  PetscFunctionReturn(0);
}

/* --- the step ----------------------------------------------------------------------------------------- */

/* interface_velocity: what the forces at the step's start make of the velocity by its end (interface_motion.c). */
static PetscErrorCode ExtrapolateVelocity(Solid s)
{
  const double *force;
  PetscFunctionBeginUser;
  PetscCall(SolidForces(s, &force));
  for (int k = 0; k < 2 * s->nnodes; k++) {
    const double by_mass = s->inverse_mass[k / 2];
    s->interface_velocity[k] = s->v[k];
    if (by_mass > 0.0)
      s->interface_velocity[k] += s->dt * (by_mass * (force[k] + s->load[k]) + s->setup.gravity[k % 2] -
                                           s->setup.decay_rate * s->v[k]);
  }
  PetscFunctionReturn(0);
}

PetscErrorCode SolidStart(Solid s, double dt, const double load[])
{
  PetscFunctionBeginUser;
  if (s->unsynchronised) PetscCall(JointsSynchronise(s->joints, s));
  s->unsynchronised = PETSC_FALSE;
  if (load) {
    PetscCall(PetscArraycpy(s->load, load, 2 * (size_t)s->nnodes));
    PetscCall(CopiesSum(s->copies, 2, s->load));
  } else {
    PetscCall(PetscArrayzero(s->load, 2 * (size_t)s->nnodes));
  }
  PetscCall(PetscArraycpy(s->start, s->x, 2 * (size_t)s->nnodes));
  s->dt = s->stats.dt = dt;
  s->done = 0.0;
  s->failure[0] = '\0';
  GravityOver(&s->setup.gravity_table, s->stats.t, dt, s->setup.gravity);
  s->stats.substeps = 0;
  PetscCall(SolidMoveFilms(s));
  BudgetStart(s);
  PetscCall(Plan(s));
  PetscCall(BudgetStartForces(s));
  PetscCall(ExtrapolateVelocity(s));
  PetscFunctionReturn(0);
}

PetscBool SolidRemaining(Solid s)
{
  return (PetscBool)(s->remaining > 0);
}

/* Where prescribed nodes are before they move. */
static void KeepPrescribed(Solid s)
{
  for (int k = 0; k < s->nprescribed; k++)
    for (int c = 0; c < 2; c++) {
      s->position_before[2 * k + c] = s->x[2 * s->prescribed[k].node + c];
      s->velocity_before[2 * k + c] = s->v[2 * s->prescribed[k].node + c];
      s->is_taken[2 * s->prescribed[k].node + c] = 0;
    }
}

/* They go their own way: from there by their velocity's mean; of several motions of a node the last one that acts has it. */
static void MovePrescribed(Solid s)
{
  PrescribedSubstep substep = {0}; /* of the motion of the node before */
  double v[2];
  for (int k = s->nprescribed - 1, motion = -1; k >= 0; k--) {
    const int n = s->prescribed[k].node;
    const PrescribedMotion *d = &s->motion[s->prescribed[k].motion];
    if (!PrescribedActs(d, s->stats.t)) continue;
    if (motion != s->prescribed[k].motion) substep = PrescribedSubstepOf(d, s->stats.t, s->h);
    motion = s->prescribed[k].motion;
    const double *at = s->position_before + 2 * k, half = 0.5 * s->h;
    PrescribedNodeVelocity(&substep, at, v);
    const double arm[2] = {substep.pivot[1] - at[1] + half * (substep.velocity[1] - v[1]),
                           at[0] - substep.pivot[0] + half * (v[0] - substep.velocity[0])};
    for (int c = 0; c < 2; c++) {
      if (!d->prescribed[c] || s->is_taken[2 * n + c]) continue;
      s->is_taken[2 * n + c] = 1;
      BudgetAddPrescribed(s, motion, n, c, s->velocity_before[2 * k + c], v[c], arm[c]);
      s->v[2 * n + c] = v[c];
      s->x[2 * n + c] = at[c] + s->h * v[c];
    }
  }
}

/* v += k f/m + h (l/m + g - d v), f internal and contact forces, l the fluid's, d the decay rate and v that at the end; x += h v; fixed nodes stay.
 * k: half of this substep and of the one before: v is of the middle of a substep, which makes the scheme of second order where h changes, too, and
 * vibrations keep their energy.  The fluid's momentum is the load times the step, whatever h did before it. */
static void Move(Solid s)
{
  const double h = s->h, k = s->kick, *restrict force = s->force, *restrict load = s->load,
               *restrict inverse_mass = s->inverse_mass;
  const double kept = 1.0 / (1.0 + h * s->setup.decay_rate);
  double *restrict x = s->x, *restrict v = s->v;
  for (int n = 0; n < s->nnodes; n++) {
    const double free_node = inverse_mass[n] > 0.0 ? h : 0.0;
    for (int c = 0; c < 2; c++) {
      v[2 * n + c] +=
          inverse_mass[n] * (k * force[2 * n + c] + h * load[2 * n + c]) + free_node * s->setup.gravity[c];
      v[2 * n + c] *= kept;
      x[2 * n + c] += h * v[2 * n + c];
    }
  }
}

/* Edges loaded to their strength part before the substep; what is left of the step is planned anew. */
static PetscErrorCode Crack(Solid s)
{
  const double *force;
  PetscBool changed;
  PetscFunctionBeginUser;
  const double start = Clock();
  PetscCall(JointsAdvance(s->joints, s, &changed));
  s->stats.seconds[4] += Clock() - start;
  if (!changed) PetscFunctionReturn(0);
  PetscCall(Plan(s));
  PetscCall(SolidForces(s, &force));
  PetscFunctionReturn(0);
}

PetscErrorCode SolidSubstep(Solid s, double *h)
{
  const double *force;
  PetscFunctionBeginUser;
  *h = s->h;
  if (s->until_check == 0) PetscCall(Plan(s));
  if (s->remaining > 0) PetscCall(SolidForces(s, &force));
  if (s->remaining > 0 && s->joints) PetscCall(Crack(s));
  if (s->size == 1 && s->failure[0]) s->remaining = 0;
  if (s->remaining == 0) PetscFunctionReturn(0);
  s->kick = s->moved_for > 0.0 ? 0.5 * (s->moved_for + s->h) : s->h;
  ContactCommit(s->contact);
  BudgetAddSubstep(s);
  KeepPrescribed(s);
  Move(s);
  PetscCall(RigidMove(s));
  BudgetAddDecay(s);
  MovePrescribed(s);
  SpringsAddBudget(s);
  LoadsAddBudget(s);
  s->force_valid = PETSC_FALSE;
  s->moved_for = s->h;
  *h = s->h;
  s->done += s->h;
  s->stats.t += s->h;
  s->stats.h = s->h;
  s->stats.substeps++;
  s->stats.total++;
  s->remaining--;
  s->until_check--;
  PetscFunctionReturn(0);
}

PetscErrorCode SolidStepFailure(Solid s, const char **why)
{
  const double *force;
  PetscMPIInt has_failed;
  PetscFunctionBeginUser;
  PetscCall(SolidForces(s, &force)); /* of the step's end */
  has_failed = s->failure[0] ? s->rank + 1 : 0;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &has_failed, 1, MPI_INT, MPI_MAX, s->comm));
  *why = has_failed ? s->failure : NULL;
  if (has_failed) PetscCallMPI(MPI_Bcast(s->failure, sizeof s->failure, MPI_CHAR, has_failed - 1, s->comm));
  PetscFunctionReturn(0);
}
