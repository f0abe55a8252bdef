/* A fluid without flow: checks each coupling entry and correction, gives values that the coupler knows. */
#include "tests/route/analytic.h"

enum { MAX = 64 };

typedef struct {
  CoracleClient client;
  int rank, adapted, step, attempt, asked;
  int n, id[MAX];          /* elements last given */
  int n_old, id_old[MAX];  /* elements of the step just made */
  int coupled, entry[MAX]; /* elements' ids by entry of the step just made */
  double x[MAX][3][2], rho[MAX], mu[MAX];
  double memory[5];
  int needs_pressure;
  Fault fault;
  int fault_step;
} Fluid;

static void CheckBoxes(const Fluid *f, int nbox, const double box[])
{
  if (nbox != 2 || box[0] != -1.0 || box[7] != 1e6) CoracleFail(f->client, "the boxes arrived wrongly");
}

static int Region(void *context, int nbox, const double box[], CoracleElements *elements)
{
  Fluid *f = context;
  CheckBoxes(f, nbox, box);
  f->asked++;
  f->n = CellCount(f->rank, f->adapted);
  for (int e = 0; e < f->n; e++) {
    f->id[e] = CellId(f->rank, e, f->adapted);
    f->rho[e] = CellDensity(f->id[e]);
    f->mu[e] = CellViscosity(f->id[e], f->step);
    for (int i = 0; i < 3; i++)
      for (int c = 0; c < 2; c++) f->x[e][i][c] = CellVertex(f->id[e], i, c);
  }
  *elements = (CoracleElements){f->n, &f->x[0][0][0], f->rho, f->mu, NULL, NULL};
  return 0;
}

static void CheckCoupling(Fluid *f)
{
  const CoracleCoupling *k;
  int seen[MAX] = {0}, expected = 0;
  CoracleGetCoupling(f->client, &f->coupled, &k);
  for (int i = 0; i < f->n; i++) expected += CellCoupled(f->id[i]);
  if (f->coupled != expected)
    CoracleFail(f->client, "%d coupling entries, expected %d", f->coupled, expected);
  for (int i = 0; i < f->coupled; i++) {
    const int e = k[i].element;
    if (e < 0 || e >= f->n || seen[e]++) CoracleFail(f->client, "entry %d is of element %d", i, e);
    CoracleCoupling right = CellCoupling(f->id[e], f->step);
    right.element = e;
    if (memcmp(&right, &k[i], sizeof right)) CoracleFail(f->client, "entry %d has wrong values", i);
    f->entry[i] = f->id[e];
  }
}

static void CheckCorrection(const Fluid *f)
{
  const CoracleCorrection *k;
  int n;
  CoracleGetCorrection(f->client, &n, &k);
  if (n != f->coupled) CoracleFail(f->client, "%d corrections, expected %d", n, f->coupled);
  for (int i = 0; i < n; i++) {
    if (k[i].element < 0 || k[i].element >= f->n_old || f->id_old[k[i].element] != f->entry[i])
      CoracleFail(f->client, "correction %d is of element %d", i, k[i].element);
    for (int j = 0; j < 6; j++)
      if ((&k[i].r[0][0])[j] != CellCorrection(f->entry[i], j, f->step))
        CoracleFail(f->client, "correction %d has wrong values in step %d", i, f->step);
  }
}

static void CheckGauges(const Fluid *f)
{
  const CoracleGauge *gauge;
  int n;
  CoracleGetGauges(f->client, &n, &gauge);
  if (n != GaugeCount(f->step)) CoracleFail(f->client, "%d gauges in step %d", n, f->step);
  for (int i = 0; i < n; i++) {
    const CoracleGauge right = GaugeAt(i, f->step);
    if (memcmp(&right, &gauge[i], sizeof right))
      CoracleFail(f->client, "gauge %d is elsewhere in step %d", i, f->step);
  }
}

static void SetFlow(Fluid *f)
{
  double u_start[MAX][6], u_star[MAX][6], u_projected[MAX][6], p[MAX][6], rho[MAX], mu[MAX];
  for (int e = 0; e < f->n; e++) {
    for (int k = 0; k < 6; k++) {
      u_start[e][k] = CellFlow(f->id[e], 4, k, f->step);
      u_star[e][k] = CellFlow(f->id[e], 1, k, f->step);
      u_projected[e][k] = CellFlow(f->id[e], 2, k, f->step);
      p[e][k] = CellFlow(f->id[e], 3, k, f->step);
    }
    rho[e] = CellDensity(f->id[e]) + f->step;
    mu[e] = CellViscosity(f->id[e], f->step);
  }
  if (f->fault == FAULT_NAN && f->step == f->fault_step && f->n) p[f->n - 1][4] = INFINITY;
  if (f->needs_pressure != CoracleNeedsPressure(f->client)) CoracleFail(f->client, "needs pressure");
  const bool missing = f->fault == FAULT_MISSING && f->step == f->fault_step;
  const CoracleFlow flow = {&u_start[0][0],
                            &u_star[0][0],
                            &u_projected[0][0],
                            f->needs_pressure && !missing ? &p[0][0] : NULL,
                            rho,
                            mu,
                            NULL,
                            NULL,
                            NULL};
  CoracleSetFlow(f->client, &flow);
}

static void Step(Fluid *f, CoracleAction action)
{
  const double start = f->step + (action == CORACLE_RUN);
  if (action == CORACLE_RUN) f->step++;
  f->attempt = action == CORACLE_RUN ? 0 : f->attempt + 1;
  if (f->memory[0] != start - 1.0)
    CoracleFail(f->client, "the state of step %d has not been put back", f->step);
  if (f->step == f->fault_step) Misbehave(f->fault);
  CheckCoupling(f);
  f->memory[0] += 1.0;
  f->n_old = f->n;
  memcpy(f->id_old, f->id, sizeof f->id);
  const bool rejects = f->rank == 0 && FluidRejects(f->step, f->attempt);
  if (rejects) CoracleRejectStep(f->client, REASON);
  if (!rejects && (f->fault != FAULT_ORDER || f->step != f->fault_step)) SetFlow(f);
  if (f->step == ADAPT_STEP) {
    f->adapted = 1;
    CoracleElementsChanged(f->client);
  }
  CoracleProposeStep(f->client, CellProposal(f->rank, f->step));
  CoracleEnd(f->client, NULL);
  CheckCorrection(f);
  CheckGauges(f);
}

/* Where the solid is, asked for twice before the fluid says what it has. */
static void GetRegion(const Fluid *f)
{
  const double *box, *again;
  int nbox;
  CoracleGetRegion(f->client, &nbox, &box);
  CheckBoxes(f, nbox, box);
  CoracleGetRegion(f->client, &nbox, &again);
  if (nbox != 2 || again != box) CoracleFail(f->client, "the region is another when asked again");
}

static const char *const SECTIONS[] = {"fluid", NULL};

static void Fail(void *client, const char *message)
{
  CoracleFail(client, "%s", message);
}

int main(int argc, char **argv)
{
  static Fluid f;
  const double lower[] = {-2.0, -3.0}, upper[] = {4.0, 5.0};
  MPI_Comm comm;
  CoracleCase c;
  int size;
  double t, dt;
  CoracleAction action;
  MPI_Comm job = TestJob(argc, argv);
  CoracleOpenComm(job, "fluid", argc, argv, &comm, &f.client);
  CoracleCaseOpen(argc, argv, Fail, f.client, &c);
  MPI_Comm_rank(comm, &f.rank);
  MPI_Comm_size(comm, &size);
  f.fault = (Fault)CoracleCaseWord(c, "fluid.fault", FAULT_NONE, FAULT_WORDS);
  f.fault_step = f.rank == size - 1 ? 4 : -1;
  f.needs_pressure = CoracleCaseBoolOr(c, "fluid.pressure", true);
  const bool early = CoracleCaseBoolOr(c, "fluid.region_first", true);
  CoracleCaseFinish(c, SECTIONS);
  CoracleCaseClose(&c);
  if (early) GetRegion(&f);
  CoracleSetRegion(f.client, 2, lower, upper, Region, &f);
  CoracleBindState(f.client, f.memory, sizeof f.memory);
  CoracleProposeStep(f.client, CellProposal(f.rank, 0));
  CoracleReady(f.client);
  for (;;) {
    CoracleBegin(f.client, &t, &dt, &action);
    if (action == CORACLE_STOP) break;
    if (dt != StepSize(f.step + (action == CORACLE_RUN))) CoracleFail(f.client, "dt is %g", dt);
    Step(&f, action);
  }
  if (f.step != STEPS || f.asked != 2) CoracleFail(f.client, "%d steps, asked %d times", f.step, f.asked);
  CoracleReport(f.client, "cells", f.n, 1);
  CoracleReport(f.client, "largest", f.rank + 0.5, 0);
  CoracleClose(&f.client);
  return TestEnd(&job);
}
