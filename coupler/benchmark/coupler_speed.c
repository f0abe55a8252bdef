/* How long the coupler takes a step: a disc of radius 0.125 m, elements of 0.008 m, in a fluid mesh of 0.008
 * m near it. mpirun -n N coupler_speed */
#include "coupler/step/coupler.h"
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { CELLS = 48, RINGS = 16, SECTORS = 100, STEPS = 100 };

/* The rank's strips of a uniform mesh of [-0.2, 0.2]^2. */
static PetscErrorCode Fluid(int rank, int size, FluidElements *e, double **x, double **rho)
{
  const double h = 0.4 / CELLS;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(12 * CELLS * CELLS, x, 2 * CELLS * CELLS, rho));
  *e = (FluidElements){0, *x, *rho, *rho, NULL, NULL, {-0.2, -0.2}, {0.2, 0.2}};
  for (int k = 0; k < CELLS * CELLS; k++) {
    if (k % CELLS * size / CELLS != rank) continue;
    const double a = -0.2 + h * (k % CELLS), b = -0.2 + h * (k / CELLS);
    const double cell[12] = {a, b, a + h, b, a + h, b + h, a, b, a + h, b + h, a, b + h};
    PetscCall(PetscArraycpy(*x + 6 * e->n, cell, 12));
    (*rho)[e->n] = (*rho)[e->n + 1] = 1000.0;
    e->n += 2;
  }
  PetscFunctionReturn(0);
}

/* The whole disc on rank 0, free to move, twice as dense as the fluid. */
static void Disc(int rank, SolidState *s)
{
  enum { N = 2 * (RINGS * SECTORS + 1) };
  static double x[N], u[N], acceleration[N], mobility[N / 2];
  static long long gid[RINGS * SECTORS + 1];
  static int element[3 * SECTORS * (2 * RINGS - 1)], facet[2 * SECTORS];
  int n = 0;
  for (int k = 1; k <= RINGS * SECTORS; k++) {
    const double r = 0.125 * ((k - 1) / SECTORS + 1) / RINGS,
                 angle = 2.0 * PETSC_PI * ((k - 1) % SECTORS) / SECTORS;
    x[2 * k] = r * cos(angle);
    x[2 * k + 1] = r * sin(angle);
    gid[k] = k;
    mobility[k] = RINGS * SECTORS / (2000.0 * PETSC_PI * 0.125 * 0.125);
  }
  for (int i = 0; i < SECTORS; i++) {
    const int j = (i + 1) % SECTORS;
    element[n++] = 0;
    element[n++] = 1 + i;
    element[n++] = 1 + j;
    for (int ring = 1; ring < RINGS; ring++) {
      const int inner = 1 + (ring - 1) * SECTORS, outer = inner + SECTORS;
      const int two[6] = {inner + i, outer + i, outer + j, inner + i, outer + j, inner + j};
      for (int v = 0; v < 6; v++) element[n++] = two[v];
    }
    facet[2 * i] = 1 + (RINGS - 1) * SECTORS + i;
    facet[2 * i + 1] = 1 + (RINGS - 1) * SECTORS + j;
  }
  *s = (SolidState){.gid = gid,
                    .x = x,
                    .u = u,
                    .mobility = mobility,
                    .acceleration = acceleration,
                    .facet = facet,
                    .element = element};
  if (rank) return;
  s->nnodes = RINGS * SECTORS + 1;
  s->nfacets = SECTORS;
  s->nelements = n / 3;
}

/* Seconds of this processor: others may compute, too. */
static double Clock(void)
{
  return (double)clock() / CLOCKS_PER_SEC;
}

static PetscErrorCode Measure(Coupler c, const SolidState *solid, int nfluid, int rank)
{
  double *flow, seconds[3] = {0.0};
  ForceTotals totals;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(6 * (size_t)nfluid, &flow));
  const CoracleFlow still = {.u_start = flow,
                             .u_star = flow,
                             .u_projected = flow,
                             .rho = CouplerOverlap(c)->rho,
                             .mu = CouplerOverlap(c)->mu};
  for (int step = 0; step < STEPS; step++) {
    const CoracleCoupling *coupling;
    const CoracleCorrection *correction;
    const double *force;
    double t[4];
    int n;
    t[0] = Clock();
    PetscCall(CouplerBuild(c, solid, 0.0, 0.001, &n, &coupling));
    t[1] = Clock();
    PetscCall(CouplerComputeForce(c, &still, &force, &totals));
    t[2] = Clock();
    PetscCall(CouplerCorrect(c, solid, &n, &correction));
    t[3] = Clock();
    for (int k = 0; k < 3; k++) seconds[k] += (t[k + 1] - t[k]) / STEPS;
  }
  PetscCall(PetscFree(flow));
  if (rank == 0) {
    const double all = seconds[0] + seconds[1] + seconds[2];
    printf("%lld pairs: build %.3f ms, react %.3f ms, correct %.3f ms; %.3f us a pair\n", totals.npairs,
           1e3 * seconds[0], 1e3 * seconds[1], 1e3 * seconds[2], 1e6 * all / (double)totals.npairs);
  }
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  const CouplerOptions options = {.mode = COUPLER_REACTION, .thickness = 0.0005, .gravity = {0.0, -9.81}};
  FluidElements elements;
  SolidState solid;
  Coupler c;
  double *x, *rho;
  int rank, size;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCallMPI(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  PetscCallMPI(MPI_Comm_size(PETSC_COMM_WORLD, &size));
  PetscCall(Fluid(rank, size, &elements, &x, &rho));
  Disc(rank, &solid);
  PetscCall(CouplerCreate(PETSC_COMM_WORLD, &options, &c));
  PetscCall(CouplerSetElements(c, &elements));
  PetscCall(Measure(c, &solid, elements.n, rank));
  PetscCall(CouplerDestroy(&c));
  PetscCall(PetscFree2(x, rho));
  return PetscFinalize();
}
