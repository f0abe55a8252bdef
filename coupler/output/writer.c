#include "coupler/output/writer.h"
#include "common/link/coracle.h"

static const char COLUMNS[] = "t [s],dt [s],u_x [m/s],u_y [m/s],F_x [N],F_y [N],R_x [N],R_y [N],"
                              "uplift_x [N],uplift_y [N],imbalance,pairs,"
                              "overlap [s],force [s],waiting [s],iterations";

struct Writer_s {
  MPI_Comm comm;
  int rank, revision;
  double end, down[2];        /* s, time.end; unit, along gravity */
  double start, reported;     /* wall clock: of the run, of the last line of progress, s */
  double fall_sum, fall_time; /* over the last 5 % of fall_end: int u . down dt, m, and its length, s */
  double fall_end;            /* s, the time.end that fall_sum belongs to */
  Series series;
  Output output;
  WriterTotals totals;
};

/* Seconds as in the summary: the largest of all ranks. */
PetscErrorCode WriterSave(Writer r, Checkpoint to)
{
  double largest[2] = {r->totals.overlap, r->totals.force};

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, largest, 2, MPI_DOUBLE, MPI_MAX, r->comm));
  PetscCall(CheckpointPutNumber(to, "steps", (double)r->totals.steps));
  PetscCall(CheckpointPutNumber(to, "iterations", (double)r->totals.iterations));
  PetscCall(CheckpointPutNumber(to, "fall end", r->fall_end));
  PetscCall(CheckpointPutNumber(to, "fall sum", r->fall_sum));
  PetscCall(CheckpointPutNumber(to, "fall time", r->fall_time));
  PetscCall(CheckpointPutNumber(to, "imbalance", r->totals.imbalance));
  PetscCall(CheckpointPutNumber(to, "end", r->totals.end));
  PetscCall(CheckpointPutNumber(to, "seconds of overlap", largest[0]));
  PetscCall(CheckpointPutNumber(to, "seconds of force", largest[1]));
  PetscCall(OutputSave(r->output, to));
  PetscCall(SeriesSave(r->series, to));
  PetscFunctionReturn(0);
}

static PetscErrorCode Load(Writer r, Checkpoint from)
{
  double steps, iterations;

  PetscFunctionBeginUser;
  PetscCall(CheckpointGetNumber(from, "steps", &steps));
  PetscCall(CheckpointGetNumber(from, "iterations", &iterations));
  PetscCall(CheckpointGetNumber(from, "fall end", &r->fall_end));
  PetscCall(CheckpointGetNumber(from, "fall sum", &r->fall_sum));
  PetscCall(CheckpointGetNumber(from, "fall time", &r->fall_time));
  PetscCall(CheckpointGetNumber(from, "imbalance", &r->totals.imbalance));
  PetscCall(CheckpointGetNumber(from, "end", &r->totals.end));
  PetscCall(CheckpointGetNumber(from, "seconds of overlap", &r->totals.overlap));
  PetscCall(CheckpointGetNumber(from, "seconds of force", &r->totals.force));
  if (r->fall_end != r->end) r->fall_sum = r->fall_time = 0.0;
  r->fall_end = r->end;
  r->totals.steps = (long long)steps;
  r->totals.iterations = (long long)iterations;
  r->totals.resumed = r->totals.end;
  if (!r->rank) printf("coracle: resumes from t = %.5g s, step %lld\n", r->totals.resumed, r->totals.steps);
  PetscFunctionReturn(0);
}

long long WriterSteps(Writer r)
{
  return r->totals.steps;
}

PetscErrorCode WriterCreate(MPI_Comm comm, const CouplerCase *c, Checkpoint from, Writer *writer)
{
  const double *g = c->options.gravity, size = hypot(g[0], g[1]);
  Writer r;

  PetscFunctionBeginUser;
  PetscCall(PetscNew(&r));
  r->comm = comm;
  r->end = r->fall_end = c->run.end;
  r->start = MPI_Wtime();
  r->down[0] = size > 0.0 ? g[0] / size : 0.0;
  r->down[1] = size > 0.0 ? g[1] / size : -1.0;
  PetscCallMPI(MPI_Comm_rank(comm, &r->rank));
  if (!r->rank && c->note[0]) printf("coracle: %s: %s\n", c->name, c->note);
  PetscCall(OutputCreate(comm, c->run.folder, "coupler", c->run.every, c->run.end, from, &r->output));
  PetscCall(OutputText(r->output, "case", c->name));
  PetscCall(OutputText(r->output, "version", CORACLE_VERSION));
  PetscCall(SeriesCreate(comm, c->run.folder, "coupler", COLUMNS, c->run.series_every, from, &r->series));
  if (from) PetscCall(Load(r, from));
  *writer = r;
  PetscFunctionReturn(0);
}

/* Every facet's two triangles with four nodes of their own, so that no rank needs another's. */
static PetscErrorCode WriteShell(Writer r, const Shell shell, const SolidState *solid)
{
  const int nf = shell->nfacets;
  double(*x)[2], (*u)[2], (*normal)[2];
  int(*cell)[3];

  PetscFunctionBeginUser;
  PetscCall(
      PetscMalloc4(4 * (size_t)nf, &x, 4 * (size_t)nf, &u, 2 * (size_t)nf, &normal, 2 * (size_t)nf, &cell));
  for (int e = 0; e < nf; e++) {
    const double *corner[4] = {shell->x[2 * e][0], shell->x[2 * e][1], shell->x[2 * e][2],
                               shell->x[2 * e + 1][2]};
    const int node[4] = {shell->node[2 * e][0], shell->node[2 * e][1], shell->node[2 * e][2],
                         shell->node[2 * e + 1][2]};
    const int cells[2][3] = {{4 * e, 4 * e + 1, 4 * e + 2}, {4 * e, 4 * e + 2, 4 * e + 3}};
    for (int i = 0; i < 4; i++) {
      PetscCall(PetscArraycpy(x[4 * e + i], corner[i], 2));
      PetscCall(PetscArraycpy(u[4 * e + i], &solid->u[2 * node[i]], 2));
    }
    for (int t = 0; t < 2; t++) {
      PetscCall(PetscArraycpy(normal[2 * e + t], shell->normal[e], 2));
      PetscCall(PetscArraycpy(cell[2 * e + t], cells[t], 3));
    }
  }
  PetscCall(OutputGrid(r->output, "shell", r->revision++, 4 * nf, (double *)x, 2 * nf, 3, (int *)cell));
  PetscCall(OutputField(r->output, "velocity", OUTPUT_NODE, 2, (double *)u));
  PetscCall(OutputField(r->output, "normal", OUTPUT_CELL, 2, (double *)normal));
  PetscCall(PetscFree4(x, u, normal, cell));
  PetscFunctionReturn(0);
}

PetscErrorCode WriterShell(Writer r, double t, const Coupler coupler, const SolidState *solid)
{
  PetscFunctionBeginUser;
  if (!OutputDue(r->output, t)) PetscFunctionReturn(0);
  PetscCall(OutputBegin(r->output, t));
  PetscCall(WriteShell(r, CouplerShell(coupler), solid));
  PetscCall(OutputEnd(r->output));
  PetscFunctionReturn(0);
}

/* About once a second, and at the end. */
static void LogProgress(Writer r, const StepRecord *s)
{
  const double now = MPI_Wtime(), spent = now - r->start;
  if (r->rank || (now - r->reported < 1.0 && s->t < r->end)) return;
  r->reported = now;
  printf("coracle: t %.5g s of %g, step %lld, dt %.3g s, solid at (%.4g, %.4g) m/s, %.0f s done, about %.0f "
         "s to go\n",
         s->t, r->end, r->totals.steps, s->dt, s->motion.velocity[0], s->motion.velocity[1], spent,
         spent * (r->end - s->t) / (s->t - r->totals.resumed));
  fflush(stdout);
}

PetscErrorCode WriterStep(Writer r, const StepRecord *s)
{
  const double *u = s->motion.velocity, *force = s->totals.force, *reaction = s->totals.reaction,
               *uplift = s->totals.uplift;
  const double row[] = {s->t,
                        s->dt,
                        u[0],
                        u[1],
                        force[0],
                        force[1],
                        reaction[0],
                        reaction[1],
                        uplift[0],
                        uplift[1],
                        s->totals.imbalance,
                        (double)s->totals.npairs,
                        s->overlap,
                        s->force,
                        s->waiting,
                        s->iterations};
  /* how much of the step lies in the last 5 % of the time */
  const double late = PetscMax(0.0, s->t - PetscMax(s->t - s->dt, 0.95 * r->end));

  PetscFunctionBeginUser;
  r->fall_time += late;
  r->fall_sum += late * (u[0] * r->down[0] + u[1] * r->down[1]);
  r->totals.steps++;
  r->totals.iterations += s->iterations;
  r->totals.end = s->t;
  r->totals.imbalance = PetscMax(r->totals.imbalance, s->totals.imbalance);
  r->totals.overlap += s->overlap;
  r->totals.force += s->force;
  r->totals.nelements = s->motion.nelements;
  r->totals.nfacets = s->motion.nfacets;
  PetscCall(SeriesRow(r->series, row));
  LogProgress(r, s);
  PetscFunctionReturn(0);
}

PetscErrorCode WriterTotalsOf(Writer r, int nfluid, WriterTotals *totals)
{
  double largest[2] = {r->totals.overlap, r->totals.force};
  long long sum = nfluid;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_LONG_LONG, MPI_SUM, r->comm));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, largest, 2, MPI_DOUBLE, MPI_MAX, r->comm));
  *totals = r->totals;
  totals->terminal = r->fall_time > 0.0 ? r->fall_sum / r->fall_time : NAN;
  totals->nfluid = sum;
  totals->overlap = largest[0];
  totals->force = largest[1];
  PetscFunctionReturn(0);
}

PetscErrorCode WriterDestroy(Writer *writer)
{
  PetscFunctionBeginUser;
  if (!*writer) PetscFunctionReturn(0);
  PetscCall(OutputDestroy(&(*writer)->output));
  PetscCall(SeriesDestroy(&(*writer)->series));
  PetscCall(PetscFree(*writer));
  PetscFunctionReturn(0);
}
