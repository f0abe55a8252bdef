// ranks: 1 2 3
/* Nodes with a mobility: momentum is conserved to round-off, fluid and solid move together however light the
 * solid is, and fall freely together. */
#include "coupler/step/coupler_impl.h"
#include "coupler/terms/inertia.h"
#include "tests/coupler/synthetic.h"
#include "tests/coupler/synthetic_momentum.h"

static SyntheticSolid all_solid, solid;
static SyntheticFluid all_fluid, fluid;
/* Of the velocity across a curved surface, what D keeps at most: 1 - s^8 (slip.h). */
#define CURVED 0.15
static const double RHO = 2.0, DT = 0.01, OWN[2] = {3.0, -7.0}, START[2] = {0.2, -0.1};

/* Lumped masses of the solid and its start; rigid: mobility 0. */
static void MakeSolid(double density, int rigid)
{
  const double centre[2] = {0.5, 0.5};
  SyntheticDisc(&all_solid, centre, 0.3, 5, 48);
  for (int t = 0; t < all_solid.nelements; t++) {
    const int *e = all_solid.element[t];
    const double third =
        density * 0.5 * GeometryTurn(all_solid.x[e[0]], all_solid.x[e[1]], all_solid.x[e[2]]) / 3.0;
    for (int i = 0; i < 3; i++) all_solid.mobility[e[i]] += third;
  }
  for (int i = 0; i < all_solid.nnodes; i++) {
    all_solid.mobility[i] = rigid ? 0.0 : 1.0 / all_solid.mobility[i];
    for (int c = 0; c < 2; c++) {
      all_solid.acceleration[i][c] = rigid ? 0.0 : OWN[c];
      all_solid.u[i][c] = START[c];
    }
  }
}

/* One step without pressure but for kick, which u+ has beyond u*.  v: the centre's velocity after it; returns
 * how far that is from free fall, of what free fall has added. */
static double Step(double kick, ForceTotals *totals, double v[2])
{
  const CouplerOptions options = {.mode = COUPLER_REACTION, .thickness = 0.002, .gravity = {0.0, 0.0}};
  const CoracleCoupling *coupling;
  const double *force;
  double total[3] = {0.0};
  Coupler c;
  int rank, size, n;
  MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
  MPI_Comm_size(PETSC_COMM_WORLD, &size);
  for (int k = 0; k < all_fluid.n; k++) all_fluid.rho[k] = RHO;
  SyntheticSolidPart(&all_solid, rank, size, &solid);
  SyntheticFluidPart(&all_fluid, rank, size, &fluid);
  for (int k = 0; k < fluid.n; k++) fluid.mu[k] = 0.0;
  CHECK(!CouplerCreate(PETSC_COMM_WORLD, &options, &c), "create");
  CHECK(!CouplerSetElements(c, &fluid.view), "elements");
  CHECK(!CouplerBuild(c, &solid.view, 0.0, DT, &n, &coupling), "build");
  for (int k = 0; k < fluid.n; k++)
    for (int i = 0; i < 6; i++) fluid.u_start[k][i / 3][i % 3] = fluid.u_star[k][i / 3][i % 3] = START[i / 3];
  for (int e = 0; e < n; e++) {
    const int k = coupling[e].element;
    SyntheticMomentum(&coupling[e], GeometryArea((const double(*)[2])fluid.x[k]), RHO / DT, fluid.u_star[k]);
  }
  for (int k = 0; k < fluid.n; k++)
    for (int i = 0; i < 6; i++)
      fluid.u_projected[k][i / 3][i % 3] = fluid.u_star[k][i / 3][i % 3] + kick * (i + 1);
  CHECK(!CouplerComputeForce(c, &fluid.flow, &force, totals), "react");
  for (int i = 0; i < solid.nnodes; i++) {
    const double x = solid.x[i][0] - 0.5, y = solid.x[i][1] - 0.5;
    if (solid.mobility[i] == 0.0 || hypot(x, y) > 1e-9) continue; /* every copy's share of the force */
    for (int d = 0; d < 2; d++) total[d] += force[2 * i + d] * solid.mobility[i];
  }
  MPI_Allreduce(MPI_IN_PLACE, total, 2, MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD);
  for (int d = 0; d < 2; d++) v[d] = START[d] + DT * (OWN[d] + total[d]);
  CHECK(!CouplerDestroy(&c), "destroy");
  return hypot(v[0] - START[0] - DT * OWN[0], v[1] - START[1] - DT * OWN[1]) / (DT * hypot(OWN[0], OWN[1]));
}

/* A fluid that goes through the surface of a solid at a step's start: where the surface crosses, the inertia of a solid 20 times as dense
 * keeps the fluid's velocity along the surface, and all of the velocity moves with it; that of a very heavy one, which counts as
 * INERTIA_FREE_MOST times as dense, does nearly neither: the fluid gets the solid's velocity across the surface and keeps its own along it. */
static void CheckSurface(double ratio, double kept)
{
  const int heavy = kept < 1.0;
  static const double WIND[2] = {1.0, 2.0};
  const CouplerOptions options = {.mode = COUPLER_REACTION, .thickness = 0.002, .gravity = {0.0, 0.0}};
  const CoracleCoupling *coupling;
  Coupler c;
  int n, rank, size, crossed = 0;
  MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
  MPI_Comm_size(PETSC_COMM_WORLD, &size);
  MakeSolid(RHO * ratio, 0);
  SyntheticSolidPart(&all_solid, rank, size, &solid);
  CHECK(!CouplerCreate(PETSC_COMM_WORLD, &options, &c), "create");
  CHECK(!CouplerSetElements(c, &fluid.view), "elements");
  CHECK(!CouplerBuild(c, &solid.view, 0.0, DT, &n, &coupling), "build");
  for (int e = 0; e < n; e++) {
    const CoracleCoupling *k = &coupling[e];
    const double(*x)[2] = (const double(*)[2])fluid.x[k->element];
    const int is_crossed = k->shell > 0.0 && k->alpha < 0.999;
    const double trace = k->kept[0][0] + k->kept[1][1];
    double u[2][3];
    crossed += is_crossed;
    if (!(k->flags & CORACLE_HAS_INERTIA)) continue;
    const double moves = k->inertia_tensor[0][0] + k->inertia_tensor[1][1],
                 free_part = is_crossed && heavy ? 1.0 - kept : 0.0;
    CHECK(trace > is_crossed * kept - 1e-3 && trace < is_crossed * kept * (1.0 + CURVED) + 1e-3,
          "an element %g of which is solid keeps %g", k->alpha, trace);
    CHECK(fabs(moves - (2.0 - free_part)) < 1e-3 + (heavy ? kept * CURVED : 0.0),
          "an element %g of which is solid moves %g", k->alpha, moves);
    if (!heavy || k->alpha < 0.3) continue;
    for (int i = 0; i < 6; i++) u[i / 3][i % 3] = START[i / 3] + WIND[i / 3];
    SyntheticMomentum(k, GeometryArea(x), RHO / DT, u);
    const double slip = free_part * (WIND[0] * k->inertia_tensor[1][1] - WIND[1] * k->inertia_tensor[0][1]);
    const double along = free_part * (WIND[1] * k->inertia_tensor[0][0] - WIND[0] * k->inertia_tensor[0][1]);
    for (int d = 0; d < 2; d++) {
      const double expected = START[d] + DT * OWN[d] + (d == 0 ? slip : along);
      for (int i = 0; i < 3; i++)
        CHECK(fabs(u[d][i] - expected) < 0.2 * hypot(WIND[0], WIND[1]),
              "an element %g of which is solid: u%c = %g, not %g", k->alpha, "xy"[d], u[d][i], expected);
    }
  }
  MPI_Allreduce(MPI_IN_PLACE, &crossed, 1, MPI_INT, MPI_SUM, PETSC_COMM_WORLD);
  CHECK(crossed > 10, "%d elements are crossed", crossed);
  CHECK(!CouplerDestroy(&c), "destroy");
}

int main(int argc, char **argv)
{
  static const double DENSITY[] = {20.0, 2.5, 2.0};
  ForceTotals totals;
  double v[2];
  CHECK(!PetscInitialize(&argc, &argv, NULL, NULL), "PETSc");
  SyntheticFluidMake(&all_fluid, 20, 9);
  for (int k = 0; k < 3; k++) {
    MakeSolid(DENSITY[k], 0);
    /* the fluid inside has the solid's acceleration and no inertia of its own: the centre falls freely */
    const double error = Step(0.0, &totals, v);
    CHECK(error < 3e-3, "density %g: the centre's velocity is (%g, %g), %g of its own off", DENSITY[k], v[0],
          v[1], error);
    CHECK(totals.imbalance < 1e-12, "density %g: imbalance %g", DENSITY[k], totals.imbalance);
    (void)Step(0.3, &totals, v);
    CHECK(totals.imbalance < 1e-12, "density %g, moved by the pressure: imbalance %g", DENSITY[k],
          totals.imbalance);
  }
  CheckSurface(20.0, 1.0);
  CheckSurface(1e6, INERTIA_KEPT_RATIO / (INERTIA_FREE_MOST - 1.0));
  MakeSolid(2.0, 1);
  (void)Step(0.0, &totals, v);
  CHECK(hypot(totals.reaction[0], totals.reaction[1]) < 1e-9,
        "a held solid with the fluid's velocity: reaction (%g, %g)", totals.reaction[0], totals.reaction[1]);
  (void)Step(0.3, &totals, v);
  CHECK(totals.imbalance < 1e-12, "a held solid that the pressure acts on: imbalance %g", totals.imbalance);
  CHECK(totals.reaction[1] > INERTIA_HELD / DT * RHO * SyntheticArea(&all_solid) * 0.3,
        "it resists with %g N/m", totals.reaction[1]);
  return PetscFinalize();
}
