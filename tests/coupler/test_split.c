// ranks: 1 2 3 4
/* Coupling, forces and corrections do not depend on how solid and fluid are dealt out to ranks (some of which
 * are empty), in any mode; the default mode conserves momentum, solid mass and momentum of the solid on the
 * fluid to round-off. */
#include "coupler/step/coupler_impl.h"
#include "tests/coupler/synthetic.h"
#include <stddef.h>

enum { ENTRY = (sizeof(CoracleCoupling) - offsetof(CoracleCoupling, a)) / sizeof(double) };

static SyntheticSolid all_solid, solid, moved;
static SyntheticFluid all_fluid, fluid;

/* Everything a mode gives, by global number. */
typedef struct {
  double coupling[SYNTHETIC_MAX][ENTRY], correction[SYNTHETIC_MAX][6], force[SYNTHETIC_MAX][2];
  double retained[2]; /* kg m/s, of the slip (slip.h) */
  ForceTotals totals;
} Result;

static Result alone, shared;

static const double DT = 1e-3; /* the innermost triangles are not turned over by the middle of it */

static void MakeCase(void)
{
  const double centre[2] = {0.45, 0.5};
  SyntheticDisc(&all_solid, centre, 0.31, 6, 44);
  SyntheticFluidMake(&all_fluid, 23, 5);
  srand(11);
  for (int i = 0; i < all_solid.nnodes; i++) {
    for (int c = 0; c < 2; c++) all_solid.u[i][c] = Random(-1.0, 1.0);
  }
  for (int k = 0; k < all_fluid.n; k++) {
    all_fluid.rho[k] = Random(0.5, 2.0);
    all_fluid.mu[k] = Random(0.5, 2.0);
    for (int i = 0; i < 6; i++) {
      all_fluid.u_star[k][i / 3][i % 3] = Random(-1.0, 1.0);
      all_fluid.u_projected[k][i / 3][i % 3] = Random(-1.0, 1.0);
      all_fluid.p[k][i] = Random(-1.0, 1.0);
    }
  }
}

static void Distribute(MPI_Comm comm)
{
  int rank, size;
  MPI_Comm_rank(comm, &rank);
  MPI_Comm_size(comm, &size);
  SyntheticSolidPart(&all_solid, rank, size, &solid);
  SyntheticFluidPart(&all_fluid, rank, size, &fluid);
  memcpy(&moved, &solid, sizeof solid);
  SyntheticSolidView(&moved);
  moved.view.changed = 0;
  for (int i = 0; i < moved.nnodes; i++) {
    for (int c = 0; c < 2; c++) moved.u[i][c] += sin(7.0 * (double)moved.gid[i] + c);
  }
}

static int GlobalNode(long long gid)
{
  return (int)(gid - 100) / 3;
}

/* One step; two, so that the viscosities of the flow count in the wall term. */
static void Run(MPI_Comm comm, CouplerMode mode, Result *r)
{
  const CouplerOptions options = {.mode = mode, .thickness = 0.004, .gravity = {0.3, -9.81}};
  const CoracleCoupling *coupling;
  const CoracleCorrection *correction;
  const double *force;
  Coupler c;
  int n, nc;
  memset(r, 0, sizeof *r);
  Distribute(comm);
  CHECK(!CouplerCreate(comm, &options, &c), "create");
  CHECK(!CouplerSetElements(c, &fluid.view), "elements");
  for (int step = 0; step < 2; step++) {
    CHECK(!CouplerBuild(c, &solid.view, 0.0, DT, &n, &coupling), "build");
    CHECK(!CouplerComputeForce(c, &fluid.flow, &force, &r->totals), "react");
  }
  CHECK(!CouplerCorrect(c, &moved.view, &nc, &correction), "correct");
  CHECK(n == nc, "%d couplings, %d corrections", n, nc);
  for (int e = 0; e < n; e++) {
    const int k = fluid.global[coupling[e].element];
    CHECK(coupling[e].element == correction[e].element, "order");
    CHECK(e == 0 || coupling[e].element > coupling[e - 1].element, "ascending");
    memcpy(r->coupling[k], coupling[e].a, sizeof r->coupling[k]);
    memcpy(r->correction[k], correction[e].r, sizeof r->correction[k]);
  }
  for (int i = 0; i < solid.nnodes; i++) {
    for (int d = 0; d < 2; d++) r->force[GlobalNode(solid.gid[i])][d] += force[2 * i + d];
  }
  for (int i = 0; i < c->history.n; i++)
    for (int d = 0; d < 2; d++) r->retained[d] += c->history.retained[i][d];
  CHECK(!CouplerDestroy(&c), "destroy");
  MPI_Allreduce(MPI_IN_PLACE, r->coupling, SYNTHETIC_MAX * (ENTRY + 8) + 2, MPI_DOUBLE, MPI_SUM, comm);
}

static void Compare(const char *what, int mode, int n, const double a[], const double b[])
{
  double scale = 0.0;
  for (int i = 0; i < n; i++) scale = fmax(scale, fabs(a[i]));
  CHECK(scale > 0.0, "mode %d: all %s is 0", mode, what);
  for (int i = 0; i < n; i++) {
    CHECK(fabs(a[i] - b[i]) <= 1e-12 * scale, "mode %d, %s %d: %.17g alone, %.17g shared", mode, what, i,
          a[i], b[i]);
  }
}

/* How much of the solid in an element of so many m2 has the bulk's velocity: all, but where less than BULK_LEAST is open. */
static double PartOfBulk(const CoracleCoupling *element, double area)
{
  double sum = 0.0;
  for (int i = 0; i < 9; i++) sum += element->ms[i / 3][i % 3];
  if (element->alpha <= 1.0 - BULK_LEAST) return 1.0;
  const double part = sum / (element->alpha * area);
  CHECK(fabs(part - 1.0) < 1e-14 || fabs(sum / area - (1.0 - BULK_LEAST)) < 1e-14,
        "%g of the solid's %g have the bulk's velocity", part, element->alpha);
  return part;
}

/* With all_solid where it is in the middle of the step.  Sums over the fluid: mass and momentum of the solid, and what the couplings gave to the fluid, of density 1. */
static void CheckConservation(const Result *r)
{
  double area = 0.0, mass = 0.0, us[2] = {0.0}, momentum[2] = {0.0}, after[2] = {0.0}, expected[2] = {0.0};
  for (int k = 0; k < all_fluid.n; k++) {
    CoracleCoupling element;
    memcpy(element.a, r->coupling[k], sizeof r->coupling[k]);
    const double part = PartOfBulk(&element, GeometryArea((const double(*)[2])all_fluid.x[k]));
    area += element.alpha * GeometryArea((const double(*)[2])all_fluid.x[k]);
    for (int i = 0; i < 6; i++) {
      us[i / 3] += element.us[i / 3][i % 3] / part;
      after[i / 3] += r->correction[k][i];
    }
    for (int i = 0; i < 9; i++) {
      const double gram = element.ms[i / 3][i % 3] / part;
      mass += gram;
      for (int c = 0; c < 2; c++) after[c] += gram * all_fluid.u_projected[k][c][i % 3];
    }
  }
  for (int t = 0; t < all_solid.nelements; t++) {
    const int *e = all_solid.element[t];
    const double a = 0.5 * GeometryTurn(all_solid.x[e[0]], all_solid.x[e[1]], all_solid.x[e[2]]);
    for (int i = 0; i < 3; i++) {
      for (int c = 0; c < 2; c++) {
        momentum[c] += a / 3.0 * all_solid.u[e[i]][c];
        expected[c] += a / 3.0 * (all_solid.u[e[i]][c] + sin(7.0 * (double)all_solid.gid[e[i]] + c));
      }
    }
  }
  const double exact = SyntheticArea(&all_solid);
  CHECK(fabs(area - exact) < 1e-14 && fabs(mass - exact) < 1e-14, "solid area %.17g %.17g, not %.17g", area,
        mass, exact);
  for (int c = 0; c < 2; c++) {
    CHECK(fabs(us[c] - momentum[c]) < 1e-14, "momentum %d: %.17g, not %.17g", c, us[c], momentum[c]);
    CHECK(fabs(after[c] - r->retained[c] - expected[c]) < 1e-14, "corrected momentum %d: %.17g, not %.17g", c,
          after[c] - r->retained[c], expected[c]);
  }
  CHECK(r->totals.imbalance < 1e-13, "momentum imbalance %g", r->totals.imbalance);
}

/* The same on this rank alone and on all. */
static void CompareSplits(CouplerMode mode)
{
  Run(PETSC_COMM_SELF, mode, &alone);
  Run(PETSC_COMM_WORLD, mode, &shared);
  Compare("coupling", mode, SYNTHETIC_MAX * ENTRY, &alone.coupling[0][0], &shared.coupling[0][0]);
  if (mode != COUPLER_STRESS_SHELL)
    Compare("correction", mode, SYNTHETIC_MAX * 6, &alone.correction[0][0], &shared.correction[0][0]);
  Compare("force", mode, SYNTHETIC_MAX * 2, &alone.force[0][0], &shared.force[0][0]);
  CHECK(fabs(alone.totals.displaced / shared.totals.displaced - 1.0) < 1e-13, "displaced mass");
}

int main(int argc, char **argv)
{
  CHECK(!PetscInitialize(&argc, &argv, NULL, NULL), "PETSc");
  MakeCase();
  for (int mode = 0; COUPLER_MODES[mode]; mode++) {
    CompareSplits((CouplerMode)mode);
    if (mode == COUPLER_PENALTY_SHELL) CHECK(shared.totals.imbalance < 1e-12, "%g", shared.totals.imbalance);
    if (mode == COUPLER_STRESS_SHELL)
      CHECK(shared.totals.imbalance > 1e-6, "the measure of imbalance sees nothing");
  }
  for (int k = 0; k < all_fluid.n; k++) all_fluid.rho[k] = 1.0;
  Run(PETSC_COMM_WORLD, COUPLER_REACTION, &shared);
  SyntheticMove(&all_solid, 0.5 * DT);
  CheckConservation(&shared);
  SyntheticMove(&all_solid, -0.5 * DT);
  for (int i = 0; i < all_solid.nnodes; i++) {
    all_solid.mobility[i] = Random(0.0, 100.0);
    for (int c = 0; c < 2; c++) all_solid.acceleration[i][c] = Random(-1.0, 1.0);
  }
  CompareSplits(COUPLER_REACTION);
  CHECK(shared.totals.imbalance < 1e-12, "nodes with a mobility: %g", shared.totals.imbalance);
  return PetscFinalize();
}
