// ranks: 1 2 3
/* The load of the fluid's pressure in the solid: that of a uniform pressure is the traction's on the surface and nothing inside, any other
 * has no resultant and no moment; of the pressure outside alone the acceleration is told; however all is dealt out to ranks. */
#include "coupler/force/pressure_load.h"
#include "tests/coupler/synthetic.h"

static const double CENTRE[2] = {0.45, 0.5}, RADIUS = 0.31, MOBILITY = 3.0;

static SyntheticSolid all_solid, solid;
static SyntheticFluid all_fluid, fluid;

/* By global node, summed over the ranks. */
typedef struct {
  double force[SYNTHETIC_MAX][2], acceleration[SYNTHETIC_MAX][2];
} Result;

static Result alone, shared;

static int GlobalNode(long long gid)
{
  return (int)(gid - 100) / 3;
}

/* The load after one step, from the second of two attempts. */
static void Run(MPI_Comm comm, Result *r)
{
  double force[SYNTHETIC_MAX][2], acceleration[SYNTHETIC_MAX][2] = {{0.0}}, mobility[SYNTHETIC_MAX];
  Shell shell;
  Overlap overlap;
  PressureLoad load;
  int rank, size;
  MPI_Comm_rank(comm, &rank);
  MPI_Comm_size(comm, &size);
  SyntheticSolidPart(&all_solid, rank, size, &solid);
  SyntheticFluidPart(&all_fluid, rank, size, &fluid);
  CHECK(!ShellCreate(comm, 0.004, &shell) && !ShellExtrude(shell, &solid.view, PETSC_TRUE), "shell");
  CHECK(!OverlapCreate(comm, &overlap) && !OverlapSetElements(overlap, &fluid.view) &&
            !OverlapBuild(overlap, &solid.view, shell, PETSC_TRUE),
        "overlap");
  CHECK(!PressureLoadCreate(comm, &load) && !PressureLoadBuild(load, &solid.view), "create");
  for (int attempt = 0; attempt < 2; attempt++) {
    memset(force, 0, sizeof force);
    CHECK(!PressureLoadAdd(load, overlap, &fluid.p[0][0], &force[0][0]), "add");
  }
  for (int i = 0; i < solid.nnodes; i++) mobility[i] = MOBILITY;
  CHECK(!PressureLoadAccept(load, overlap, mobility, &acceleration[0][0]), "accept");
  memset(r, 0, sizeof *r);
  for (int i = 0; i < solid.nnodes; i++)
    for (int d = 0; d < 2; d++) {
      r->force[GlobalNode(solid.gid[i])][d] += force[i][d];
      if (CopiesOwner(overlap->nodes, i) == rank)
        r->acceleration[GlobalNode(solid.gid[i])][d] = acceleration[i][d];
    }
  MPI_Allreduce(MPI_IN_PLACE, r, 4 * SYNTHETIC_MAX, MPI_DOUBLE, MPI_SUM, comm);
  CHECK(!PressureLoadDestroy(&load) && !OverlapDestroy(&overlap) && !ShellDestroy(&shell), "destroy");
}

/* value[nodes][2] is factor times the traction -n on the surface. */
static void CheckTraction(const char *what, double value[][2], double factor)
{
  double expected[SYNTHETIC_MAX][2] = {{0.0}};
  for (int e = 0; e < all_solid.nfacets; e++) {
    const double *a = all_solid.x[all_solid.facet[e][0]], *b = all_solid.x[all_solid.facet[e][1]];
    for (int i = 0; i < 2; i++) {
      expected[all_solid.facet[e][i]][0] -= 0.5 * factor * (b[1] - a[1]);
      expected[all_solid.facet[e][i]][1] += 0.5 * factor * (b[0] - a[0]);
    }
  }
  for (int i = 0; i < all_solid.nnodes; i++)
    for (int d = 0; d < 2; d++)
      CHECK(fabs(value[i][d] - expected[i][d]) <= 1e-8 * factor, "%s at node %d: %g instead of %g", what, i,
            value[i][d], expected[i][d]);
}

static void CheckUniform(void)
{
  const double p = 4.0;
  for (int k = 0; k < 6 * all_fluid.n; k++) all_fluid.p[k / 6][k % 6] = p;
  Run(PETSC_COMM_WORLD, &shared);
  CheckTraction("load", shared.force, PRESSURE_LOAD_RISE * p);
}

/* Pressure 1 outside of the solid, 0 inside. */
static void CheckOutside(void)
{
  for (int k = 0; k < 6 * all_fluid.n; k++) {
    double x[2];
    SyntheticP2Node((const double(*)[2])all_fluid.x[k / 6], k % 6, x);
    all_fluid.p[k / 6][k % 6] = hypot(x[0] - CENTRE[0], x[1] - CENTRE[1]) > RADIUS;
  }
  Run(PETSC_COMM_WORLD, &shared);
  CheckTraction("acceleration", shared.acceleration, PRESSURE_LOAD_RISE * MOBILITY);
}

/* A solid that the fluid does not cover at all. */
static void CheckFar(void)
{
  for (int i = 0; i < all_solid.nnodes; i++) all_solid.x[i][0] += 5.0;
  Run(PETSC_COMM_WORLD, &shared);
  CheckTraction("load outside of the fluid", shared.force, 0.0);
}

static void CheckAny(void)
{
  double sum[3] = {0.0}, largest = 0.0;
  srand(3);
  for (int k = 0; k < 6 * all_fluid.n; k++) all_fluid.p[k / 6][k % 6] = Random(-1.0, 1.0);
  Run(PETSC_COMM_SELF, &alone);
  Run(PETSC_COMM_WORLD, &shared);
  for (int i = 0; i < all_solid.nnodes; i++) {
    const double *f = shared.force[i], *x = all_solid.x[i];
    sum[0] += f[0];
    sum[1] += f[1];
    sum[2] += x[0] * f[1] - x[1] * f[0];
    largest = fmax(largest, hypot(f[0], f[1]));
    for (int d = 0; d < 2; d++)
      CHECK(fabs(f[d] - alone.force[i][d]) < 1e-8, "load at node %d: %g, on one rank %g", i, f[d],
            alone.force[i][d]);
  }
  CHECK(largest > 1e-4, "the largest load is %g N", largest);
  for (int k = 0; k < 3; k++)
    CHECK(fabs(sum[k]) < 1e-12, "resultant or moment %d of the load: %g", k, sum[k]);
}

int main(int argc, char **argv)
{
  CHECK(!PetscInitialize(&argc, &argv, NULL, NULL), "PETSc");
  SyntheticDisc(&all_solid, CENTRE, RADIUS, 6, 44);
  SyntheticFluidMake(&all_fluid, 23, 5);
  CheckUniform();
  CheckOutside();
  CheckAny();
  CheckFar();
  return PetscFinalize();
}
