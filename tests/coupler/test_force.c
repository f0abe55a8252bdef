// ranks: 1 2 3
/* Forces on a closed polygon against what mechanics says: buoyancy, rigid motion, accelerated fluid, the wall
 * term's coefficients. */
#include "common/space/p2.h"
#include "coupler/step/coupler_impl.h"
#include "coupler/terms/inertia.h"
#include "tests/coupler/synthetic.h"

static SyntheticSolid all_solid, solid;
static SyntheticFluid all_fluid, fluid;
static const double GRAVITY[2] = {1.5, -9.81}, RHO = 800.0;
static double viscosity = 1.0;

typedef void (*FlowFunction)(const double x[2], double u[2], double *p);

static void Hydrostatic(const double x[2], double u[2], double *p)
{
  u[0] = u[1] = 0.0;
  *p = 3.0 + RHO * (GRAVITY[0] * x[0] + GRAVITY[1] * x[1]);
}

static void Rigid(const double x[2], double u[2], double *p)
{
  u[0] = 0.3 - 0.7 * (x[1] - 0.5);
  u[1] = -0.2 + 0.7 * (x[0] - 0.5);
  *p = 0.0;
}

static void Accelerated(const double x[2], double u[2], double *p)
{
  Rigid(x, u, p);
  u[0] += 0.02;
  u[1] += 0.05;
}

static void SetFlow(FlowFunction f, double u[][2][3])
{
  for (int k = 0; k < all_fluid.n; k++) {
    for (int i = 0; i < 6; i++) {
      double at[2], v[2];
      SyntheticP2Node((const double(*)[2])all_fluid.x[k], i, at);
      f(at, v, &all_fluid.p[k][i]);
      for (int c = 0; c < 2 && i < 3; c++) u[k][c][i] = v[c];
    }
  }
}

static void SetSolid(FlowFunction f)
{
  double p;
  for (int i = 0; i < all_solid.nnodes; i++) f(all_solid.x[i], all_solid.u[i], &p);
}

/* One step on all ranks; in the mode reaction it begins where the solid is in all_solid in its middle. */
static void Step(CouplerMode mode, double thickness, double dt, Coupler *c, ForceTotals *totals)
{
  const double half = mode == COUPLER_REACTION ? 0.5 * dt : 0.0;
  const CouplerOptions options = {.mode = mode, .thickness = thickness, .gravity = {GRAVITY[0], GRAVITY[1]}};
  const CoracleCoupling *coupling;
  const double *force;
  int rank, size, n;
  MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
  MPI_Comm_size(PETSC_COMM_WORLD, &size);
  for (int k = 0; k < all_fluid.n; k++) {
    all_fluid.rho[k] = RHO;
    all_fluid.mu[k] = viscosity;
  }
  SyntheticMove(&all_solid, -half);
  SyntheticSolidPart(&all_solid, rank, size, &solid);
  SyntheticMove(&all_solid, half);
  SyntheticFluidPart(&all_fluid, rank, size, &fluid);
  CHECK(!CouplerCreate(PETSC_COMM_WORLD, &options, c), "create");
  CHECK(!CouplerSetElements(*c, &fluid.view), "elements");
  CHECK(!CouplerBuild(*c, &solid.view, 0.0, dt, &n, &coupling), "build");
  CHECK(!CouplerComputeForce(*c, &fluid.flow, &force, totals), "react");
}

static void CheckTotal(const char *what, const double force[2], double fx, double fy, double tolerance)
{
  const double error = hypot(force[0] - fx, force[1] - fy) / hypot(fx, fy);
  CHECK(error <= tolerance, "%s: force (%.15g, %.15g), not (%.15g, %.15g): error %g", what, force[0],
        force[1], fx, fy, error);
}

/* At rest in a linear pressure: rho g V, to round-off by default; the sampled pressure is that of the shell's
 * middle: off by dr / 2r. */
static void CheckBuoyancy(double radius, double share)
{
  const double dr = 0.002, area = share * SyntheticArea(&all_solid);
  const double middle = 1.0 + 0.5 * dr / radius;
  Coupler c;
  ForceTotals totals;
  SetSolid(Hydrostatic);
  SetFlow(Hydrostatic, all_fluid.u_star);
  SetFlow(Hydrostatic, all_fluid.u_projected);
  for (int mode = COUPLER_REACTION; mode <= COUPLER_PENALTY_SHELL; mode += COUPLER_PENALTY_SHELL) {
    Step((CouplerMode)mode, dr, 0.01, &c, &totals);
    CheckTotal(COUPLER_MODES[mode], totals.force, -RHO * GRAVITY[0] * area, -RHO * GRAVITY[1] * area, 1e-12);
    CHECK(fabs(totals.displaced - RHO * area) < 1e-12 * RHO, "displaced mass %g", totals.displaced);
    CHECK(!CouplerDestroy(&c), "destroy");
  }
  if (share < 1.0) return;
  Step(COUPLER_STRESS_SHELL, dr, 0.01, &c, &totals);
  CheckTotal("surface", totals.force, -RHO * GRAVITY[0] * area * middle, -RHO * GRAVITY[1] * area * middle,
             2e-4);
  CHECK(!CouplerDestroy(&c), "destroy");
}

/* 0.3, 0.7 N in each fluid element act on the solid where it covers a part of one. */
static void CheckRemainder(void)
{
  static double remainder[SYNTHETIC_MAX][2];
  const double *force;
  double covered = 0.0;
  Coupler c;
  ForceTotals without, with;
  SetSolid(Hydrostatic);
  SetFlow(Hydrostatic, all_fluid.u_star);
  SetFlow(Hydrostatic, all_fluid.u_projected);
  Step(COUPLER_REACTION, 0.002, 0.01, &c, &without);
  CoracleFlow flow = fluid.flow;
  for (int k = 0; k < fluid.n; k++) {
    remainder[k][0] = 0.3;
    remainder[k][1] = 0.7;
  }
  flow.remainder = &remainder[0][0];
  CHECK(!CouplerComputeForce(c, &flow, &force, &with), "force");
  for (int e = 0; e < c->overlap->ncoupled; e++) covered += c->coupling[e].alpha > 0.0;
  MPI_Allreduce(MPI_IN_PLACE, &covered, 1, MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD);
  const double more[2] = {with.force[0] - without.force[0], with.force[1] - without.force[1]};
  CheckTotal("remainder", more, 0.3 * covered, 0.7 * covered, 1e-10);
  CHECK(!CouplerDestroy(&c), "destroy");
}

/* u* = u+ = u_s, turning: no reaction, buoyancy only.  u+ accelerated by du: M_f du/dt more.  Without
 * viscosity, because the shell's outer nodes carry the surface's velocity: in a rotation they slip by dr
 * omega. */
static void CheckMotion(void)
{
  const double du[2] = {0.02, 0.05};
  const double area = SyntheticArea(&all_solid), dt = 0.01;
  Coupler c;
  ForceTotals totals;
  viscosity = 0.0;
  SetSolid(Rigid);
  SetFlow(Rigid, all_fluid.u_star);
  SetFlow(Rigid, all_fluid.u_projected);
  Step(COUPLER_REACTION, 0.002, dt, &c, &totals);
  CheckTotal("rigid", totals.force, -RHO * GRAVITY[0] * area, -RHO * GRAVITY[1] * area, 1e-10);
  CHECK(!CouplerDestroy(&c), "destroy");
  SetFlow(Accelerated, all_fluid.u_projected);
  Step(COUPLER_REACTION, 0.002, dt, &c, &totals);
  const double beside[2] = {totals.force[0] - totals.reaction[0], totals.force[1] - totals.reaction[1]};
  CheckTotal("accelerated", beside, RHO * area * (0.02 / dt - GRAVITY[0]),
             RHO * area * (0.05 / dt - GRAVITY[1]), 1e-10);
  CHECK(!CouplerDestroy(&c), "destroy");
  viscosity = 1.0;
  SetFlow(Accelerated, all_fluid.u_star);
  Step(COUPLER_REACTION, 0.002, dt, &c, &totals);
  /* m (I - P) du over the volume (inertia.h), and a positive part from viscosity, which is small: mu / dxw << m r */
  const double m = INERTIA_HELD * RHO / dt;
  double force[2] = {0.0, 0.0};
  const Overlap o = c->overlap;
  for (int p = 0; p < o->pairs.n; p++) {
    double freed[2];
    WallApply(&c->element[o->coupled_index[p]].freed, du, freed);
    for (int d = 0; d < 2 && !o->source[o->pairs.pair[p].a].is_shell; d++)
      force[d] += m * o->pairs.pair[p].area * (du[d] - freed[d]);
  }
  CHECK(!MPI_Allreduce(MPI_IN_PLACE, force, 2, MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD), "sum");
  CheckTotal("slip", totals.reaction, force[0], force[1], 0.02);
  CHECK(totals.reaction[1] > force[1], "the shell takes no momentum");
  CHECK(force[1] > 0.5 * m * du[1] * area && force[1] < 0.99 * m * du[1] * area,
        "the surface crosses no element");
  CHECK(totals.imbalance < 1e-12, "imbalance %g", totals.imbalance);
  CHECK(!CouplerDestroy(&c), "destroy");
}

/* a symmetric, positive semidefinite, s = a u_s + I (G - kept) u_s where u_s is constant over the element. */
static void CheckCoupledElements(Coupler c)
{
  for (int e = 0; e < c->overlap->ncoupled; e++) {
    const CoracleCoupling *k = &c->coupling[e];
    const double *a = &k->a[0][0][0][0];
    double trace = 0.0, inertia = 0.0, v[6], form = 0.0; /* inertia: the implicit inertia's trace */
    for (int i = 0; i < 6; i++) {
      trace += a[7 * i];
      inertia += k->implicit_inertia[i % 3][i % 3];
    }
    for (int trial = 0; trial < 20; trial++) {
      for (int i = 0; i < 6; i++) v[i] = Random(-1.0, 1.0);
      form = 0.0;
      for (int i = 0; i < 6; i++) {
        for (int j = 0; j < 6; j++) form += a[6 * i + j] * v[i] * v[j];
      }
      CHECK(form >= -1e-14 * trace, "element %d: v a v = %g, trace %g", e, form, trace);
    }
    for (int i = 0; i < 6; i++) {
      double au = 0.0;
      for (int j = 0; j < 6; j++) {
        const double starts = k->inertia_tensor[i / 3][j / 3] - k->kept[i / 3][j / 3],
                     all = a[6 * i + j] + k->implicit_inertia[i % 3][j % 3] * starts;
        CHECK(fabs(a[6 * i + j] - a[6 * j + i]) <= 1e-14 * trace, "element %d is not symmetric", e);
        au += all * (j < 3 ? 0.4 : -1.1);
      }
      CHECK(fabs(au - (&k->s[0][0])[i]) <= 1e-12 * (trace + inertia), "element %d: s %g, not %g", e,
            (&k->s[0][0])[i], au);
    }
  }
}

static void Constant(const double x[2], double u[2], double *p)
{
  u[0] = 0.4;
  u[1] = -1.1;
  *p = 0.0;
}

/* Sum over all elements of the trace of int a, less that of the pairs in the solid's volume: the integral of the wall
 * term over the shell. */
static double WallTotal(Coupler c)
{
  const Overlap o = c->overlap;
  double total = 0.0;
  for (int e = 0; e < o->ncoupled; e++) {
    for (int i = 0; i < 9; i++)
      total += c->coupling[e].a[0][i / 3][0][i % 3] + c->coupling[e].a[1][i / 3][1][i % 3];
  }
  for (int p = 0; p < o->pairs.n; p++)
    if (!o->source[o->pairs.pair[p].a].is_shell)
      total -= (c->term[p].a.xx + c->term[p].a.yy) * o->pairs.pair[p].area;
  MPI_Allreduce(MPI_IN_PLACE, &total, 1, MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD);
  return total;
}

/* int_shell a does not depend on dr; the literal mode has nearly the same but for WALL_PENALTY. */
static void CheckWeights(void)
{
  double total[2][2];
  Coupler c;
  ForceTotals totals;
  SetSolid(Constant);
  for (int m = 0; m < 2; m++) {
    const CouplerMode mode = m ? COUPLER_STRESS_SHELL : COUPLER_REACTION;
    for (int t = 0; t < 2; t++) {
      Step(mode, t ? 1e-4 : 2e-4, 1.0, &c, &totals);
      CheckCoupledElements(c);
      total[m][t] = WallTotal(c);
      CHECK(!CouplerDestroy(&c), "destroy");
    }
    CHECK(fabs(total[m][0] / total[m][1] - 1.0) < 5e-3, "mode %d: int a = %g, %g", m, total[m][0],
          total[m][1]);
  }
  CHECK(fabs(total[0][0] / (WALL_PENALTY * total[1][0]) - 1.0) < 0.1, "int a = %g, literal %g", total[0][0],
        total[1][0]);
}

static void CheckKernels(void)
{
  const double x[3][2] = {{0, 0}, {1, 0}, {0, 1}}, n[2] = {0.6, 0.8}, p[6] = {1, 2, 4, 0, 5, 3};
  double p1[3];
  const WallCoefficient a = WallCoefficientOf(2.0, n);
  CHECK(fabs(WallExtent(x, n) - 0.8) < 1e-16, "extent %g", WallExtent(x, n));
  CHECK(fabs(a.xx - 2.0 * (4.0 / 3.0 * 0.36 + 0.64)) < 1e-15 && fabs(a.xy - 2.0 * 0.48 / 3.0) < 1e-15 &&
            fabs(a.yy - 2.0 * (0.36 + 4.0 / 3.0 * 0.64)) < 1e-15,
        "[37]");
  P2ProjectP1(p, p1);
  CHECK(fabs(p1[0] + p1[1] + p1[2] - 8.0) < 1e-14, "the mean of a P2 field is the mean of its midpoints");
}

int main(int argc, char **argv)
{
  const double centre[2] = {0.5, 0.5}, floor[2] = {0.5, 0.0}, lower[2] = {0.3, 0.35};
  CHECK(!PetscInitialize(&argc, &argv, NULL, NULL), "PETSc");
  CheckKernels();
  SyntheticFluidMake(&all_fluid, 20, 9);
  SyntheticDisc(&all_solid, centre, 0.3, 5, 48);
  CheckBuoyancy(0.3, 1.0);
  CheckMotion();
  CheckRemainder();
  CheckWeights();
  SyntheticDisc(&all_solid, floor, 0.3, 5, 48);
  CheckBuoyancy(0.3, 0.5);
  SyntheticSquare(&all_solid, lower, 0.4, 8);
  CheckMotion();
  return PetscFinalize();
}
