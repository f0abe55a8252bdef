// ranks: 1 2 3
/* Quasi-Newton on x = H(x) where plain repetition explodes: as many tries as the equation has gains (0,
 * where H does not change, is one) and two more, fewer once it is known, and a nonlinear one converges
 * faster than linearly. */
#include "coupler/quasi_newton.h"
#include "tests/check.h"
#include <math.h>

enum { N = 40, DIRECTIONS = 3 };

/* H(x)_i = b_i - sum_d g_d s_d,i (s_d . x) + curvature tanh: gains g far above 1, as of a light solid. */
typedef struct {
  int first, n; /* this rank's part of the N numbers */
  double gain[DIRECTIONS], curvature;
} Equation;

static double Direction(int d, int i)
{
  return sqrt(2.0 / N) * sin(3.14159265358979 * (d + 1) * (i + 0.5) / N);
}

static void Evaluate(const Equation *e, const double x[], double hx[])
{
  double dot[DIRECTIONS] = {0.0};
  for (int d = 0; d < DIRECTIONS; d++)
    for (int i = 0; i < e->n; i++) dot[d] += Direction(d, e->first + i) * x[i];
  CHECK(!MPI_Allreduce(MPI_IN_PLACE, dot, DIRECTIONS, MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD), "sum");
  for (int i = 0; i < e->n; i++) {
    hx[i] = cos(e->first + i);
    for (int d = 0; d < DIRECTIONS; d++)
      hx[i] -= (e->gain[d] * dot[d] + e->curvature * tanh(dot[d])) * Direction(d, e->first + i);
  }
}

/* Tries until |H(x) - x| < 1e-9, from 0. */
static int Solve(QuasiNewton a, const Equation *e)
{
  double x[N] = {0.0}, hx[N], next[N];
  CHECK(!QuasiNewtonBegin(a, e->n), "begin");
  for (int iterations = 1; iterations < 100; iterations++) {
    double r = 0.0;
    Evaluate(e, x, hx);
    for (int i = 0; i < e->n; i++) r += (hx[i] - x[i]) * (hx[i] - x[i]);
    CHECK(!MPI_Allreduce(MPI_IN_PLACE, &r, 1, MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD), "sum");
    if (sqrt(r) < 1e-9) return iterations;
    CHECK(!QuasiNewtonNext(a, x, hx, next), "next");
    for (int i = 0; i < e->n; i++) x[i] = next[i];
  }
  return 100;
}

int main(int argc, char **argv)
{
  Equation e = {.gain = {20.0, 5.0, 1.5}};
  QuasiNewton a;
  PetscMPIInt rank, size;
  CHECK(!PetscInitialize(&argc, &argv, NULL, NULL), "PETSc");
  CHECK(!MPI_Comm_rank(PETSC_COMM_WORLD, &rank) && !MPI_Comm_size(PETSC_COMM_WORLD, &size), "comm");
  e.first = N * rank / size;
  e.n = N * (rank + 1) / size - e.first;
  CHECK(!QuasiNewtonCreate(PETSC_COMM_WORLD, &a), "create");
  const int first = Solve(a, &e), second = Solve(a, &e);
  CHECK(first <= DIRECTIONS + 1 + 2, "%d tries for %d gains", first, DIRECTIONS + 1);
  CHECK(second <= 3, "%d tries though all is known", second);
  e.curvature = 10.0;
  const int curved = Solve(a, &e);
  CHECK(curved <= 15, "%d tries of a nonlinear equation", curved);
  CHECK(!QuasiNewtonDestroy(&a), "destroy");
  return PetscFinalize();
}
