/* Microseconds of this rank a new triangle: bench_transfer [cells a side, default 71 (10 082 triangles)].
 * All triangles changed, a disc of them, none. */
#include "common/transfer/transfer.h"
#include "tests/transfer/shaken.h"
#include <time.h>

enum { COMPS = 4, REPEATS = 5 };

/* Of this process: other work on the machine does not count. */
static double CpuSeconds(void)
{
  struct timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static PetscErrorCode Measure(int n, double radius, unsigned seed)
{
  const Shaken what[2] = {{n, 1, radius, {0}}, {n, seed, radius, {0}}};
  double *u[2], *p[2], best[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL};
  Mesh *mesh[2];
  P2Space *space[2];
  TransferStats stats;
  PetscFunctionBeginUser;
  for (int m = 0; m < 2; m++) {
    PetscCall(ShakenMesh(PETSC_COMM_WORLD, &what[m], &mesh[m]));
    PetscCall(P2SpaceCreate(mesh[m], &space[m]));
    PetscCall(PetscCalloc1(3 * COMPS * mesh[m]->ne, &u[m]));
    PetscCall(PetscCalloc1(space[m]->n, &p[m]));
  }
  for (int repeat = 0; repeat < REPEATS; repeat++) {
    Transfer transfer;
    double t[4];
    t[0] = CpuSeconds();
    PetscCall(TransferCreate(mesh[0], mesh[1], &transfer));
    t[1] = CpuSeconds();
    PetscCall(TransferP1DG(transfer, COMPS, u[0], u[1]));
    t[2] = CpuSeconds();
    PetscCall(TransferP2(transfer, space[0], space[1], p[0], p[1]));
    t[3] = CpuSeconds();
    for (int k = 0; k < 3; k++) best[k] = PetscMin(best[k], 1e6 * (t[k + 1] - t[k]) / mesh[1]->ne);
    PetscCall(TransferGetStats(transfer, &stats));
    PetscCall(TransferDestroy(&transfer));
  }
  PetscCall(PetscPrintf(
      PETSC_COMM_WORLD,
      "%7d triangles, %7d changed, %.2f pairs each, %7d migrate: create %.3f us, P1DG of %d components %.3f "
      "us, P2 %.3f us a triangle",
      (int)(stats.copied + stats.projected), (int)stats.projected,
      (double)stats.pairs / PetscMax(stats.projected, 1), (int)stats.migrated, best[0], COMPS, best[1],
      best[2]));
  if (stats.projected) {
    PetscCall(PetscPrintf(PETSC_COMM_WORLD, "; %.2f us a changed one",
                          (best[0] + best[1] + best[2]) * (double)(stats.copied + stats.projected) /
                              (double)stats.projected));
  }
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "\n"));
  for (int m = 0; m < 2; m++) {
    PetscCall(PetscFree(u[m]));
    PetscCall(PetscFree(p[m]));
    PetscCall(P2SpaceDestroy(&space[m]));
    PetscCall(MeshDestroy(&mesh[m]));
  }
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  const int n = argc > 1 ? atoi(argv[1]) : 71;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(Measure(n, 1.0, 2));
  PetscCall(Measure(n, 0.2, 2));
  PetscCall(Measure(n, 0.2, 1));
  return PetscFinalize();
}
