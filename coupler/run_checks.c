#include "common/output/time_reached.h"
#include "coupler/run_state.h"
#include <stdarg.h>

/* Part of time.dt_max: a shorter step is an error. */
#define MIN_STEP 1e-6

/* A step over the one before it, at most: what is extrapolated over it stays near. */
#define MAX_GROWTH 1.3

/* Coupling iterations where friction asks for several: what a step takes at least, and what more are counted as, for where bodies touch it takes 10 to 30, else 3 to 5; and what
 * remains, a step later, of how many the last one took that was not shortened: now and then one is tried anew. */
#define FEW_ITERATIONS 3.0
#define MANY_ITERATIONS 8.0
#define REMEMBERED 0.99

/* Of the domain's smaller extent: a node farther outside has left it. */
#define LEAVES 0.01

/* How often a step that does not converge, or that a participant cannot make, is halved before the run is given up. */
enum { MAX_HALVINGS = 6 };

PetscErrorCode RunFail(const RunState *run, const char *format, ...)
{
  char message[640];
  PetscMPIInt rank;
  va_list arguments;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  va_start(arguments, format);
  vsnprintf(message, sizeof message, format, arguments);
  va_end(arguments);
  if (rank == 0) ServerFail(run->loop->server, "%s", message);
  /* the other ranks wait here for the end of the job */
  PetscCallMPI(MPI_Barrier(PETSC_COMM_WORLD));
  PetscFunctionReturn(0);
}

/* At most `longest`; where friction asks for several coupling iterations over that (viscous_response.h), the shorter step that takes one, if as many of those as make up
 * `longest` are less work. */
static double ShortenedStep(RunState *run, double longest)
{
  const double single =
      run->loop->c->max_iterations > 1 ? CouplerSingleIterationStep(run->loop->coupler) : 0.0;
  const double spared = fmin(fmax(run->iterations_taken, FEW_ITERATIONS), MANY_ITERATIONS);
  run->shortened = (PetscBool)(single < longest && spared * single > longest);
  return run->shortened ? single : longest;
}

void RunRememberIterations(RunState *run, int iterations)
{
  const PetscBool tried = (PetscBool)(iterations > 1 && !run->shortened);
  run->iterations_taken = tried ? iterations : REMEMBERED * run->iterations_taken;
}

/* Halves dt while the solid's elements, where they are expected in the middle of the step, would be inside out. */
static PetscErrorCode KeepElements(const RunState *run, double *dt)
{
  const SolidState *solid = &run->solid;
  int element, inverted;

  PetscFunctionBeginUser;
  for (int halvings = 0;; halvings++, *dt *= 0.5) {
    element = SolidStateInverted(solid, 0.5 * *dt);
    inverted = element >= 0;
    PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &inverted, 1, MPI_INT, MPI_LOR, PETSC_COMM_WORLD));
    if (!inverted || halvings == MAX_HALVINGS) break;
  }
  if (!inverted) PetscFunctionReturn(0);
  if (element >= 0) {
    const int node = solid->element[3 * element];
    ServerFail(
        run->loop->server,
        "at t = %g s the solid's velocity turns the element of node %lld at (%g, %g) inside out within %g s",
        run->t, solid->gid[node], solid->x[2 * node], solid->x[2 * node + 1], 0.5 * *dt);
  }
  /* the other ranks wait here for the end of the job */
  PetscCallMPI(MPI_Barrier(PETSC_COMM_WORLD));
  PetscFunctionReturn(0);
}

PetscErrorCode RunChooseStep(RunState *run, double proposed)
{
  const CouplerCase *c = run->loop->c;
  const double remaining = c->run.end - run->t,
               longest = run->dt_before > 0.0 ? MAX_GROWTH * run->dt_before : HUGE_VAL;
  double wanted = fmin(ShortenedStep(run, fmin(proposed, c->dt_max)), longest);

  PetscFunctionBeginUser;
  const double least = MIN_STEP * c->dt_max;
  if (!(proposed > least)) /* NaN, too */
    PetscCall(RunFail(run,
                      "at t = %g s the fluid proposes a time step of %g s, less than %g of time.dt_max: its "
                      "velocity runs away",
                      run->t, proposed, MIN_STEP));
  if (wanted < least)
    PetscCall(RunFail(
        run,
        "at t = %g s the steps that converge have become shorter than %g of time.dt_max, the last one %g s",
        run->t, MIN_STEP, run->dt_before));
  if (c->options.mode == COUPLER_REACTION) PetscCall(KeepElements(run, &wanted));
  run->dt = remaining < 2.0 * wanted ? 0.5 * remaining : wanted;
  if (TimeReached(wanted, remaining)) run->dt = remaining;
  PetscFunctionReturn(0);
}

PetscErrorCode RunCheckInside(const RunState *run)
{
  const double *lower = run->elements.lower, *upper = run->elements.upper;
  long long gid;
  int local;

  PetscFunctionBeginUser;
  PetscCall(RegionOutside(run->loop->region, &run->solid, &run->elements, 0.0, &gid, &local));
  if (local >= 0) {
    const double *x = &run->solid.x[2 * local];
    ServerFail(run->loop->server,
               "the solid's node %lld at (%g, %g) lies outside of the fluid domain [%g, %g] x [%g, %g]", gid,
               x[0], x[1], lower[0], upper[0], lower[1], upper[1]);
  }
  /* the other ranks wait here for the end of the job */
  if (gid >= 0) PetscCallMPI(MPI_Barrier(PETSC_COMM_WORLD));
  PetscFunctionReturn(0);
}

PetscErrorCode RunCheckPressureLoad(const RunState *run)
{
  PetscFunctionBeginUser;
  if (!run->solid.pressure_load) PetscFunctionReturn(0);
  if (run->loop->c->options.mode != COUPLER_REACTION)
    PetscCall(RunFail(run, "the solid asks for the load of the pressure (solid.pressure_load), which only "
                           "coupler.mode: reaction has"));
  if (CouplerOverlap(run->loop->coupler)->phases)
    PetscCall(RunFail(run, "the solid asks for the load of the pressure (solid.pressure_load), and the fluid "
                           "has phases: an element with their interface has one pressure for both sides "
                           "of it, and a load made of that turns a floating body"));
  PetscFunctionReturn(0);
}

PetscErrorCode RunNoteLeaving(RunState *run)
{
  const double *lower = run->elements.lower, *upper = run->elements.upper;
  const double margin = LEAVES * fmin(upper[0] - lower[0], upper[1] - lower[1]);
  long long gid;
  int local;

  PetscFunctionBeginUser;
  if (run->has_left) PetscFunctionReturn(0);
  PetscCall(RegionOutside(run->loop->region, &run->solid, &run->elements, margin, &gid, &local));
  run->has_left = (PetscBool)(gid >= 0);
  if (local >= 0)
    printf("coracle: note: at t = %g s the solid's node %lld at (%g, %g) has left the fluid's domain; the "
           "fluid does not act on what is outside\n",
           run->t, gid, run->solid.x[2 * local], run->solid.x[2 * local + 1]);
  PetscFunctionReturn(0);
}

PetscErrorCode RunCreateGauges(RunState *run)
{
  const GaugesCase *c = &run->loop->c->gauges;
  double distance;
  int fault;

  PetscFunctionBeginUser;
  PetscCall(GaugesCreate(PETSC_COMM_WORLD, c, &run->solid, run->loop->from, &run->gauges, &fault, &distance));
  if (fault >= 0)
    PetscCall(RunFail(run,
                      "%s: key 'fluid.probes[%d]': expected a point of the solid's surface, (%g, %g) is "
                      "%g m away from it",
                      c->path, c->probe[fault], c->point[fault][0], c->point[fault][1], distance));
  PetscFunctionReturn(0);
}

PetscErrorCode RunCheckDivergence(RunState *run, const StepRecord *step)
{
  DivergenceMonitorStep s = {.t = step->t,
                             .dt = step->dt,
                             .displaced = step->totals.displaced,
                             .speed = step->totals.speed,
                             .held = step->motion.held,
                             .thickness = run->loop->c->options.thickness,
                             .max_iterations = run->iteration.max_iterations};
  const CouplerOptions *o = &run->loop->c->options;
  double gravity[2] = {o->gravity[0], o->gravity[1]};
  char message[512];

  PetscFunctionBeginUser;
  GravityOver(&o->gravity_table, run->t - run->dt, run->dt, gravity);
  for (int c = 0; c < 2; c++) {
    s.velocity[c] = step->motion.velocity[c];
    s.force[c] = step->totals.force[c];
    s.gravity[c] = gravity[c];
    s.extent = hypot(s.extent, run->elements.upper[c] - run->elements.lower[c]);
  }
  if (DivergenceMonitorCheck(&run->monitor, &s, sizeof message, message))
    PetscCall(RunFail(run, "%s", message));
  PetscFunctionReturn(0);
}

/* Of the current step, why not NULL; said of the first one in a run. */
static PetscErrorCode NoteRejection(RunState *run, const char *why)
{
  PetscMPIInt rank;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  if (!run->has_rejected && !rank)
    printf("coracle: note: at t = %g s a step over %g s cannot be made; it is made over half of that, as are "
           "later ones: %s\n",
           run->t, run->dt, why);
  run->has_rejected = PETSC_TRUE;
  PetscFunctionReturn(0);
}

PetscErrorCode RunHalveStep(RunState *run)
{
  const char *why = ServerRejection(run->loop->server);
  const PetscBool last = (PetscBool)(run->halvings++ == MAX_HALVINGS);

  PetscFunctionBeginUser;
  if (last && why)
    PetscCall(
        RunFail(run, "the step from t = %g s cannot be made, not even over %g s: %s", run->t, run->dt, why));
  if (last)
    PetscCall(
        RunFail(run,
                "the step from t = %g s does not converge: even over %g s, after %d coupling iterations, "
                "the solid's velocity at its end differs by %g m/s from the one that the fluid was solved "
                "with; a larger coupler.max_iterations may help",
                run->t, run->dt, run->iteration.max_iterations, run->iteration.residual));
  if (why) PetscCall(NoteRejection(run, why));
  run->dt *= 0.5;
  PetscFunctionReturn(0);
}
