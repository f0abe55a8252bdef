// ranks: 3 4 6
/* The time loop against a fake fluid and a fake solid, through the real messages.
 *
 * The fluid has no pressure and no viscosity, but the implicit coupling and the correction, element by
 * element; the solid is a rigid disc that translates.  With P the fluid's momentum, m the solid's mass, M_f
 * that of the fluid inside, R what that keeps of its slip (slip.h) and v the solid's velocity,
 * P - R + (m - M_f) v - (m - M_f) g t     stays what it was,
 * whatever the time steps, to round-off. */
#include "coupler/step/coupler_impl.h"
#include "coupler/time_loop.h"
#include "tests/coupler/synthetic.h"
#include "tests/coupler/synthetic_momentum.h"
#include "tests/remove_folder.h"

static const double GRAVITY[2] = {0.4, -1.0}, RHO = 3.0, DENSITY = 7.0, DT = 0.013;
static const char *const CASE = "case: exchange\n";
static SyntheticSolid all_solid, solid;
static SyntheticFluid all_fluid, fluid, region;

static void Part(MPI_Comm comm, int *rank, int *size)
{
  MPI_Comm_rank(comm, rank);
  MPI_Comm_size(comm, size);
}

/* --- fluid ---------------------------------------------------------------------------------------------- */

static int ElementsIn(void *context, int nbox, const double box[], CoracleElements *elements)
{
  region.n = 0;
  for (int k = 0; k < fluid.n; k++) {
    const GeometryBox own = GeometryBoxOf((const double(*)[2])fluid.x[k]);
    int inside = 0;
    for (int b = 0; b < nbox; b++) {
      const GeometryBox asked = {{box[4 * b], box[4 * b + 1]}, {box[4 * b + 2], box[4 * b + 3]}};
      inside |= GeometryBoxOverlap(&own, &asked);
    }
    if (!inside) continue;
    memcpy(region.x[region.n], fluid.x[k], sizeof fluid.x[k]);
    region.rho[region.n] = RHO;
    region.mu[region.n] = 0.1;
    region.global[region.n++] = k;
  }
  *elements = (CoracleElements){region.n, &region.x[0][0][0], region.rho, region.mu, NULL, NULL};
  return 0;
}

/* M u += r */
static void Correct(const CoracleCorrection *k, const double x[3][2], double u[2][3])
{
  for (int d = 0; d < 2; d++) {
    double m[6][6], r[6];
    for (int i = 0; i < 3; i++) {
      r[i] = k->r[d][i];
      for (int j = 0; j < 3; j++) m[i][j] = GeometryArea(x) / (i == j ? 6.0 : 12.0);
    }
    SyntheticSolve(3, m, r);
    for (int i = 0; i < 3; i++) u[d][i] += r[i];
  }
}

/* One step of the fluid: the velocity lives in fluid.u_projected. */
static void FluidStep(CoracleClient client, double dt)
{
  static CoracleCoupling kept[SYNTHETIC_MAX];
  static int global[SYNTHETIC_MAX];
  const CoracleCoupling *coupling;
  const CoracleCorrection *correction;
  int n, nc;
  CHECK(!CoracleGetCoupling(client, &n, &coupling), "coupling");
  memcpy(kept, coupling, (size_t)n * sizeof *kept);
  memcpy(global, region.global, sizeof global);
  for (int i = 0; i < region.n; i++)
    memcpy(region.u_start[i], fluid.u_projected[region.global[i]], sizeof region.u_start[i]);
  for (int e = 0; e < n; e++) {
    const int k = global[kept[e].element];
    SyntheticMomentum(&kept[e], GeometryArea((const double(*)[2])fluid.x[k]), RHO / dt, fluid.u_projected[k]);
  }
  for (int i = 0; i < region.n; i++)
    memcpy(region.u_projected[i], fluid.u_projected[region.global[i]], sizeof region.u_projected[i]);
  const CoracleFlow flow = {&region.u_start[0][0][0],
                            &region.u_projected[0][0][0],
                            &region.u_projected[0][0][0],
                            NULL,
                            region.rho,
                            region.mu,
                            NULL,
                            NULL,
                            NULL};
  CHECK(!CoracleNeedsPressure(client), "the mode reaction asks for the pressure");
  CHECK(!CoracleSetFlow(client, &flow), "flow");
  CHECK(!CoracleProposeStep(client, DT * (1.0 + 0.5 * sin(1e3 * dt))), "propose");
  CHECK(!CoracleEnd(client, NULL), "end");
  CHECK(!CoracleGetCorrection(client, &nc, &correction) && nc == n, "%d corrections of %d", nc, n);
  for (int e = 0; e < n; e++) {
    const int k = global[kept[e].element];
    CHECK(correction[e].element == kept[e].element, "order");
    Correct(&correction[e], (const double(*)[2])fluid.x[k], fluid.u_projected[k]);
  }
}

static void RunFluid(int argc, char **argv, double momentum[2])
{
  const double lower[2] = {0.0, 0.0}, upper[2] = {1.0, 1.0};
  CoracleClient client;
  CoracleAction action;
  MPI_Comm comm;
  double t, dt;
  int rank, size;
  CHECK(!CoracleOpen("fluid", argc, argv, &comm, &client), "open");
  Part(comm, &rank, &size);
  SyntheticFluidPart(&all_fluid, rank, size, &fluid);
  CHECK(!CoracleSetRegion(client, 2, lower, upper, ElementsIn, NULL), "region");
  CHECK(!CoracleProposeStep(client, DT), "propose");
  CHECK(!CoracleReady(client), "ready");
  while (!CoracleBegin(client, &t, &dt, &action) && action == CORACLE_RUN) FluidStep(client, dt);
  for (int k = 0; k < fluid.n; k++) {
    const double third = RHO * GeometryArea((const double(*)[2])fluid.x[k]) / 3.0;
    for (int i = 0; i < 6; i++) momentum[i / 3] += third * fluid.u_projected[k][i / 3][i % 3];
  }
  CHECK(!CoracleClose(&client), "close");
}

/* --- solid ---------------------------------------------------------------------------------------------- */

static void RunSolid(int argc, char **argv, double end, double momentum[2])
{
  const double area = SyntheticArea(&all_solid);
  CoracleClient client;
  CoracleAction action;
  MPI_Comm comm;
  double t, dt, v[2] = {0.0, 0.0}, reached = 0.0;
  int rank, size;
  CHECK(!CoracleOpen("solid", argc, argv, &comm, &client), "open");
  Part(comm, &rank, &size);
  SyntheticSolidPart(&all_solid, rank, size, &solid);
  CHECK(!CoracleSetNodes(client, 2, solid.nnodes, solid.gid, &solid.x[0][0], &solid.u[0][0]), "nodes");
  CHECK(!CoracleSetSurface(client, solid.nfacets, &solid.facet[0][0]), "surface");
  CHECK(!CoracleSetVolume(client, solid.nelements, &solid.element[0][0]), "volume");
  CHECK(!CoracleReady(client), "ready");
  while (!CoracleBegin(client, &t, &dt, &action) && action == CORACLE_RUN) {
    const double *force;
    double sum[2] = {0.0, 0.0};
    CHECK(!CoracleGetForce(client, &force), "force");
    for (int i = 0; i < 2 * solid.nnodes; i++) sum[i % 2] += force[i];
    CHECK(!MPI_Allreduce(MPI_IN_PLACE, sum, 2, MPI_DOUBLE, MPI_SUM, comm), "sum");
    for (int c = 0; c < 2; c++) v[c] += dt * (sum[c] / (DENSITY * area) + GRAVITY[c]);
    for (int i = 0; i < 2 * solid.nnodes; i++) {
      (&solid.u[0][0])[i] = v[i % 2];
      (&solid.x[0][0])[i] += dt * v[i % 2];
    }
    CHECK(!CoracleSubstep(client, dt, &solid.u[0][0]), "substep");
    CHECK(!CoracleEnd(client, &solid.x[0][0]), "end");
    reached = t + dt;
  }
  CHECK(fabs(reached - end) < 1e-14, "the last step ends at %.17g", reached);
  for (int c = 0; c < 2 && rank == 0; c++) momentum[c] = (DENSITY - RHO) * area * (v[c] - GRAVITY[c] * end);
  CHECK(!CoracleClose(&client), "close");
}

/* --- coupler -------------------------------------------------------------------------------------------- */

static void RunCoupler(int argc, char **argv, const char *folder, double end, double momentum[2])
{
  CouplerCase c = {.name = "exchange",
                   .run = {.folder = folder, .every = 0.2, .end = end},
                   .dt_max = 2.0 * DT,
                   .max_iterations = 1};
  TimeLoop loop = {.c = &c};
  WriterTotals totals;
  Server server;
  MPI_Comm comm;
  c.options =
      (CouplerOptions){.mode = COUPLER_REACTION, .thickness = 0.002, .gravity = {GRAVITY[0], GRAVITY[1]}};
  CHECK(!ServerOpen(argc, argv, &comm, &server), "open");
  PETSC_COMM_WORLD = comm;
  CHECK(!PetscInitialize(NULL, NULL, NULL, NULL), "PETSc");
  loop.server = server;
  CHECK(!CouplerCreate(comm, &c.options, &loop.coupler) &&
            !RegionCreate(comm, c.options.thickness, &loop.region) &&
            !WriterCreate(comm, &c, NULL, &loop.writer),
        "create");
  CHECK(!TimeLoopRun(&loop), "run");
  CHECK(!WriterTotalsOf(loop.writer, 0, &totals), "totals");
  CHECK(totals.imbalance < 1e-11, "imbalance %g", totals.imbalance);
  CHECK(totals.steps > 30 && totals.terminal > 0.05, "%lld steps, terminal velocity %g", totals.steps,
        totals.terminal);
  const History *h = &loop.coupler->history;
  for (int i = 0; i < h->n; i++)
    for (int d = 0; d < 2; d++) momentum[d] -= h->retained[i][d];
  CHECK(!WriterDestroy(&loop.writer) && !RegionDestroy(&loop.region) && !CouplerDestroy(&loop.coupler),
        "destroy");
  CHECK(!PetscFinalize() && !ServerClose(&server), "close");
}

/* A case file of this run's own: the link compares it between participants. */
static void MakeCaseFile(int rank, char folder[64], char path[96])
{
  snprintf(folder, 64, "/tmp/coracle_exchange_XXXXXX");
  if (rank == 0) CHECK(mkdtemp(folder), "no folder");
  CHECK(!MPI_Bcast(folder, 64, MPI_CHAR, 0, MPI_COMM_WORLD), "broadcast");
  snprintf(path, 96, "%s/case.yaml", folder);
  if (rank == 0) {
    FILE *f = fopen(path, "w");
    CHECK(f && fputs(CASE, f) >= 0 && !fclose(f), "no case file");
  }
  CHECK(!MPI_Barrier(MPI_COMM_WORLD), "barrier");
}

int main(int argc, char **argv)
{
  const double centre[2] = {0.45, 0.62}, end = 0.6;
  double momentum[2] = {0.0, 0.0};
  char folder[64], path[96], *arguments[] = {argv[0], path, NULL};
  int rank, size;
  MPI_Init(&argc, &argv);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  MakeCaseFile(rank, folder, path);
  SyntheticFluidMake(&all_fluid, 18, 4);
  SyntheticDisc(&all_solid, centre, 0.17, 4, 24);
  if (rank % 3 == 0) RunFluid(2, arguments, momentum);
  if (rank % 3 == 1) RunCoupler(2, arguments, folder, end, momentum);
  if (rank % 3 == 2) RunSolid(2, arguments, end, momentum);
  CHECK(!MPI_Allreduce(MPI_IN_PLACE, momentum, 2, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD), "sum");
  CHECK(hypot(momentum[0], momentum[1]) < 1e-12, "momentum (%g, %g) was made", momentum[0], momentum[1]);
  if (rank == 0) RemoveFolder(folder);
  return MPI_Finalize();
}
