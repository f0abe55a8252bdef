#include "coupler/time_loop.h"
#include "common/output/folder.h"
#include "coupler/checkpoints.h"
#include "coupler/coupling_iteration.h"
#include "coupler/divergence_monitor.h"

/* Of dt_max: a shorter step is an error. */
#define LEAST_STEP 1e-6

/* What lives from one step to the next. */
typedef struct {
  TimeLoop *scheme;
  ServerSolid solid;
  ServerElements elements;
  DivergenceMonitor guard;
  Checkpoints checkpoints;
  CouplingIteration tries;
  double t, dt;
} RunState;

/* For what every rank has noticed: one message is enough, from rank 0; the others wait for the end of the
 * job. */
static PetscErrorCode FailTogether(Server server, const char *message)
{
  PetscMPIInt rank;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  if (rank == 0) ServerFail(server, "%s", message);
  PetscCallMPI(MPI_Barrier(PETSC_COMM_WORLD));
  PetscFunctionReturn(0);
}

/* The solid's mesh or motion.  The paper's mode hands the fluid the solid's mean velocity over the step. A
 * reaction needs the velocity at its end, without vibrations: with the mean, half a step late, its inertia
 * term is unstable below rho_s/rho_f of about 1, and it drives the vibrations of a disc until that turns
 * inside out. */
static PetscErrorCode ReceiveSolid(RunState *m)
{
  PetscFunctionBeginUser;
  PetscCall(ServerReceiveSolid(m->scheme->server, &m->solid));
  if (m->scheme->c->options.mode == COUPLER_STRESS_SHELL) m->solid.u = m->solid.mean;
  PetscFunctionReturn(0);
}

/* Asks the fluid for its elements near the solid. */
static PetscErrorCode AskElements(RunState *m)
{
  const TimeLoop *s = m->scheme;

  PetscFunctionBeginUser;
  PetscCall(RegionUpdate(s->region, &m->solid, m->dt));
  PetscCall(ServerAskElements(s->server, s->region->nbox, &s->region->box[0][0][0], &m->elements));
  PetscCall(CouplerSetElements(s->coupler, &m->elements));
  PetscFunctionReturn(0);
}

static PetscErrorCode AskElementsIfNeeded(RunState *m)
{
  PetscBool stale;

  PetscFunctionBeginUser;
  PetscCall(RegionStale(m->scheme->region, &m->solid, &stale));
  if (stale || ServerElementsChanged(m->scheme->server)) PetscCall(AskElements(m));
  PetscFunctionReturn(0);
}

/* At the start the whole solid must be in the fluid. */
static PetscErrorCode CheckInside(RunState *m)
{
  const double *lower = m->elements.lower, *upper = m->elements.upper;
  long long gid;
  int local;

  PetscFunctionBeginUser;
  PetscCall(RegionOutside(m->scheme->region, &m->solid, &m->elements, &gid, &local));
  if (local >= 0) {
    ServerFail(m->scheme->server,
               "the solid's node %lld at (%g, %g) lies outside of the fluid domain [%g, %g] x [%g, %g]", gid,
               m->solid.x[2 * local], m->solid.x[2 * local + 1], lower[0], upper[0], lower[1], upper[1]);
  }
  /* the others wait here for the end of the job */
  if (gid >= 0) PetscCallMPI(MPI_Barrier(PETSC_COMM_WORLD));
  PetscFunctionReturn(0);
}

/* The fluid's proposal within the case's bounds.  The last step ends exactly at the end, and the one before
 * it is cut so that the last is no sliver. */
static PetscErrorCode NextStep(RunState *m, double proposed)
{
  const double left = m->scheme->c->end - m->t;
  const double wanted = fmin(proposed, m->scheme->c->dt_max);
  char message[192];

  PetscFunctionBeginUser;
  /* a flow that runs away takes ever shorter steps and would never end */
  if (!(wanted > LEAST_STEP * m->scheme->c->dt_max)) {
    snprintf(message, sizeof message,
             "at t = %g s the fluid proposes a time step of %g s, less than %g of time.dt_max: its velocity "
             "runs away",
             m->t, wanted, LEAST_STEP);
    PetscCall(FailTogether(m->scheme->server, message));
  }
  m->dt = left < 2.0 * wanted ? 0.5 * left : wanted;
  if (left <= wanted * (1.0 + 1e-9)) m->dt = left;
  PetscFunctionReturn(0);
}

static PetscErrorCode Watch(RunState *m, const StepRecord *step)
{
  DivergenceMonitorStep seen = {
      .t = step->t, .dt = step->dt, .displaced = step->totals.displaced, .tries = m->tries.most};
  char message[512];

  PetscFunctionBeginUser;
  for (int c = 0; c < 2; c++) {
    seen.velocity[c] = step->motion.velocity[c];
    seen.force[c] = step->totals.force[c];
    seen.gravity[c] = m->scheme->c->options.gravity[c];
    seen.extent = hypot(seen.extent, m->elements.upper[c] - m->elements.lower[c]);
  }
  if (DivergenceMonitorCheck(&m->guard, &seen, sizeof message, message))
    PetscCall(FailTogether(m->scheme->server, message));
  PetscFunctionReturn(0);
}

/* --- checkpoints ---------------------------------------------------------------------------------------- */

/* What goes on: the step that comes (0 long at the end, where it is not known), the guard's memory. */
static PetscErrorCode Load(RunState *m, Checkpoint from)
{
  DivergenceMonitor *g = &m->guard;
  char message[128];
  double row[7];

  PetscFunctionBeginUser;
  PetscCall(CheckpointGetNumber(from, "t", &m->t));
  PetscCall(CheckpointGetNumber(from, "dt", &m->dt));
  PetscCall(CheckpointGetDoubles(from, "guard", 0, 1, 7, row));
  *g = (DivergenceMonitor){(int)row[0], (int)row[1], {row[2], row[3]}, {row[4], row[5]}, row[6]};
  if (m->t >= m->scheme->c->end) {
    snprintf(message, sizeof message, "the checkpoint to go on from is at t = %g s already, time.end is %g s",
             m->t, m->scheme->c->end);
    PetscCall(FailTogether(m->scheme->server, message));
  }
  PetscFunctionReturn(0);
}

/* As the step that has been sent begins, or at the end. */
static PetscErrorCode Save(RunState *m)
{
  const DivergenceMonitor *g = &m->guard;
  const double row[7] = {g->nsteps,    g->alternations, g->velocity[0], g->velocity[1],
                         g->change[0], g->change[1],    g->first};
  PetscMPIInt rank;
  Checkpoint to;

  PetscFunctionBeginUser;
  if (!m->checkpoints.due[0]) PetscFunctionReturn(0);
  PetscCallMPI(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  PetscCall(CheckpointCreate(PETSC_COMM_WORLD, m->checkpoints.due, "coupler", &to));
  PetscCall(CheckpointPutNumber(to, "t", m->t));
  PetscCall(CheckpointPutNumber(to, "dt", m->dt));
  PetscCall(CheckpointPutDoubles(to, "guard", rank ? 0 : 1, 7, row));
  PetscCall(WriterSave(m->scheme->record, to));
  PetscCall(CheckpointClose(&to));
  PetscFunctionReturn(0);
}

/* --- the exchanges -------------------------------------------------------------------------------------- */

/* The coupling of the coming step, and the correction of the one just made. */
static PetscErrorCode SendCoupling(RunState *m, int ncorrection, const CoracleCorrection correction[])
{
  const TimeLoop *s = m->scheme;
  const CoracleCoupling *coupling;
  const double *u;
  int n;

  PetscFunctionBeginUser;
  PetscCall(CouplerBuild(s->coupler, &m->solid, m->dt, &n, &coupling));
  if (m->tries.most > 1) {
    PetscCall(CouplingIterationBegin(&m->tries, &m->solid, m->dt, &u));
    PetscCall(CouplerSetInterfaceVelocity(s->coupler, m->tries.mobility, u, &n, &coupling));
  }
  PetscCall(WriterShell(s->record, m->t, s->coupler, &m->solid));
  PetscCall(ServerSendCoupling(s->server, m->t, m->dt, CORACLE_RUN, ncorrection, correction, n, coupling));
  PetscFunctionReturn(0);
}

/* The solid is there, the fluid has answered, and the case suits both: from now on there is output. */
static PetscErrorCode OpenOutput(RunState *m)
{
  TimeLoop *s = m->scheme;
  const char *resume = ServerResumePath(s->server), *folder = s->c->folder;
  const PetscBool resumes = resume ? FolderHolds(PETSC_COMM_WORLD, folder, resume) : PETSC_FALSE;

  PetscFunctionBeginUser;
  PetscCall(ClaimFolder(PETSC_COMM_WORLD, folder, resumes, &s->claim));
  PetscCall(CheckpointsCreate(PETSC_COMM_WORLD, s->server, s->c, &m->checkpoints));
  PetscCall(WriterCreate(PETSC_COMM_WORLD, s->c, s->from, &s->record));
  PetscFunctionReturn(0);
}

static PetscErrorCode Start(RunState *m)
{
  PetscFunctionBeginUser;
  PetscCall(CouplingIterationCreate(PETSC_COMM_WORLD, m->scheme->c->tries, m->scheme->c->tolerance,
                                    m->scheme->c->options.thickness, &m->tries));
  if (m->scheme->from) PetscCall(Load(m, m->scheme->from));
  PetscCall(ReceiveSolid(m));
  PetscCall(AskElements(m));
  if (!m->scheme->from) PetscCall(CheckInside(m));
  PetscCall(NextStep(m, m->dt > 0.0 ? m->dt : ServerProposedStep(m->scheme->server)));
  PetscCall(OpenOutput(m));
  PetscCall(SendCoupling(m, 0, NULL));
  PetscFunctionReturn(0);
}

/* Fluid -> coupler -> solid -> coupler. */
static PetscErrorCode Try(RunState *m, CoracleAction action, StepRecord *step)
{
  const TimeLoop *s = m->scheme;
  const double *force;
  ServerFlow flow;

  PetscFunctionBeginUser;
  PetscCall(ServerReceiveFlow(s->server, &flow));
  const double start = MPI_Wtime();
  PetscCall(CouplerReact(s->coupler, &flow, &force, &step->totals));
  step->force += MPI_Wtime() - start;
  PetscCall(ServerSendForce(s->server, m->t, m->dt, action, force));
  PetscCall(ReceiveSolid(m));
  PetscFunctionReturn(0);
}

/* The fluid makes the step again, with another velocity of the solid. */
static PetscErrorCode AimAgain(RunState *m, int tries)
{
  const TimeLoop *s = m->scheme;
  const CoracleCoupling *coupling;
  const double *u;
  char message[256];
  int n;

  PetscFunctionBeginUser;
  if (tries == m->tries.most) {
    snprintf(message, sizeof message,
             "the step from t = %g s does not converge: after %d tries the solid ends with a velocity %g m/s "
             "away from what the fluid has met; shorter steps (time.dt_max) help, or coupler.tries",
             m->t, tries, m->tries.difference);
    PetscCall(FailTogether(s->server, message));
  }
  PetscCall(CouplingIterationNext(&m->tries, &u));
  PetscCall(CouplerSetInterfaceVelocity(s->coupler, m->tries.mobility, u, &n, &coupling));
  PetscCall(ServerSendCoupling(s->server, m->t, m->dt, CORACLE_REDO, 0, NULL, n, coupling));
  PetscFunctionReturn(0);
}

/* The step; what remains is to send the fluid its correction and the next coupling. */
static PetscErrorCode Exchange(RunState *m, StepRecord *step, int *n, const CoracleCorrection **correction)
{
  const TimeLoop *s = m->scheme;
  PetscBool agree;

  PetscFunctionBeginUser;
  for (step->tries = 1;; step->tries++) {
    PetscCall(Try(m, step->tries == 1 ? CORACLE_RUN : CORACLE_REDO, step));
    PetscCall(CouplingIterationHasConverged(&m->tries, step->tries, &m->solid, &agree));
    if (agree) break;
    PetscCall(AimAgain(m, step->tries));
  }
  PetscCall(CouplingIterationEnd(&m->tries));
  PetscCall(CouplerCorrect(s->coupler, &m->solid, n, correction));
  PetscCall(BulkMotionOf(PETSC_COMM_WORLD, &m->solid, &step->motion));
  step->dt = m->dt;
  m->t = m->t + m->dt >= s->c->end * (1.0 - 1e-14) ? s->c->end : m->t + m->dt;
  step->t = m->t;
  PetscCall(Watch(m, step));
  PetscFunctionReturn(0);
}

static PetscErrorCode Stop(RunState *m, int ncorrection, const CoracleCorrection correction[])
{
  double *none;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(2 * (size_t)m->solid.nnodes, &none));
  PetscCall(ServerSendCoupling(m->scheme->server, m->t, 0.0, CORACLE_STOP, ncorrection, correction, 0, NULL));
  PetscCall(ServerSendForce(m->scheme->server, m->t, 0.0, CORACLE_STOP, none));
  PetscCall(PetscFree(none));
  PetscFunctionReturn(0);
}

PetscErrorCode TimeLoopRun(TimeLoop *s)
{
  RunState m = {.scheme = s};
  double waited, built;
  const CoracleCorrection *correction;
  int n;

  PetscFunctionBeginUser;
  PetscCall(Start(&m));
  while (m.t < s->c->end) {
    StepRecord step = {0};
    waited = ServerWaited(s->server);
    PetscCall(Exchange(&m, &step, &n, &correction));
    PetscCall(CheckpointsFinish(&m.checkpoints));
    if (m.t < s->c->end) {
      built = MPI_Wtime() - ServerWaited(s->server);
      PetscCall(AskElementsIfNeeded(&m));
      PetscCall(NextStep(&m, ServerProposedStep(s->server)));
      PetscCall(CheckpointsAsk(&m.checkpoints, WriterSteps(s->record) + 1, m.t, PETSC_FALSE));
      PetscCall(SendCoupling(&m, n, correction));
      step.overlap = MPI_Wtime() - ServerWaited(s->server) - built;
    }
    step.waiting = ServerWaited(s->server) - waited;
    PetscCall(WriterStep(s->record, &step));
    PetscCall(Save(&m));
  }
  m.dt = 0.0;
  PetscCall(CheckpointsAsk(&m.checkpoints, WriterSteps(s->record), m.t, PETSC_TRUE));
  PetscCall(Stop(&m, n, correction));
  PetscCall(Save(&m));
  PetscCall(ServerFinish(s->server));
  PetscCall(CheckpointsFinish(&m.checkpoints));
  PetscCall(CouplingIterationDestroy(&m.tries));
  PetscFunctionReturn(0);
}
