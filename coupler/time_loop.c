/* One step from t to t + dt, in as many coupling iterations as it takes.
 *
 *     repeat     fluid   -- u*, u+, rho, mu -->  force     -- force -->  solid
 *                solid   -- x, u_s ---------->  converged?
 *                           if not:             next u_s  -- REDO, coupling -->  fluid
 *     until converged; where that takes too many iterations, or fluid or solid cannot make the step, from the start over half of dt
 *     correction of the fluid to the solid's new velocity
 *     choose dt                                 correction, RUN -->  fluid
 *     shell, overlap and coupling at the solid's new position
 *                                               coupling -->         fluid
 */
#include "coupler/time_loop.h"
#include "common/output/time_reached.h"
#include "coupler/exchange.h"
#include "coupler/run_state.h"

/* Of the first step: attempts, and the squared change of the velocity relative to that of the first. */
enum { SUPPORT_ATTEMPTS = 8 };
#define SUPPORT_TOLERANCE 1e-4

/* Requests the fluid's elements near the solid. */
static PetscErrorCode RequestElements(RunState *run)
{
  const TimeLoop *loop = run->loop;

  PetscFunctionBeginUser;
  PetscCall(RegionUpdate(loop->region, &run->solid, run->dt > 0.0 ? run->dt : loop->c->dt_max));
  PetscCall(ExchangeRequestElements(loop->server, loop->region, &run->elements));
  PetscCall(CouplerSetElements(loop->coupler, &run->elements));
  PetscFunctionReturn(0);
}

/* The same when the solid has left its region or the fluid has another mesh. */
static PetscErrorCode UpdateElements(RunState *run)
{
  PetscBool stale;

  PetscFunctionBeginUser;
  PetscCall(RegionStale(run->loop->region, &run->solid, run->dt, &stale));
  if (stale || ServerElementsChanged(run->loop->server)) PetscCall(RequestElements(run));
  PetscFunctionReturn(0);
}

/* The gauges go where the solid is, and with the next coupling to the fluid. */
static PetscErrorCode MoveGauges(RunState *run)
{
  const CoracleGauge *gauge;
  int n;

  PetscFunctionBeginUser;
  PetscCall(GaugesMove(run->gauges, &run->solid));
  gauge = GaugesGet(run->gauges, &n);
  PetscCall(ServerSetGauges(run->loop->server, n, gauge));
  PetscFunctionReturn(0);
}

/* The fluid repeats the step from t over dt; it begins to before it has the coupling. */
static PetscErrorCode SendRedo(RunState *run)
{
  PetscFunctionBeginUser;
  PetscCall(ServerSendStep(run->loop->server, run->t, run->dt, CORACLE_REDO, 0, NULL));
  PetscFunctionReturn(0);
}

/* The coupling of the step from t over dt, which has been announced. */
static PetscErrorCode SendCoupling(RunState *run)
{
  const TimeLoop *loop = run->loop;
  const CoracleCoupling *coupling;
  int n;

  PetscFunctionBeginUser;
  PetscCall(CouplerBuild(loop->coupler, &run->start, run->t, run->dt, &n, &coupling));
  PetscCall(CouplingIterationBegin(&run->iteration, &run->start, run->dt,
                                   CouplerPredictedVelocity(loop->coupler),
                                   CouplerExplicitFraction(loop->coupler), CouplerGiven(loop->coupler)));
  PetscCall(ServerSendCoupling(loop->server, n, coupling));
  run->start.changed = 0; /* a shorter step from here has the same mesh */
  PetscFunctionReturn(0);
}

/* Begins the coming step; the fluid ends the one before it with the correction, while the coupling is computed. */
static PetscErrorCode SendStep(RunState *run)
{
  const TimeLoop *loop = run->loop;

  PetscFunctionBeginUser;
  PetscCall(SolidStateCopy(&run->solid, &run->start));
  PetscCall(OverlapKeepProperties(CouplerOverlap(loop->coupler)));
  run->halvings = 0;
  run->solid_has_begun = PETSC_FALSE;
  PetscCall(ServerSendStep(loop->server, run->t, run->dt, CORACLE_RUN, run->ncorrection, run->correction));
  PetscCall(ServerPhase(loop->server, "overlap"));
  PetscCall(SendCoupling(run));
  PetscCall(WriterShell(loop->writer, run->t, loop->coupler, &run->start));
  PetscFunctionReturn(0);
}

static PetscErrorCode Start(RunState *run)
{
  const TimeLoop *loop = run->loop;
  const CouplerCase *c = loop->c;

  PetscFunctionBeginUser;
  PetscCall(CouplingIterationCreate(PETSC_COMM_WORLD, c->max_iterations, c->tolerance, c->options.thickness,
                                    &run->iteration));
  if (loop->from) PetscCall(RunLoad(run, loop->from));
  PetscCall(ExchangeReceiveSolid(loop->server, run->mode, &run->solid));
  if (run->solid.pressure_load) PetscCall(CouplerUsePressureLoad(loop->coupler));
  if (loop->from) PetscCall(CouplerLoad(loop->coupler, &run->solid, loop->from));
  PetscCall(ExchangeSelectFields(loop->server, &c->options, &run->solid));
  PetscCall(RequestElements(run));
  PetscCall(RunCheckPressureLoad(run));
  if (!loop->from) PetscCall(RunCheckInside(run));
  const PetscBool shortened = run->shortened; /* of the step that is to come, where a checkpoint has it */
  PetscCall(RunChooseStep(run, run->dt > 0.0 ? run->dt : ServerProposedStep(loop->server)));
  run->shortened = shortened;
  PetscCall(RunCreateGauges(run));
  PetscCall(RunOpenOutput(run));
  PetscCall(MoveGauges(run));
  PetscCall(SendStep(run));
  PetscFunctionReturn(0);
}

/* The same on all ranks. */
static PetscBool IsRejected(RunState *run)
{
  if (!ServerRejection(run->loop->server)) return PETSC_FALSE;
  CheckpointsReject(&run->checkpoints);
  return PETSC_TRUE;
}

/* One coupling iteration: the fluid's flow becomes the solid's force, which makes the solid's motion, unless one of them cannot make the step. */
static PetscErrorCode Iterate(RunState *run, StepRecord *step, PetscBool *rejected)
{
  const TimeLoop *loop = run->loop;
  const double *force, *film, *resistance;
  CoracleFlow flow;

  PetscFunctionBeginUser;
  step->iterations++;
  PetscCall(ServerReceiveFlow(loop->server, &flow));
  *rejected = IsRejected(run);
  if (*rejected) PetscFunctionReturn(0);
  const double start = MPI_Wtime();
  PetscCall(ServerPhase(loop->server, "force"));
  PetscCall(CouplerComputeForce(loop->coupler, &flow, &force, &step->totals));
  step->force += MPI_Wtime() - start;
  CouplerFilm(loop->coupler, &film, &resistance);
  PetscCall(ServerSetFilm(loop->server, film, resistance));
  PetscCall(ServerSendForce(loop->server, run->t, run->dt, run->solid_has_begun ? CORACLE_REDO : CORACLE_RUN,
                            force));
  run->solid_has_begun = PETSC_TRUE;
  PetscCall(ExchangeReceiveSolid(loop->server, run->mode, &run->solid));
  *rejected = IsRejected(run);
  PetscFunctionReturn(0);
}

/* The fluid repeats the step with the next iterate as the solid's velocity. */
static PetscErrorCode RepeatStep(RunState *run)
{
  const TimeLoop *loop = run->loop;
  const CoracleCoupling *coupling;
  const double *u;
  int n;

  PetscFunctionBeginUser;
  PetscCall(SendRedo(run));
  PetscCall(CouplingIterationNext(&run->iteration, &u));
  PetscCall(CouplerSetInterfaceVelocity(loop->coupler, u, &n, &coupling));
  PetscCall(ServerSendCoupling(loop->server, n, coupling));
  PetscFunctionReturn(0);
}

/* From the start of the step over half of dt. */
static PetscErrorCode HalveStep(RunState *run)
{
  PetscFunctionBeginUser;
  PetscCall(RunHalveStep(run));
  PetscCall(OverlapRestoreProperties(CouplerOverlap(run->loop->coupler)));
  PetscCall(SendRedo(run));
  PetscCall(SendCoupling(run));
  PetscFunctionReturn(0);
}

/* The first step knows nothing of how the solid holds against the fluid: with the acceleration of a free fall everywhere, what is
 * inside it would move like a fluid (a block at rest in water would lack a seventh of its weight).  So the step is made again
 * with the acceleration at its end until the velocity does not change; from then on the last step's serves. */
static PetscErrorCode FindSupport(RunState *run, StepRecord *step)
{
  const TimeLoop *loop = run->loop;
  const int n = 2 * run->start.nnodes;
  double *u, change = 1.0, first = 0.0;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(n, &u));
  PetscCall(PetscArraycpy(u, CouplerPredictedVelocity(loop->coupler), n));
  for (int i = 0; i < SUPPORT_ATTEMPTS && change > SUPPORT_TOLERANCE * first; i++) {
    const CoracleCoupling *coupling;
    PetscBool rejected;
    int ncoupling, lost;
    PetscCall(Iterate(run, step, &rejected));
    if (rejected) {
      PetscCall(HalveStep(run));
      PetscCall(PetscArraycpy(u, CouplerPredictedVelocity(loop->coupler), n));
      i = -1;
      continue;
    }
    lost = run->solid.changed || run->solid.lost;
    PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &lost, 1, MPI_INT, MPI_LOR, PETSC_COMM_WORLD));
    change = 0.0;
    for (int k = 0; k < n && !lost; k++) {
      change += PetscSqr(run->solid.u[k] - u[k]);
      u[k] = run->solid.u[k];
    }
    PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &change, 1, MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD));
    if (i == 0) first = change;
    PetscCall(CouplerBuild(loop->coupler, &run->start, run->t, run->dt, &ncoupling, &coupling));
    if (!lost) PetscCall(CouplerSetAcceleration(loop->coupler, &run->solid));
    PetscCall(SendRedo(run));
    PetscCall(CouplerSetInterfaceVelocity(loop->coupler, CouplerPredictedVelocity(loop->coupler), &ncoupling,
                                          &coupling));
    PetscCall(ServerSendCoupling(loop->server, ncoupling, coupling));
  }
  PetscCall(PetscFree(u));
  PetscFunctionReturn(0);
}

/* The first step of a run among phases; with one fluid a body in it has begun to move as a whole. */
static PetscBool NeedsSupport(const RunState *run)
{
  const CouplerCase *c = run->loop->c;
  return (PetscBool)(run->t == 0.0 && !run->loop->from && c->options.mode == COUPLER_REACTION &&
                     c->max_iterations > 1 && CouplerOverlap(run->loop->coupler)->phases);
}

/* Coupling iterations over dt, at most as many as are allowed; not converged, too, where one of them is rejected. */
static PetscErrorCode SolveOverStep(RunState *run, StepRecord *step, PetscBool *converged)
{
  PetscBool rejected;

  PetscFunctionBeginUser;
  *converged = PETSC_FALSE;
  for (int i = 1;; i++) {
    PetscCall(Iterate(run, step, &rejected));
    run->iteration.failures += rejected;
    if (rejected) break;
    PetscCall(CouplingIterationHasConverged(&run->iteration, i, &run->solid, converged));
    if (*converged || i == run->iteration.max_iterations) break;
    PetscCall(RepeatStep(run));
  }
  PetscFunctionReturn(0);
}

/* Until the step has converged, over half of dt where it has not. */
static PetscErrorCode SolveStep(RunState *run, StepRecord *step)
{
  int before = step->iterations; /* without those that find the support */
  PetscBool converged;

  PetscFunctionBeginUser;
  for (;;) {
    const int begun = step->iterations;
    if (NeedsSupport(run)) PetscCall(FindSupport(run, step));
    before += step->iterations - begun;
    PetscCall(SolveOverStep(run, step, &converged));
    if (converged) break;
    PetscCall(HalveStep(run));
  }
  RunRememberIterations(run, step->iterations - before);
  PetscFunctionReturn(0);
}

/* t moves to the step's end. */
static PetscErrorCode AcceptStep(RunState *run, StepRecord *step)
{
  const TimeLoop *loop = run->loop;
  const double end = loop->c->run.end, t = run->t + run->dt;

  PetscFunctionBeginUser;
  PetscCall(CouplerCorrect(loop->coupler, &run->solid, &run->ncorrection, &run->correction));
  PetscCall(MoveGauges(run));
  PetscCall(BulkMotionOf(PETSC_COMM_WORLD, &run->solid, &step->motion));
  run->t = TimeReached(t, end) ? end : t;
  run->ends = (PetscBool)(run->t >= end);
  if (!run->ends) PetscCall(EarlyStopDue(&run->early_stop, run->t, &run->ends));
  step->t = run->t;
  step->dt = run->dt;
  PetscCall(RunCheckDivergence(run, step));
  PetscCall(RunNoteLeaving(run));
  PetscCall(CheckpointsFinish(&run->checkpoints));
  PetscFunctionReturn(0);
}

static PetscErrorCode BeginStep(RunState *run, StepRecord *step)
{
  const TimeLoop *loop = run->loop;
  const double start = MPI_Wtime() - ServerWaited(loop->server);

  PetscFunctionBeginUser;
  run->dt_before = run->dt;
  PetscCall(RunChooseStep(run, ServerProposedStep(loop->server)));
  PetscCall(UpdateElements(run));
  PetscCall(CheckpointsRequest(&run->checkpoints, WriterSteps(loop->writer) + 1, run->t, PETSC_FALSE));
  PetscCall(SendStep(run));
  step->overlap = MPI_Wtime() - ServerWaited(loop->server) - start;
  PetscFunctionReturn(0);
}

/* The last correction and STOP to both clients; returns when they have closed. */
static PetscErrorCode Stop(RunState *run)
{
  const Server server = run->loop->server;

  PetscFunctionBeginUser;
  run->dt_before = run->dt;
  run->dt = 0.0;
  run->shortened = PETSC_FALSE;
  PetscCall(CheckpointsRequest(&run->checkpoints, WriterSteps(run->loop->writer), run->t, PETSC_TRUE));
  PetscCall(ServerSendStep(server, run->t, 0.0, CORACLE_STOP, run->ncorrection, run->correction));
  PetscCall(ServerSendForce(server, run->t, 0.0, CORACLE_STOP, NULL));
  PetscCall(ShellExtrude(CouplerShell(run->loop->coupler), &run->solid, run->solid.changed));
  PetscCall(WriterShell(run->loop->writer, run->t, run->loop->coupler, &run->solid));
  PetscCall(RunSave(run));
  PetscCall(ServerFinish(server));
  PetscCall(CheckpointsFinish(&run->checkpoints));
  PetscCall(CouplingIterationDestroy(&run->iteration));
  PetscCall(GaugesDestroy(&run->gauges));
  PetscCall(SolidStateDestroy(&run->start));
  PetscFunctionReturn(0);
}

PetscErrorCode TimeLoopRun(TimeLoop *loop)
{
  RunState run = {.loop = loop, .mode = CouplerModeGet(loop->c->options.mode)};

  PetscFunctionBeginUser;
  PetscCall(Start(&run));
  while (!run.ends) {
    const double waited = ServerWaited(loop->server);
    StepRecord step = {0};
    PetscCall(SolveStep(&run, &step));
    PetscCall(AcceptStep(&run, &step));
    if (!run.ends) PetscCall(BeginStep(&run, &step));
    step.waiting = ServerWaited(loop->server) - waited;
    PetscCall(ServerPhase(loop->server, "output"));
    PetscCall(WriterStep(loop->writer, &step));
    PetscCall(RunSave(&run));
  }
  PetscCall(Stop(&run));
  PetscFunctionReturn(0);
}
